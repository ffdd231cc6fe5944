// Refinement of many starts: independent of each other, and from as far as the search reaches.
#include "host/register/refine.h"

#include <gtest/gtest.h>

#include "host/core/pose_error.h"
#include "host/io/mesh.h"
#include "host/register/pose_classifier.h"
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

TEST(Refine, DoesNotDependOnTheBatchSize) {
  Random random = test_random();
  const auto backend = make_cpu_backend(2);
  const PartScene scene("l_bracket", 2, random, *backend);
  const std::vector<ObjectPose> starts = starts_around(scene.truth, 5, 0.01, 0.2, random);
  for (const double search_rad : {0.0, 0.25}) {
    RefineOptions options;
    options.use_edge_icp = false;  // these views have no edge index
    options.search.rotation_rad = search_rad;
    const std::vector<PoseEstimate> at_once = refine_poses(scene.on(*backend), starts, options);
    ASSERT_EQ(at_once.size(), starts.size());
    for (const int batch_size : {1, 4}) {  // one start and two starts of two views
      options.batch_size = batch_size;
      const std::vector<PoseEstimate> apart = refine_poses(scene.on(*backend), starts, options);
      ASSERT_EQ(apart.size(), starts.size());
      for (std::size_t i = 0; i < starts.size(); ++i) {
        const Se3 &a = apart[i].world_from_object, &b = at_once[i].world_from_object;
        EXPECT_EQ(a.translation_m, b.translation_m) << i;
        EXPECT_EQ(a.rotation.coeffs(), b.rotation.coeffs()) << i;
        EXPECT_EQ(apart[i].cost_px2, at_once[i].cost_px2);
        EXPECT_EQ(PoseClassifier::rank(pool_over_views(apart[i].features)),
                  PoseClassifier::rank(pool_over_views(at_once[i].features)));
        EXPECT_EQ(apart[i].features.size(), 2u);
      }
    }
  }
}

// CAD files have their origin anywhere. A part whose origin lies some diameters off is found from
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
    for (const PoseEstimate& refined :
         refine_poses({{&model, 1}, scene.views, *backend}, from, options))
      count += pose_error(refined.world_from_object * back, scene.truth, {}).passes(0.02, 0.001);
    return count;
  };
  const int here = right(scene.model, starts, Se3{});
  EXPECT_GE(here, 10);
  EXPECT_GE(right(elsewhere, starts_elsewhere, shifted_from_part), here - 1);
}

TEST(Refine, RefusesEmptyBatches) {
  RefineOptions options;
  options.batch_size = 0;
  EXPECT_THROW(options.validate(), InputError);
}

}  // namespace
}  // namespace edgescout::test
