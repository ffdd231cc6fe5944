// Refinement of many starts: each by itself, whatever the others are, and from as far as the search
// reaches.
#include "host/register/refine.h"

#include <gtest/gtest.h>

#include "host/eval/metrics.h"
#include "host/io/mesh.h"
#include "kernels/error.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

std::vector<ObjectPose> starts_around(const Se3& truth, int count, double offset_m,
                                      double angle_rad, Random& random) {
  std::vector<ObjectPose> starts;
  for (int i = 0; i < count; ++i) {
    Vector6d off;
    off << offset_m * random.direction(), angle_rad * random.direction();
    starts.push_back({0, retract(truth, off)});
  }
  return starts;
}

TEST(Refine, DoesNotDependOnHowManyAreRefinedTogether) {
  Random random = test_random();
  const auto backend = make_cpu_backend(2);
  const PartScene scene("l_bracket", 2, random, *backend);
  const std::vector<EdgeModel> models{scene.model};
  const std::vector<ObjectPose> starts = starts_around(scene.truth, 5, 0.01, 0.2, random);
  for (const double search_rad : {0.0, 0.25}) {
    RefineOptions options;
    options.use_edge_icp = false;  // these views have no edge index
    options.search.rotation_rad = search_rad;
    const std::vector<Refined> together =
        refine_poses(models, starts, scene.views, *backend, options);
    ASSERT_EQ(together.size(), starts.size());
    for (const int at_once : {1, 4}) {  // one start of two views a time, two
      options.at_once = at_once;
      const std::vector<Refined> apart =
          refine_poses(models, starts, scene.views, *backend, options);
      ASSERT_EQ(apart.size(), starts.size());
      for (std::size_t i = 0; i < starts.size(); ++i) {
        const Se3 &a = apart[i].registration.world_from_object,
                  &b = together[i].registration.world_from_object;
        EXPECT_EQ(a.translation_m, b.translation_m) << i;
        EXPECT_EQ(a.rotation.coeffs(), b.rotation.coeffs()) << i;
        EXPECT_EQ(apart[i].registration.cost_px2, together[i].registration.cost_px2);
        EXPECT_EQ(log_odds(apart[i].features), log_odds(together[i].features));
        EXPECT_EQ(apart[i].by_view.size(), 2u);
      }
    }
  }
}

// CAD files have their origin anywhere. A part told from an origin some diameters off is found from
// the same far starts.
TEST(Refine, FindsAPartWhereverItsOriginLies) {
  Random random = test_random();
  const auto backend = make_cpu_backend(2);
  const PartScene scene("l_bracket", 2, random, *backend);
  const Eigen::Vector3d shift_m(0.15, -0.05, 0.1);
  Mesh shifted = scene.model.mesh;
  for (Eigen::Vector3d& vertex_m : shifted.vertices_m) vertex_m += shift_m;
  const EdgeModel elsewhere =
      make_edge_model(make_mesh("shifted", shifted.vertices_m, shifted.triangles));
  const Se3 shifted_from_part{Eigen::Quaterniond::Identity(), shift_m};
  RefineOptions options;
  options.use_edge_icp = false;  // these views have no edge index
  std::vector<ObjectPose> starts = starts_around(scene.truth, 24, 0.02, 0.9, random),
                          starts_elsewhere;
  for (const ObjectPose& start : starts)
    starts_elsewhere.push_back({0, start.world_from_object * inverse(shifted_from_part)});
  const auto right = [&](const EdgeModel& model, const std::vector<ObjectPose>& from,
                         const Se3& back) {
    int count = 0;
    for (const Refined& refined : refine_poses({&model, 1}, from, scene.views, *backend, options))
      count += pose_error(refined.registration.world_from_object * back, scene.truth, {})
                   .passes(0.02, 0.001);
    return count;
  };
  const int here = right(scene.model, starts, Se3{});
  EXPECT_GE(here, 10);
  EXPECT_GE(right(elsewhere, starts_elsewhere, shifted_from_part), here - 1);
}

TEST(Refine, RefusesBlocksOfNothing) {
  RefineOptions options;
  options.at_once = 0;
  EXPECT_THROW(options.validate(), InputError);
}

}  // namespace
}  // namespace edgescout::test
