// Detection in an image with a depth image.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/error.h"
#include "tests/detect/rendered_part.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

// The rendered depth with Gaussian noise; every third pixel is missing.
DepthImage measured(const RenderedPart& t, Random& random) {
  const Camera& camera = t.scene.views[0].camera;
  DepthImage depth{camera.width, camera.height, {}};
  for (const float z_m : t.renderings[0].depth_m)
    depth.z_m.push_back(std::isfinite(z_m) && random.uniform() > 0.33
                            ? z_m + float(DepthNoise{}.sigma_m(z_m) * random.normal())
                            : DEPTH_MISSING);
  return depth;
}

TEST(DepthDetection, FindsThePartNearerAlongTheAxisFromFewerStarts) {
  const auto backend = make_cpu_backend(2);
  const RenderedPart t("l_bracket");
  Random random = test_random();
  ObjectView view = t.prepared(0, Se3{}, *backend);
  DetectTrace blind, seeing;
  const Detections without =
      detect_objects(view, t.sets, *backend, RenderedPart::options(), &blind);
  add_depth(view, measured(t, random), t.scene.views[0].camera);
  const Detections with = detect_objects(view, t.sets, *backend, RenderedPart::options(), &seeing);
  ASSERT_FALSE(without.detections.empty());
  ASSERT_FALSE(with.detections.empty());
  const Se3 truth = t.truth_in(0);
  const auto along_axis_m = [&](const Detections& found) {
    return std::abs(found.detections[0].world_from_object.translation_m.z() -
                    truth.translation_m.z());
  };
  EXPECT_LT(t.error(with.detections[0].world_from_object, truth).distance_m, 5e-4);
  EXPECT_LT(along_axis_m(with), std::max(1e-4, 0.34 * along_axis_m(without)));
  EXPECT_GE(with.detections[0].probability, without.detections[0].probability);
  EXPECT_LT(seeing.searches[0].hits.size(), blind.searches[0].hits.size());
}

TEST(DepthDetection, APartBehindAMeasuredWallIsNotReported) {
  const auto backend = make_cpu_backend(2);
  const RenderedPart t("l_bracket");
  ObjectView view = t.prepared(0, Se3{}, *backend);
  DepthImage wall{view.camera.width, view.camera.height, {}};
  wall.z_m.assign(std::size_t(wall.width) * std::size_t(wall.height), 0.24f);
  add_depth(view, wall, t.scene.views[0].camera);
  for (const Detection& found :
       detect_objects(view, t.sets, *backend, RenderedPart::options()).detections)
    EXPECT_LT(found.probability, 0.4) << found.world_from_object.translation_m.transpose();
}

TEST(DepthDetection, RefusesDepthOfAnotherSize) {
  const auto backend = make_cpu_backend(1);
  const RenderedPart t("l_bracket");
  ObjectView view = t.prepared(0, Se3{}, *backend);
  EXPECT_THROW(add_depth(view, {10, 10, std::vector<float>(100)}, t.scene.views[0].camera),
               InputError);
}

}  // namespace
}  // namespace edgescout::test
