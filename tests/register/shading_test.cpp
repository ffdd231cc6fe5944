// Images whose grey values are a known function of the surface: a right pose explains them, a wrong
// pose does not.
#include "host/register/shading.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/register/occluders.h"
#include "host/register/pose_classifier.h"
#include "host/render/parts.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

constexpr int width = 320, height = 240;
const Camera camera{width, height, 500, 500, 159.5, 119.5, {}};

// Grey of a matte surface under one light and the sky, from the normal of the first triangle along
// the ray of each pixel. `background` elsewhere.
Image shaded(const Mesh& mesh, const Se3& camera_from_object, const auto& background) {
  Image image{width, height, std::vector<std::uint8_t>(std::size_t(width) * height)};
  const Eigen::Vector3d light = Eigen::Vector3d(0.5, -0.7, -0.6).normalized();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector3d ray((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1);
      double nearest = INFINITY, grey = background(x, y);
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& corner = mesh.triangles[t];
        Eigen::Matrix3d corners;
        for (int c = 0; c < 3; ++c)
          corners.col(c) = camera_from_object * mesh.vertices_m[corner[c]];
        // ray * z = corners * barycentric, barycentric summing to one.
        const Eigen::Vector3d weights = corners.inverse() * ray;
        if (!(weights.minCoeff() >= -1e-9) || weights.sum() <= 0 || 1 / weights.sum() >= nearest)
          continue;
        nearest = 1 / weights.sum();
        const Eigen::Vector3d normal = camera_from_object.rotation * mesh.face_normals[t];
        grey = 60 + 30 * (1 - normal.y()) / 2 + 120 * std::max(0.0, normal.dot(light));
      }
      image.pixels[std::size_t(y) * width + x] =
          std::uint8_t(std::lround(std::clamp(grey, 0.0, 255.0)));
    }
  return image;
}

struct ShadedPart {
  EdgeModel model;
  Se3 truth;
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  ObjectView view;

  explicit ShadedPart(const std::string& name) : model(make_edge_model(make_part(name).mesh)) {
    truth.rotation = Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 0.4, 0.2).normalized());
    truth.translation_m = {0.004, -0.003, 0.32};
    view.camera = camera;
    view.tensor = backend->make_view({}, width, height, {}, {500, 500, 159.5f, 119.5f}, {});
  }
  void show(const Image& image) {
    view.image = std::make_shared<Image>(image);
    view.tensor = backend->make_view({}, width, height, {width, height, view.image->pixels.data()},
                                     {500, 500, 159.5f, 119.5f}, {});
  }
  Shading at(const Se3& pose) const {
    const ObjectPose start{0, pose};
    return shading({{&model, 1}, {&view, 1}, *backend}, {&start, 1})(0, 0);
  }
};

class ShadingOfParts : public ::testing::TestWithParam<std::string> {};

TEST_P(ShadingOfParts, IsExplainedByTheRightPoseOnly) {
  ShadedPart part(GetParam());
  Random random = test_random();
  part.show(shaded(part.model.mesh, part.truth, [&](int, int) { return random.uniform(0, 255); }));
  const double right = unexplained_grey(part.at(part.truth));
  Se3 aside = part.truth, turned = part.truth;
  aside.translation_m.x() += 0.4 * part.model.mesh.diameter_m;
  turned.rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, 1, 0).normalized()) * part.truth.rotation;
  std::printf("right %.3f, aside %.3f, turned %.3f\n", right, unexplained_grey(part.at(aside)),
              unexplained_grey(part.at(turned)));
  EXPECT_LT(right, 0.2);
  EXPECT_GT(unexplained_grey(part.at(aside)), 2 * right);
  EXPECT_GT(unexplained_grey(part.at(turned)), 2 * right);
}

INSTANTIATE_TEST_SUITE_P(Parts, ShadingOfParts,
                         ::testing::Values("l_bracket", "bearing_block", "hex_nut"),
                         [](const auto& parameter) { return parameter.param; });

TEST(Shading, OfNoiseAndOfNothingIsNotExplained) {
  ShadedPart part("l_bracket");
  EXPECT_EQ(part.at(part.truth).pixels, 0) << "no image";
  EXPECT_EQ(unexplained_grey(Shading{}), 1);
  Image image{width, height, std::vector<std::uint8_t>(std::size_t(width) * height, 90)};
  part.show(image);
  EXPECT_EQ(unexplained_grey(part.at(part.truth)), 1) << "one grey everywhere";
  Random random = test_random();
  for (std::uint8_t& pixel : image.pixels) pixel = std::uint8_t(random.below(256));
  part.show(image);
  EXPECT_GT(unexplained_grey(part.at(part.truth)), 0.98);
  Se3 outside = part.truth;
  outside.translation_m.x() = 1;
  EXPECT_EQ(part.at(outside).pixels, 0);
}

TEST(Shading, AddsUpOverViews) {
  ShadedPart part("bearing_block");
  part.show(shaded(part.model.mesh, part.truth, [](int, int) { return 200.0; }));
  const Shading one = part.at(part.truth);
  ASSERT_GT(one.pixels, 100);
  Shading both = one;
  add(both, one);
  EXPECT_EQ(both.pixels, 2 * one.pixels);
  EXPECT_NEAR(unexplained_grey(both), unexplained_grey(one), 1e-12);
}

// Noise where another, known part hides the part. Without the occluder the surface explains little.
TEST(Shading, LeavesOutWhatKnownPartsHide) {
  ShadedPart part("l_bracket");
  Se3 nearer = part.truth;
  nearer.translation_m += Eigen::Vector3d(0.012, 0, -0.08);
  const EdgeModel cover = make_edge_model(make_part("bearing_block").mesh);
  Random random = test_random();
  Image image = shaded(part.model.mesh, part.truth, [](int, int) { return 10.0; });
  const Image before = shaded(cover.mesh, nearer, [](int, int) { return 0.0; });
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (before.pixels[i] > 0) image.pixels[i] = std::uint8_t(random.below(256));
  part.show(image);
  const Shading blind = part.at(part.truth);
  const ObjectPose known{0, nearer};
  part.view.occluders = make_occluders({&cover, 1}, {&known, 1}, part.view, *part.backend);
  const Shading knowing = part.at(part.truth);
  EXPECT_GT(unexplained_grey(blind), 0.5);
  EXPECT_LT(unexplained_grey(knowing), 0.2);
  EXPECT_LT(knowing.pixels, 0.9 * blind.pixels);
  EXPECT_GT(knowing.pixels, 60);
}

// The cells of several objects' poses in several views.
TEST(Shading, HasARowPerPoseAndAColumnPerView) {
  ShadedPart part("l_bracket");
  part.show(shaded(part.model.mesh, part.truth, [](int, int) { return 10.0; }));
  const std::vector<EdgeModel> models{make_edge_model(make_part("hex_nut").mesh), part.model};
  ObjectView blind = part.view;
  blind.image = nullptr;
  const std::vector<ObjectView> views{blind, part.view};
  const std::vector<ObjectPose> poses{{1, part.truth}, {0, part.truth}, {1, part.truth}};
  const Grid<Shading> all = shading({models, views, *part.backend}, poses);
  ASSERT_EQ(all.rows(), 3u);
  ASSERT_EQ(all.columns(), 2u);
  for (std::size_t p : {0, 1, 2}) EXPECT_EQ(all(p, 0).pixels, 0);
  const Shading alone = part.at(part.truth);
  for (std::size_t p : {0, 2}) EXPECT_EQ(all(p, 1).unexplained, alone.unexplained);
  EXPECT_NE(all(1, 1).pixels, alone.pixels);
}

}  // namespace
}  // namespace edgescout::test
