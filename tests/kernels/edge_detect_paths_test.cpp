// The edge detector on every path against the reference: the same pixels in the same order
// (edge_detect.h).
#include "kernels/error.h"
#include "tests/kernels/paths.h"
#include "tests/kernels/pictures.h"

namespace edgescout {
namespace {

double turn_between(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, std::numbers::pi - d);
}

void expect_same_edges(const std::vector<EdgePoint>& found,
                       const std::vector<EdgePoint>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i].x_px, expected[i].x_px, 1e-3) << i;
    EXPECT_NEAR(found[i].y_px, expected[i].y_px, 1e-3) << i;
    EXPECT_LT(turn_between(found[i].theta_rad, expected[i].theta_rad), 1e-3) << i;
    EXPECT_GE(found[i].theta_rad, 0) << i;
    EXPECT_LT(found[i].theta_rad, std::numbers::pi_v<float>) << i;
    EXPECT_NEAR(found[i].strength, expected[i].strength, 1e-5 * expected[i].strength) << i;
  }
}

class EdgeDetectPaths : public test::PathTest {};

TEST_P(EdgeDetectPaths, FindsTheEdgesOfTheReference) {
  std::mt19937 rng = test::test_rng();
  std::size_t edges = 0;
  for (const test::Picture& picture : test::random_pictures(rng))
    for (const float sigma : {0.4f, 1.0f, 8.0f}) {
      SCOPED_TRACE(picture.size() + ", sigma " + std::to_string(sigma));
      EdgeOptions options;
      options.sigma_px = sigma;
      options.min_length_px = 4;
      const std::vector<EdgePoint> expected = reference->detect_edges(picture.view(), options);
      expect_same_edges(tested->detect_edges(picture.view(), options), expected);
      edges += expected.size();
    }
  EXPECT_GT(edges, 2000u);
}

// Stripes, an edge every five pixels: more edge pixels than a device lists at first.
TEST_P(EdgeDetectPaths, FindsUncommonlyManyEdges) {
  constexpr int width = 700, height = 520;
  std::vector<std::uint8_t> pixels(std::size_t(width) * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      pixels[std::size_t(y) * width + x] = (x + y / 7) / 5 % 2 == 0 ? 40 : 200;
  const ImageView stripes{width, height, pixels.data()};
  const std::vector<EdgePoint> expected = reference->detect_edges(stripes, {});
  ASSERT_GT(expected.size(), std::size_t{1} << 16);
  expect_same_edges(tested->detect_edges(stripes, {}), expected);
}

TEST_P(EdgeDetectPaths, BadOptionsAndImages) {
  EdgeOptions options;
  options.sigma_px = 0;
  const std::uint8_t pixel = 3;
  EXPECT_THROW(tested->detect_edges({1, 1, &pixel}, options), InputError);
  EXPECT_THROW(tested->detect_edges({}, {}), LogicError);
}

INSTANTIATE_TEST_SUITE_P(Paths, EdgeDetectPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
