// Errors of poses after edge ICP in rendered images, compared with their covariance.
#include "host/register/edge_icp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

#include <Eigen/Cholesky>

#include "host/experiments/known_scene.h"
#include "host/experiments/settings.h"
#include "host/register/refine.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using test::test_random;

constexpr int VIEWS = 3;

struct Rendered {
  KnownScene scene;
  std::vector<EdgeModel> models;
  std::vector<ObjectView> views;
};

// Parts that are no surface of revolution: the edges of others do not determine the pose.
std::vector<Object> determined_types() {
  std::vector<Object> types = rendered_types();
  std::erase_if(types, [](const Object& type) { return type.symmetries.discrete.size() > 8; });
  return types;
}

Rendered rendered(unsigned seed, Backend& backend) {
  RenderOptions options;
  options.seed = seed;
  options.width = 640;
  options.height = 480;
  options.focal_px = 800;
  options.objects = 8;
  options.pile = 0.2;
  options.views = VIEWS;
  Rendered result{rendered_scene("polish", determined_types(), options, backend.threads()), {}, {}};
  for (const Object& object : result.scene.objects)
    result.models.push_back(make_edge_model(object.mesh));
  result.views =
      register_views(result.scene, edges_of(result.scene, backend), TensorOptions{}, backend);
  return result;
}

Se3 nearest_equal_pose(const Se3& truth, const Se3& found, const Symmetries& symmetries) {
  return truth * *std::ranges::min_element(symmetries.discrete, {}, [&](const Se3& symmetry) {
           return angle_between_rad(truth * symmetry, found);
         });
}

// e' C^-1 e of the error e of every instance, from a start 2 mm and 0.03 rad off. Poses that end
// elsewhere are left out.
std::vector<double> squared_errors(const Rendered& known, std::size_t views, Random& random,
                                   Backend& backend) {
  std::vector<ObjectPose> starts;
  for (const KnownInstance& instance : known.scene.instances) {
    Vector6d off;
    off << 0.002 * random.direction(), 0.03 * random.direction();
    starts.push_back({instance.object, retract(instance.world_from_object, off)});
  }
  const RefineOptions defaults;
  const std::vector<PoseEstimate> found =
      refine_poses({known.models, std::span(known.views).first(views), backend}, starts, defaults);
  std::vector<double> squared;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const KnownInstance& instance = known.scene.instances[i];
    const PoseEstimate& estimate = found[i];
    const Se3 truth = nearest_equal_pose(instance.world_from_object, estimate.world_from_object,
                                         known.scene.objects[instance.object].symmetries);
    const Vector6d error = local_coordinates(estimate.world_from_object, truth);
    if (error.tail<3>().norm() < 0.05)
      squared.push_back(error.dot(estimate.covariance.ldlt().solve(error)));
  }
  return squared;
}

double quantile(std::vector<double> values, double part) {
  std::ranges::sort(values);
  return values[std::size_t(part * double(values.size() - 1))];
}

// For six unknowns the median is 5.3, and a tenth lies above 10.6. If the points counted as
// independent, the median would be some 100.
TEST(EdgeIcp, CovarianceMatchesErrorsOfRenderedParts) {
  const std::unique_ptr<Backend> backend = make_cpu_backend(2);
  Random random = test_random();
  std::vector<double> one, several;
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Rendered scene = rendered(seed, *backend);
    for (const double x : squared_errors(scene, 1, random, *backend)) one.push_back(x);
    for (const double x : squared_errors(scene, VIEWS, random, *backend)) several.push_back(x);
  }
  for (const std::vector<double>& squared : {one, several}) {
    std::printf("%zu poses: quartiles %.1f, %.1f, %.1f, nine tenths below %.1f\n", squared.size(),
                quantile(squared, 0.25), quantile(squared, 0.5), quantile(squared, 0.75),
                quantile(squared, 0.9));
    ASSERT_GE(squared.size(), 20u);
    EXPECT_GT(quantile(squared, 0.5), 5.3 / 3) << "standard deviations 1.7 times too large";
    EXPECT_LT(quantile(squared, 0.5), 5.3 * 3) << "standard deviations 1.7 times too small";
    EXPECT_LT(quantile(squared, 0.9), 10.6 * 5) << "common errors of some parts' edges";
  }
}

}  // namespace
}  // namespace edgescout
