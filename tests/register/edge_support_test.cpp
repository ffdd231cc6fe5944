// Edge support of parts at known poses in pictures of them.
#include "host/register/edge_support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/register/occluders.h"
#include "tests/register/scene.h"

namespace edgescout::test {
namespace {

// A part 0.3 m before the camera. Its faces have the grey of their direction, so that creases and
// silhouette have contrast.
struct PicturedPart {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  EdgeModel model;
  Se3 truth{so3_exp({0.5, -0.6, 0.3}), {0.01, -0.005, 0.3}};
  Camera camera = scene_camera();
  ObjectView view;

  explicit PicturedPart(const std::string& part) : model(part_model(part)) {
    view.camera = camera;
    show(picture());
  }
  void show(const Image& image) {
    view.image = std::make_shared<Image>(image);
    view.tensor = backend->make_view({}, camera.width, camera.height,
                                     {image.width, image.height, image.pixels.data()},
                                     intrinsics_of(camera), {});
  }
  Image flat(std::uint8_t grey) const {
    return {
        camera.width, camera.height,
        std::vector<std::uint8_t>(std::size_t(camera.width) * std::size_t(camera.height), grey)};
  }
  Image picture() const {
    Image image = flat(60);
    std::vector<double> nearest(image.pixels.size(), std::numeric_limits<double>::infinity());
    for (const std::array<int, 3>& corners : model.mesh.triangles) draw(corners, nearest, image);
    return image;
  }
  EdgeSupport at(const Se3& pose) const {
    const ObjectPose start{0, pose};
    const Scene scene{{&model, 1}, {&view, 1}, *backend};
    return edge_support(scene, {&start, 1}, marked_in_views(scene, {&start, 1}))(0, 0);
  }
  // Moved along the image plane, px.
  EdgeSupport displaced(double x_px, double y_px) const {
    Se3 pose = truth;
    pose.translation_m += Eigen::Vector3d(x_px, y_px, 0) * truth.translation_m.z() / camera.fx;
    return at(pose);
  }

 private:
  void draw(const std::array<int, 3>& corners, std::vector<double>& nearest, Image& image) const {
    Eigen::Matrix3d triangle;
    for (int c = 0; c < 3; ++c) triangle.col(c) = truth * model.mesh.vertices_m[corners[c]];
    const Eigen::Vector3d normal =
        (triangle.col(1) - triangle.col(0)).cross(triangle.col(2) - triangle.col(0)).normalized();
    const auto grey = std::uint8_t(140 + 60 * normal.x() + 40 * normal.y());
    const Eigen::Matrix3d from_ray = triangle.inverse();
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) {
        const Eigen::Vector3d weights =
            from_ray * Eigen::Vector3d((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
        const double inverse_depth = weights.sum(), depth = 1 / inverse_depth;
        const std::size_t i = std::size_t(y) * std::size_t(camera.width) + std::size_t(x);
        if (inverse_depth <= 0 || (weights.array() < 0).any() || depth >= nearest[i]) continue;
        nearest[i] = depth;
        image.pixels[i] = grey;
      }
  }
};

class EdgeSupportOfParts : public ::testing::TestWithParam<std::string> {};

TEST_P(EdgeSupportOfParts, TellsTheRightPoseFromPosesBesideIt) {
  const PicturedPart part(GetParam());
  const EdgeSupport right = part.at(part.truth), aside = part.displaced(9, 5);
  EXPECT_GT(right.support, 0.9f);
  EXPECT_GT(right.support - right.best_displaced, 0.3f);
  EXPECT_GT(right.log_ratio, 30);
  EXPECT_GT(right.interior_log_ratio, 5);
  EXPECT_LT(aside.support, 0.6f);
  EXPECT_LT(aside.support - aside.best_displaced, 0.1f);
  EXPECT_LT(aside.log_ratio, 0.3f * right.log_ratio);
}

INSTANTIATE_TEST_SUITE_P(Parts, EdgeSupportOfParts,
                         ::testing::Values("l_bracket", "bearing_block", "u_channel"),
                         [](const auto& parameter) { return parameter.param; });

// Edges that lie side by side count hardly more than one, and a finer step makes no more of them.
TEST(EdgeSupport, CountsEdgesOfOnePlaceOnce) {
  PicturedPart part("u_channel");
  const EdgeSupport once = part.at(part.truth);
  const std::vector<RasterPoint> points = part.model.crease_points;
  for (int copies = 1; copies < 8; ++copies)
    part.model.crease_points.insert(part.model.crease_points.end(), points.begin(), points.end());
  const EdgeSupport eightfold = part.at(part.truth);
  EXPECT_LT(eightfold.log_ratio, 2 * once.log_ratio);
  EXPECT_NEAR(eightfold.support, once.support, 0.05f);
  const EdgeSupport finer = [&] {
    part.model = part_model("u_channel", 0.5 * part.model.raster_step_m);
    return part.at(part.truth);
  }();
  EXPECT_NEAR(finer.log_ratio, once.log_ratio, 0.1f * once.log_ratio);
}

// Stripes support every pose, but none more than its copies.
TEST(EdgeSupport, ExpectsNothingOfTexture) {
  PicturedPart part("l_bracket");
  const double in_picture = part.at(part.truth).log_ratio;
  Image stripes = part.flat(0);
  for (std::size_t i = 0; i < stripes.pixels.size(); ++i)
    stripes.pixels[i] = i / std::size_t(stripes.width) % 6 < 3 ? 40 : 200;
  part.show(stripes);
  const EdgeSupport in_stripes = part.at(part.truth);
  EXPECT_GT(in_stripes.support, 0.1f);
  EXPECT_NEAR(in_stripes.support, in_stripes.best_displaced, 0.05f);
  EXPECT_LT(in_stripes.log_ratio, 0.1 * in_picture);
}

TEST(EdgeSupport, IsFiniteWithoutContrast) {
  PicturedPart part("bearing_block");
  for (const int grey : {0, 90, 255}) {
    part.show(part.flat(std::uint8_t(grey)));
    const EdgeSupport found = part.at(part.truth);
    EXPECT_EQ(found.support, 0);
    EXPECT_EQ(found.best_displaced, 0);
    EXPECT_TRUE(std::isfinite(found.log_ratio) && std::isfinite(found.interior_log_ratio));
    EXPECT_LT(found.log_ratio, -5);
  }
}

TEST(EdgeSupport, IsZeroWhereNothingCanBeSeen) {
  PicturedPart part("bearing_block");
  for (const Eigen::Vector3d& place : {Eigen::Vector3d(5, 0, 1), Eigen::Vector3d(0, 0, -1)}) {
    const EdgeSupport found = part.at({part.truth.rotation, place});
    EXPECT_EQ(found.log_ratio, 0);
    EXPECT_EQ(found.support, 0);
  }
  part.view.tensor = part.backend->make_view({}, part.camera.width, part.camera.height, {},
                                             intrinsics_of(part.camera), {});
  EXPECT_EQ(part.at(part.truth).log_ratio, 0) << "no image";
}

// The cells of two objects' poses in two views, one of them without an image.
TEST(EdgeSupport, HasARowPerPoseAndAColumnPerView) {
  const PicturedPart part("l_bracket");
  const std::vector<EdgeModel> models{part_model("u_channel"), part.model};
  ObjectView blind = part.view;
  blind.tensor = part.backend->make_view({}, part.camera.width, part.camera.height, {},
                                         intrinsics_of(part.camera), {});
  const std::vector<ObjectView> views{blind, part.view};
  const std::vector<ObjectPose> poses{{1, part.truth}, {0, part.truth}, {1, part.truth}};
  const Scene scene{models, views, *part.backend};
  const Grid<EdgeSupport> all = edge_support(scene, poses, marked_in_views(scene, poses));
  ASSERT_EQ(all.rows(), 3u);
  ASSERT_EQ(all.columns(), 2u);
  for (const std::size_t p : {0, 1, 2}) EXPECT_EQ(all(p, 0).support, 0);
  const EdgeSupport alone = part.at(part.truth);
  for (const std::size_t p : {0, 2}) EXPECT_EQ(all(p, 1).log_ratio, alone.log_ratio);
  EXPECT_NE(all(1, 1).log_ratio, alone.log_ratio);
}

}  // namespace
}  // namespace edgescout::test
