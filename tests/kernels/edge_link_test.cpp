// edge_link alone: hysteresis keeps and drops whole components as the reference does
// (kernels/edge_stages.h).
#ifdef EDGESCOUT_VULKAN
#include "kernels/gpu/edge_detect.h"

#include "kernels/edge_stages.h"
#include "tests/kernels/gpu_fixture.h"
#include "tests/kernels/pictures.h"

namespace edgescout {
namespace {

class EdgeLinkTest : public test::GpuTest {
 protected:
  void expect_kept(gpu::EdgeDetect& detect, const test::Picture& picture,
                   const EdgeOptions& options) {
    gpu::Batch batch(*device, "edges");
    detect.record_pixels(batch, picture.view(), options);
    batch.run();
    const auto gradient = edge_gradient_reference(picture.view(), edge_weights(options.sigma_px));
    const auto candidates = edge_thin_reference(gradient, picture.width, picture.height,
                                                edge_threshold(options.low_threshold));
    const auto kept =
        edge_link_reference(gradient, candidates, picture.width, picture.height,
                            edge_threshold(options.high_threshold), options.min_length_px);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < kept.size(); ++i)
      if (kept[i]) expected.push_back(i);
    EXPECT_EQ(detect.pixels(), expected);
  }
};

TEST_F(EdgeLinkTest, KeepsTheComponentsOfTheReference) {
  std::mt19937 rng = test::test_rng();
  gpu::EdgeDetect detect(*device);
  for (const test::Picture& picture : test::random_pictures(rng))
    for (const int min_length : {1, 8, 40}) {
      SCOPED_TRACE(picture.size() + ", min_length " + std::to_string(min_length));
      EdgeOptions options;
      options.high_threshold = 25;
      options.min_length_px = min_length;
      expect_kept(detect, picture, options);
    }
}

// A spiral is one component whose pixels are far from each other in the order of rows: the hard
// case of union-find.
TEST_F(EdgeLinkTest, FollowsASpiral) {
  test::Picture picture{160, 150, std::vector<std::uint8_t>(160 * 150, 20)};
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const double r = std::hypot(x - 80, y - 75),
                   turn = std::atan2(y - 75, x - 80) / (2 * std::numbers::pi);
      if (r < 70 && std::fmod(r / 14 - turn + 1, 1.0) < 0.5)
        picture.pixels[std::size_t(y) * 160 + x] = 200;
    }
  gpu::EdgeDetect detect(*device);
  EdgeOptions options;
  for (const int min_length : {8, 300, 1200}) {
    options.min_length_px = min_length;
    expect_kept(detect, picture, options);
  }
}

}  // namespace
}  // namespace edgescout
#endif
