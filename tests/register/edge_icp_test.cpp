// Polished poses in rendered images: how far from the truth, and does the covariance say so?
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
  std::vector<RegisterView> views;
};

// Parts that no turn about an axis maps onto themselves: of others no covariance is finite for a
// reason.
std::vector<Object> held_types() {
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
  Rendered result{rendered_scene("polish", held_types(), options, backend.threads()), {}, {}};
  for (const Object& object : result.scene.objects)
    result.models.push_back(make_edge_model(object.mesh));
  result.views =
      register_views(result.scene, edges_of(result.scene, backend), TensorOptions{}, backend);
  return result;
}

Se3 nearest_twin(const Se3& truth, const Se3& found, const Symmetries& symmetries) {
  return truth * *std::ranges::min_element(symmetries.discrete, {}, [&](const Se3& symmetry) {
           return angle_between_rad(truth * symmetry, found);
         });
}

// Of every instance, from a start 2 mm and 0.03 rad off: e' C^-1 e of the error e; a pose that
// ended elsewhere is left out.
std::vector<double> squared_errors(const Rendered& known, std::size_t views, Random& random,
                                   Backend& backend) {
  std::vector<ObjectPose> starts;
  for (const KnownInstance& instance : known.scene.instances) {
    Vector6d off;
    off << 0.002 * random.direction(), 0.03 * random.direction();
    starts.push_back({instance.object, retract(instance.world_from_object, off)});
  }
  const RefineOptions defaults;
  const std::vector<Refined> found =
      refine_poses(known.models, starts, std::span(known.views).first(views), backend, defaults);
  std::vector<double> squared;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const KnownInstance& instance = known.scene.instances[i];
    const Registration& registration = found[i].registration;
    const Se3 truth = nearest_twin(instance.world_from_object, registration.world_from_object,
                                   known.scene.objects[instance.object].symmetries);
    const Vector6d error = local_coordinates(registration.world_from_object, truth);
    if (error.tail<3>().norm() < 0.05)
      squared.push_back(error.dot(registration.covariance.ldlt().solve(error)));
  }
  return squared;
}

double quantile(std::vector<double> values, double part) {
  std::ranges::sort(values);
  return values[std::size_t(part * double(values.size() - 1))];
}

// Of six unknowns the median is 5.3 and a tenth lies above 10.6. Taken for independent, points
// would make it some 100.
TEST(Polish, CovarianceTellsErrorsOfRenderedParts) {
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
    EXPECT_LT(quantile(squared, 0.9), 10.6 * 5) << "some parts' edges mislead all together";
  }
}

}  // namespace
}  // namespace edgescout
