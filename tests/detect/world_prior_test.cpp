#include "host/detect/world_prior.h"

#include <gtest/gtest.h>

#include "tests/io/expect_input_error.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

WorldPrior with_box(const std::vector<double>& box_m) {
  WorldPrior prior;
  prior.box_m = box_m;
  return prior;
}

WorldPrior with_plane(const std::vector<double>& plane) {
  WorldPrior prior;
  prior.plane = plane;
  return prior;
}

TEST(WorldPrior, TakesTheCornersOfABoxInAnyOrder) {
  const Eigen::AlignedBox3d box = with_box({0.3, -1, 0.5, -0.2, 1, 0.1}).box();
  EXPECT_EQ(box.min(), Eigen::Vector3d(-0.2, -1, 0.1));
  EXPECT_EQ(box.max(), Eigen::Vector3d(0.3, 1, 0.5));
}

TEST(WorldPrior, RefusesWhatIsNoBoxAndNoPlane) {
  const auto refused = [](const WorldPrior& prior, std::initializer_list<std::string> words) {
    expect_input_error([&] { prior.validate(); }, words);
  };
  EXPECT_NO_THROW(WorldPrior().validate());
  EXPECT_NO_THROW(with_box({0.3, -1, 0.5, -0.2, 1, 0.1}).validate());
  refused(with_box({0, 0, 0, 1, 1}), {"detect.world_box", "5 numbers", "6"});
  refused(with_box({0, 0, 0.5, 1, 1, 0.5}), {"detect.world_box", "1 x 1 x 0 m", "corners"});
  refused(with_box({0, 0, 0, 1, 1, NAN}), {"detect.world_box", "nan"});
  EXPECT_NO_THROW(with_plane({0.577, 0.577, 0.577, -3}).validate()) << "rounded";
  refused(with_plane({0, 0, 0, 0}), {"detect.world_plane", "length 0", "unit normal"});
  refused(with_plane({0, 0, 2, 0}), {"detect.world_plane", "length 2"});
  refused(with_plane({0, 0, 1}), {"detect.world_plane", "3 numbers", "4"});
  WorldPrior above = with_plane({0, 0, 1, 0});
  above.plane_tolerance_m = -0.001;
  refused(above, {"detect.plane_tolerance"});
}

// Distances of random points of the box from random cameras.
TEST(WithDistancesToBox, HoldsAllPlacesOfTheBox) {
  const Camera camera{640, 480, 600, 600, 319.5, 239.5, {}};
  const WorldPrior prior = with_box({-0.2, -0.1, 0.0, 0.3, 0.4, 0.2});
  Random random = test_random();
  for (int i = 0; i < 20; ++i) {
    std::vector<Se3> camera_from_world;
    double nearest_m = INFINITY, farthest_m = 0;
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3d eye = random.uniform(0.7, 1.5) * random.direction();
      camera_from_world.push_back(inverse({random.rotation(), eye}));
      for (int p = 0; p < 20000; ++p) {
        const Eigen::Vector3d place(random.uniform(-0.2, 0.3), random.uniform(-0.1, 0.4),
                                    random.uniform(0.0, 0.2));
        nearest_m = std::min(nearest_m, (place - eye).norm());
        farthest_m = std::max(farthest_m, (place - eye).norm());
      }
    }
    const TemplateOptions options =
        with_distances_to_box({}, 0.1, camera, prior, camera_from_world);
    EXPECT_LE(options.distance_min_m, nearest_m);
    EXPECT_GE(options.distance_max_m, farthest_m);
    EXPECT_NEAR(options.distance_min_m, nearest_m, 0.03);
    EXPECT_NEAR(options.distance_max_m, farthest_m, 0.03);
  }
}

TEST(WithDistancesToBox, LeavesGivenDistancesAndNeedsABox) {
  const Camera camera{640, 480, 600, 600, 319.5, 239.5, {}};
  const Se3 from_origin;
  TemplateOptions given;
  given.distance_min_m = 0.3, given.distance_max_m = 0.4;
  const TemplateOptions kept = with_distances_to_box(
      given, 0.1, camera, with_box({0, 0, 1, 0.1, 0.1, 2}), {&from_origin, 1});
  EXPECT_EQ(kept.distance_min_m, 0.3);
  EXPECT_EQ(kept.distance_max_m, 0.4);
  const TemplateOptions without =
      with_distances_to_box({}, 0.1, camera, with_plane({0, 0, 1, 0}), {&from_origin, 1});
  EXPECT_EQ(without.distance_max_m, 0);
}

// A camera in the box is at no distance from it.
TEST(WithDistancesToBox, KeepsToSizesThatCanBeSeen) {
  const Camera camera{640, 480, 600, 600, 319.5, 239.5, {}};
  const Se3 from_origin;
  const TemplateOptions options =
      with_distances_to_box({}, 0.1, camera, with_box({-9, -9, -9, 9, 9, 9}), {&from_origin, 1});
  EXPECT_NEAR(options.distance_min_m, 600 * 0.1 / 640, 1e-12);
  EXPECT_NEAR(options.distance_max_m, 600 * 0.1 / 24, 1e-12);
  expect_input_error(
      [&] {
        with_distances_to_box({}, 0.1, camera, with_box({0, 0, 5, 1, 1, 6}), {&from_origin, 1});
      },
      {"detect.world_box", "5.000 to 6.164 m", "0.094 to 2.500 m", "distance_min"});
}

}  // namespace
}  // namespace edgescout::test
