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

// Three poses of two parts in two views, in the second of which a known part hides some points.
struct CoveredScene {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  std::vector<EdgeModel> models{part_model("l_bracket"), part_model("bearing_block")};
  std::vector<ObjectPose> poses;
  std::vector<ObjectView> views{2};

  explicit CoveredScene(Random& random) {
    for (const int object : {1, 0, 1})
      poses.push_back({object, {random.rotation(), 0.02 * random.direction()}});
    for (ObjectView& view : views) {
      view.camera = scene_camera();
      view.camera_from_world = camera_looking_at(0.4 * random.direction(), Eigen::Vector3d::Zero());
    }
    const Se3 in_camera{random.rotation(), {0, 0, 0.2}};
    const ObjectPose cover{0, inverse(views[1].camera_from_world) * in_camera};
    views[1].occluders = make_occluders(models, {&cover, 1}, views[1], *backend);
  }
  Scene scene() const { return {models, views, *backend}; }
  const EdgeModel& model_of(std::size_t pose) const {
    return models[std::size_t(poses[pose].object)];
  }
  bool is_hidden(std::size_t pose, std::size_t view, const ModelPoint& p) const {
    const Eigen::Vector3d point_m(p.x_m, p.y_m, p.z_m);
    return view == 1 && views[1].occluders->hide(
                            views[1].camera_from_world * poses[pose].world_from_object * point_m,
                            occlusion_tolerance_m(model_of(pose)));
  }
};

TEST(VisibleInViews, EqualSingleCalls) {
  Random random = test_random();
  const CoveredScene t(random);
  const Grid<VisibleInView> visible = visible_in_views(t.scene(), t.poses),
                            marked = marked_in_views(t.scene(), t.poses);
  ASSERT_EQ(visible.rows(), 3u);
  ASSERT_EQ(visible.columns(), 2u);
  std::size_t hidden = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const Se3 camera_from_object =
        t.views[i % 2].camera_from_world * t.poses[i / 2].world_from_object;
    std::vector<SilhouetteMarks> marks;
    const std::vector<ModelPoint> all =
        visible_edges(t.model_of(i / 2), {&camera_from_object, 1}, *t.backend, {}, &marks)[0];
    std::vector<ModelPoint> expected;
    SilhouetteMarks expected_marks;
    for (std::size_t n = 0; n < all.size(); ++n) {
      if (t.is_hidden(i / 2, i % 2, all[n])) continue;
      expected.push_back(all[n]);
      expected_marks.push_back(marks[0][n]);
    }
    EXPECT_GT(all.size(), 100u);
    hidden += all.size() - expected.size();
    EXPECT_EQ(visible.values()[i].unoccluded, all.size());
    expect_same(visible.values()[i].points, expected);
    EXPECT_TRUE(visible.values()[i].on_silhouette.empty());
    expect_same(marked.values()[i].points, expected);
    EXPECT_EQ(marked.values()[i].on_silhouette, expected_marks);
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
