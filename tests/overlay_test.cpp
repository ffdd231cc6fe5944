// Colours where they must be: a box seen from the front, with edges of the image on one side only.
#include "host/overlay.h"

#include <gtest/gtest.h>

#include <numbers>

#include "kernels/backend.h"
#include "kernels/error.h"
#include "tests/model/box.h"

namespace edgescout::test {
namespace {

// 200 x 100 px; the box of 60 x 40 mm spans x 70..130 and y 30..70 at its front face, 1 m away.
const Camera camera{200, 100, 1000, 1000, 100, 50, {}};
const Se3 in_front{Eigen::Quaterniond::Identity(), {0, 0, 1.005}};

Image grey_ground() { return {200, 100, std::vector<std::uint8_t>(200 * 100, 128)}; }
std::vector<EdgeModel> box_model() { return {make_edge_model(box_mesh(0.06, 0.04, 0.01))}; }

RgbImage draw(const OverlayPose& pose, const EdgeIndex* edges) {
  const std::unique_ptr<Backend> backend = make_cpu_backend(1);
  return draw_overlay(grey_ground(), camera, {&pose, 1}, box_model(), edges, *backend);
}

enum class Colour { Ground, Green, Orange, Cyan, Other };
Colour colour_at(const RgbImage& image, int x, int y) {
  const std::uint8_t* p = &image.pixels[std::size_t{3} * (std::size_t{200} * y + x)];
  const int r = p[0], g = p[1], b = p[2];
  if (r == g && g == b) return Colour::Ground;
  if (g > r + 60 && g > b + 60) return Colour::Green;
  if (r > g + 60 && g > b + 30) return Colour::Orange;
  if (g > r + 60 && b > r + 60) return Colour::Cyan;
  return Colour::Other;
}

TEST(Overlay, DistinguishesMatchedEdgesFromUnmatched) {
  std::vector<EdgePoint> edges;
  for (int y = 30; y <= 70; ++y)
    edges.push_back(
        {72, float(y), std::numbers::pi_v<float> / 2, 10});  // 2 px beside the left side
  for (int y = 30; y <= 70; ++y)
    edges.push_back({130, float(y), 0.5f, 10});  // on the right side, turned
  const EdgeIndex index(edges, camera.width, camera.height);
  const RgbImage picture = draw({0, in_front, std::nullopt, ""}, &index);
  for (int y = 35; y <= 45; ++y) {
    EXPECT_EQ(colour_at(picture, 70, y), Colour::Green) << y;
    EXPECT_EQ(colour_at(picture, 130, y), Colour::Orange) << y;
    EXPECT_EQ(colour_at(picture, 60, y), Colour::Ground) << y;
  }
  for (int x = 80; x <= 95; ++x) EXPECT_EQ(colour_at(picture, x, 30), Colour::Orange) << x;
}

TEST(Overlay, ClaimsNothingWithoutEdges) {
  const EdgeIndex none({}, camera.width, camera.height);
  const RgbImage picture = draw({0, in_front, std::nullopt, ""}, nullptr);
  for (int y = 35; y <= 45; ++y) {
    EXPECT_EQ(colour_at(picture, 70, y), Colour::Cyan) << y;
    EXPECT_EQ(colour_at(picture, 130, y), Colour::Cyan) << y;
  }
  EXPECT_EQ(draw({0, in_front, std::nullopt, "", false}, &none).pixels, picture.pixels)
      << "a pose that is not compared";
  const RgbImage bare = draw({0, in_front, 0.5, "box", true, false}, nullptr);
  EXPECT_EQ(colour_at(bare, 110, 50), Colour::Ground) << "no axis";
  EXPECT_EQ(colour_at(bare, 70, 40), Colour::Cyan);
}

TEST(Overlay, WritesLabelAndScore) {
  const auto plain = draw({0, in_front, std::nullopt, ""}, nullptr),
             label = draw({0, in_front, std::nullopt, "box"}, nullptr),
             both = draw({0, in_front, 0.5, "box"}, nullptr),
             other = draw({0, in_front, 0.6, "box"}, nullptr);
  EXPECT_NE(plain.pixels, label.pixels);
  EXPECT_NE(label.pixels, both.pixels);
  EXPECT_NE(both.pixels, other.pixels);
}

TEST(Overlay, DrawsAxesFromTheCentreOfTheBox) {
  const RgbImage picture = draw({0, in_front, std::nullopt, ""}, nullptr);
  const auto pixel = [&](int x, int y, int channel) {
    return int(picture.pixels[std::size_t{3} * (std::size_t{200} * y + x) + channel]);
  };
  EXPECT_GT(pixel(110, 50, 0), pixel(110, 50, 1) + 100);  // x to the right, red
  EXPECT_GT(pixel(100, 60, 1), pixel(100, 60, 0) + 100);  // y down, green
}

TEST(Overlay, LeavesOutWhatIsBehindOrFarOutside) {
  const Image ground = grey_ground();
  const RgbImage empty = [&] {
    const std::unique_ptr<Backend> backend = make_cpu_backend(1);
    return draw_overlay(ground, camera, {}, box_model(), nullptr, *backend);
  }();
  for (const Eigen::Vector3d& t :
       {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(50, 0, 1), Eigen::Vector3d(0, -1e6, 1)})
    EXPECT_EQ(draw({0, {Eigen::Quaterniond::Identity(), t}, 0.5, "x"}, nullptr).pixels,
              empty.pixels)
        << t.transpose();
}

// Its place in the image is more than an integer holds.
TEST(Overlay, WritesNothingAtAPointFarOutside) {
  const RgbImage with = draw({0, {in_front.rotation, {1e9, 0, 1e-3}}, 0.9, "far"}, nullptr);
  EXPECT_EQ(with.pixels, draw({0, {in_front.rotation, {0, 0, -1}}, 0.9, "behind"}, nullptr).pixels);
}

TEST(Overlay, NeedsACameraOfTheImagesSize) {
  const std::unique_ptr<Backend> backend = make_cpu_backend(1);
  Camera other = camera;
  other.width = 100;
  EXPECT_THROW(draw_overlay(grey_ground(), other, {}, box_model(), nullptr, *backend), LogicError);
}

}  // namespace
}  // namespace edgescout::test
