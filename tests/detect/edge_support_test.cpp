#include "host/detect/edge_support.h"

#include <gtest/gtest.h>

#include "tests/detect/part_image.h"

namespace edgescout::test {
namespace {

TEST(CountSupported, IsLessBesideARightPose) {
  const auto backend = make_cpu_backend(2);
  const std::vector<EdgeModel> models{part_model("l_bracket")};
  const Se3 camera_from_world{so3_exp({0.1, 0.2, 0.3}), {0.01, 0.02, 0.03}},
      camera_from_object{so3_exp({0.6, 0.3, 0.2}), {0, 0, 0.35}};
  ObjectView view = view_of_edges(
      ideal_edges(part_model("l_bracket", 2e-4), small_camera(), camera_from_object, *backend),
      small_camera(), 1, *backend);
  view.camera_from_world = camera_from_world;
  const std::vector<ObjectView> views{view};
  const Scene scene{models, views, *backend};
  const ObjectPose right{0, inverse(camera_from_world) * camera_from_object};
  const SupportedPoints found = count_supported(scene, right);
  EXPECT_EQ(double(found.supported), found.in_image);
  EXPECT_EQ(found.in_image, found.visible);
  EXPECT_LT(found.supported_beside, found.supported);
  EXPECT_TRUE(found.exceeds_copies());

  // Moved by 14 px, where one of the copies is right.
  ObjectPose beside = right;
  const Eigen::Vector3d off_m(14 * (camera_from_object * models[0].center_m).z() / 400, 0, 0);
  beside.world_from_object.translation_m += camera_from_world.rotation.conjugate() * off_m;
  const SupportedPoints moved = count_supported(scene, beside);
  EXPECT_GE(moved.supported_beside, found.supported * 9 / 10);
  EXPECT_FALSE(moved.exceeds_copies());
}

TEST(CountSupported, NeedsEdges) {
  const auto backend = make_cpu_backend(1);
  const std::vector<EdgeModel> models{part_model("l_bracket")};
  const std::vector<ObjectView> views{view_of_edges({{10, 10, 0, 1}}, small_camera(), 1, *backend)};
  const SupportedPoints found =
      count_supported({models, views, *backend}, {0, {so3_exp({0.6, 0.3, 0.2}), {0, 0, 0.35}}});
  EXPECT_GT(found.in_image, 50);
  EXPECT_EQ(found.supported, 0u);
  EXPECT_FALSE(found.exceeds_copies()) << "nothing is no more than nothing";
}

}  // namespace
}  // namespace edgescout::test
