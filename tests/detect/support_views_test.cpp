#include "host/detect/support_views.h"

#include <gtest/gtest.h>

namespace edgescout::test {
namespace {

// The camera is on the world's x axis and turned about it: only the positions of cameras count.
ObjectView standing_at(double x_m) {
  ObjectView view;
  Se3 world_from_camera;
  world_from_camera.rotation = Eigen::AngleAxisd(0.3 * x_m, Eigen::Vector3d::UnitX());
  world_from_camera.translation_m = {x_m, 0, 0};
  view.camera_from_world = inverse(world_from_camera);
  return view;
}

std::vector<double> places(std::span<const ObjectView> views) {
  std::vector<double> x_m;
  for (const ObjectView& view : views)
    x_m.push_back(std::round(1e6 * inverse(view.camera_from_world).translation_m.x()) / 1e6);
  return x_m;
}

TEST(SupportViews, AreAllOfFew) {
  const std::vector<ObjectView> others{standing_at(3), standing_at(1), standing_at(2)};
  for (const std::size_t most : {3, 4, 100})
    EXPECT_EQ(places(support_views(standing_at(0), others, most)), (std::vector<double>{3, 1, 2}))
        << most;
  EXPECT_TRUE(support_views(standing_at(0), {}, 4).empty());
}

TEST(SupportViews, AreSpreadFromNearToFarInTheOrderGiven) {
  std::vector<ObjectView> others;
  for (const double x_m : {9, -1, 5, 3, -8, 2, 6, 7, 4}) others.push_back(standing_at(x_m));
  // Distances 1 to 9: the middle one of each third.
  EXPECT_EQ(places(support_views(standing_at(0), others, 3)), (std::vector<double>{5, -8, 2}));
  EXPECT_EQ(places(support_views(standing_at(0), others, 1)), (std::vector<double>{5}));
  // From the other end 9, 7, 6, 5, 4, 3, 2, -1, -8.
  EXPECT_EQ(places(support_views(standing_at(10), others, 3)), (std::vector<double>{-1, 7, 4}));
}

}  // namespace
}  // namespace edgescout::test
