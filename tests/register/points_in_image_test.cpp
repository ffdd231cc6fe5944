#include "host/register/points_in_image.h"

#include <gtest/gtest.h>

#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

bool is_in(const Camera& camera, const Se3& camera_from_object, const ModelPoint& point) {
  const Eigen::Vector3d x = camera_from_object * Eigen::Vector3d(point.x_m, point.y_m, point.z_m);
  const double u = camera.fx * x.x() / x.z() + camera.cx, v = camera.fy * x.y() / x.z() + camera.cy;
  return x.z() > 0 && u >= 0 && v >= 0 && u <= camera.width - 1 && v <= camera.height - 1;
}

// Poses in, across and beyond the border, and behind the camera.
TEST(PointsInImage, AgreeWithTheProjectionOfEachPoint) {
  Random random = test_random();
  const EdgeModel model = part_model("l_bracket");
  const Camera camera = scene_camera();
  const auto backend = make_cpu_backend(1);
  int whole = 0, cut = 0, kept_all = 0;
  for (int i = 0; i < 1000; ++i) {
    const Se3 pose{
        random.rotation(),
        {random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15), random.uniform(-0.05, 0.4)}};
    const std::vector<ModelPoint> points = visible_edges(model, std::span(&pose, 1), *backend)[0];
    std::vector<ModelPoint> expected;
    for (const ModelPoint& point : points)
      if (is_in(camera, pose, point)) expected.push_back(point);
    const std::size_t outside = points.size() - expected.size();
    EXPECT_EQ(count_outside(points, model, camera, pose), outside);
    if (is_wholly_in(camera, model, pose)) {
      EXPECT_EQ(outside, 0u);
      ++whole;
    }
    std::vector<ModelPoint> left = points;
    remove_outside(left, model, camera, pose);
    const bool are_most_outside = 2 * outside > points.size();
    kept_all += are_most_outside;
    cut += outside > 0 && !are_most_outside;
    const std::vector<ModelPoint>& wanted = are_most_outside ? points : expected;
    ASSERT_EQ(left.size(), wanted.size());
    for (std::size_t k = 0; k < left.size(); ++k) EXPECT_EQ(left[k].x_m, wanted[k].x_m);
  }
  EXPECT_GT(whole, 20);
  EXPECT_GT(cut, 20);
  EXPECT_GT(kept_all, 20);
}

}  // namespace
}  // namespace edgescout::test
