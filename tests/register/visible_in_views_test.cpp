// All poses and views in one call, compared with one call for each.
#include "host/register/visible_in_views.h"

#include <gtest/gtest.h>

#include "host/register/occluders.h"
#include "kernels/error.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

void expect_same(const std::vector<ModelPoint>& found, const std::vector<ModelPoint>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].x_m, expected[i].x_m);
    EXPECT_EQ(found[i].y_m, expected[i].y_m);
    EXPECT_EQ(found[i].z_m, expected[i].z_m);
  }
}

TEST(VisibleInViews, EqualSingleCalls) {
  Random random = test_random();
  const auto backend = make_cpu_backend(2);
  const std::vector<EdgeModel> models{part_model("l_bracket"), part_model("bearing_block")};
  std::vector<ObjectPose> poses;
  for (const int object : {1, 0, 1})
    poses.push_back({object, {random.rotation(), 0.02 * random.direction()}});
  std::vector<ObjectView> views(2);
  for (ObjectView& view : views) {
    view.camera = scene_camera();
    view.camera_from_world = camera_looking_at(0.4 * random.direction(), Eigen::Vector3d::Zero());
  }
  const ObjectPose cover{0,
                         inverse(views[1].camera_from_world) * Se3{random.rotation(), {0, 0, 0.2}}};
  views[1].occluders = make_occluders(models, {&cover, 1}, views[1], *backend);

  const Grid<VisibleInView> visible = visible_in_views({models, views, *backend}, poses);
  ASSERT_EQ(visible.rows(), 3u);
  ASSERT_EQ(visible.columns(), 2u);
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const VisibleInView& cell = visible(i / 2, i % 2);
    const ObjectPose& pose = poses[i / 2];
    const EdgeModel& model = models[std::size_t(pose.object)];
    const Se3 camera_from_object = views[i % 2].camera_from_world * pose.world_from_object;
    std::vector<ModelPoint> expected = visible_edges(model, {&camera_from_object, 1}, *backend)[0];
    EXPECT_GT(expected.size(), 100u);
    EXPECT_EQ(cell.unoccluded, expected.size());
    if (i % 2 == 1)
      hidden += std::erase_if(expected, [&](const ModelPoint& p) {
        return views[1].occluders->hide(camera_from_object * Eigen::Vector3d(p.x_m, p.y_m, p.z_m),
                                        occlusion_tolerance_m(model));
      });
    expect_same(cell.points, expected);
  }
  EXPECT_GT(hidden, 100u);
}

TEST(VisibleInViews, RefusesAnObjectThatIsNone) {
  const auto backend = make_cpu_backend(1);
  const EdgeModel model = part_model("l_bracket");
  ObjectView view;
  view.camera = scene_camera();
  for (const int object : {-1, 1}) {
    const ObjectPose pose{object, {Eigen::Quaterniond::Identity(), {0, 0, 0.4}}};
    EXPECT_THROW(visible_in_views({{&model, 1}, {&view, 1}, *backend}, {&pose, 1}), LogicError);
  }
  EXPECT_TRUE(visible_in_views({{&model, 1}, {&view, 1}, *backend}, {}).values().empty());
}

}  // namespace
}  // namespace edgescout::test
