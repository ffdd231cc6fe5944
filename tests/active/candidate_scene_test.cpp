#include "host/active/candidate_scene.h"

#include <gtest/gtest.h>

#include "tests/active/plan.h"

namespace edgescout::test {
namespace {

// The maps against brute force: every pixel's distance to the candidate's visible edge points, and
// the surface in a picture of the whole image.
TEST(CandidateScene, HoldsEdgesAndSurfacesOfEveryView) {
  Plan t(3);
  const Camera camera = scaled(test_camera(), 0.25);
  const CandidateScene scene = draw_candidates(t.models, t.candidates, camera, t.views, *t.backend,
                                               {t.options.visibility, t.options.tolerance});
  ASSERT_EQ(scene.maps.size(), t.views.size() * 3);
  ASSERT_EQ(scene.tolerance_m.size(), 3u);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_FLOAT_EQ(scene.chamfer_view(1).tolerance_m[c],
                    float(0.1 * t.models[c % 2].mesh.diameter_m));
  for (std::size_t v = 0; v < t.views.size(); v += 3) {
    const ChamferView seen = scene.chamfer_view(v);
    for (std::size_t c = 0; c < 3; ++c) {
      const Se3 pose = t.views[v] * t.candidates[c].world_from_object;
      const EdgeModel& model = t.models[t.candidates[c].object];
      const std::vector<ModelPoint> points =
          visible_edges(model, std::span(&pose, 1), *t.backend, t.options.visibility)[0];
      const DepthJob whole{to_pose(pose), intrinsics_of(camera)};
      std::vector<float> depth(std::size_t(camera.width) * camera.height);
      t.backend->depth_raster(model.triangle_mesh(), std::span(&whole, 1), camera.width,
                              camera.height, depth);
      const CandidateMap& map = seen.candidates[c];
      int covered = 0, differing = 0;
      for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
          double least = 1e9;
          for (const ModelPoint& p : points)
            least = std::min(least, (project(camera, pose * Eigen::Vector3d(p.x_m, p.y_m, p.z_m)) -
                                     Eigen::Vector2d(x, y))
                                        .norm());
          const float here = depth[std::size_t(y) * camera.width + x];
          if (!map.window.contains(x, y)) {
            EXPECT_GT(least, 15);
            EXPECT_EQ(here, DEPTH_EMPTY);
            continue;
          }
          const std::size_t pixel = map.first_pixel + map.window.index(x, y);
          EXPECT_NEAR(chamfer_steps(seen.nearest[pixel]) / 16.0, std::min(least, 255 / 16.0), 0.16);
          covered += here != DEPTH_EMPTY;
          differing += (here == DEPTH_EMPTY) != (seen.surface_m[pixel] == DEPTH_EMPTY) ||
                       (here != DEPTH_EMPTY && std::abs(here - seen.surface_m[pixel]) > 1e-4f);
        }
      EXPECT_GT(covered, 100);
      EXPECT_LE(differing, covered / 50);  // pixel centres on an edge may fall on either side
    }
  }
}

}  // namespace
}  // namespace edgescout::test
