// support_map against an oracle written from support_map.h's prose, and every path against the
// reference, bit for bit.
#include "kernels/support_map.h"

#include "kernels/edge_stages.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"
#include "tests/kernels/gpu_fixture.h"
#include "tests/kernels/pictures.h"

#ifdef EDGESCOUT_VULKAN
#include "kernels/gpu/support_map.h"
#endif

namespace edgescout {
namespace {

constexpr int WINDOW = static_cast<int>(SUPPORT_WINDOW), BINS = static_cast<int>(SUPPORT_BINS);

// The gradient stages have oracles of their own.
struct Candidates {
  const test::Picture& picture;
  std::vector<std::int16_t> gradient = edge_gradient_reference(picture.view(), edge_weights(1));
  std::vector<std::uint8_t> marks =
      edge_thin_reference(gradient, picture.width, picture.height, edge_threshold(3));
  bool has(int x, int y) const {
    return x >= 0 && y >= 0 && x < picture.width && y < picture.height &&
           marks[std::size_t(y) * picture.width + x];
  }
  double angle(int x, int y) const {
    const std::size_t i = std::size_t(y) * picture.width + x;
    return std::atan2(gradient[2 * i + 1], gradient[2 * i]);
  }
};

// 1: supported, 0: not, -1: a turn so near the limit that rounding decides.
int oracle(const Candidates& candidates, int x, int y, int bin) {
  const double normal = std::numbers::pi * bin / BINS, nx = std::cos(normal), ny = std::sin(normal);
  int found = 0;
  for (int dy = -WINDOW; dy <= WINDOW; ++dy)
    for (int dx = -WINDOW; dx <= WINDOW; ++dx) {
      if (!candidates.has(x + dx, y + dy)) continue;
      if (std::abs(dx * nx + dy * ny) > 2.25 || std::abs(dx * ny - dy * nx) > 0.75) continue;
      const double turn =
          std::remainder(candidates.angle(x + dx, y + dy) - normal, std::numbers::pi);
      const double excess = std::abs(turn) - 20 * std::numbers::pi / 180;
      if (std::abs(excess) < 2e-4) return -1;
      found |= excess < 0;
    }
  return found;
}

TEST(SupportMap, OfTheReferenceAgreesWithTheProse) {
  std::mt19937 rng = test::test_rng();
  int supported = 0, undecided = 0;
  for (const test::Picture& picture : test::random_pictures(rng)) {
    const std::vector<std::uint32_t> map = support_map_reference(picture.view());
    ASSERT_EQ(map.size(), picture.pixels.size());
    const Candidates candidates{picture};
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        for (int bin = 0; bin < BINS; ++bin) {
          const int expected = oracle(candidates, x, y, bin);
          undecided += expected < 0;
          if (expected < 0) continue;
          supported += expected;
          ASSERT_EQ(map[std::size_t(y) * picture.width + x] >> bin & 1u, unsigned(expected))
              << picture.size() << " at " << x << ", " << y << ", bin " << bin;
        }
  }
  EXPECT_GT(supported, 10000);
  EXPECT_LT(undecided, supported / 100);
}

// Dark on the left, brighter by `step` from column 16 on.
test::Picture step_picture(int step) {
  test::Picture picture{33, 33, {}};
  for (int i = 0; i < 33 * 33; ++i)
    picture.pixels.push_back(static_cast<std::uint8_t>(20 + (i % 33 < 16 ? 0 : step)));
  return picture;
}

// The edge lies between columns 15 and 16, of which the first is the local maximum. Its normal
// points along x.
TEST(SupportMap, KnowsAStraightEdge) {
  const std::vector<std::uint32_t> map = support_map_reference(step_picture(100).view());
  const auto supports = [&](int x, int bin) {
    return (map[16 * 33 + std::size_t(x)] >> bin & 1u) != 0;
  };
  for (int x = 0; x < 33; ++x) EXPECT_EQ(supports(x, 0), x >= 13 && x <= 17) << x;
  for (const int bin : {3, 29}) EXPECT_TRUE(supports(15, bin)) << "17 degrees";
  for (const int bin : {4, 16, 28}) EXPECT_FALSE(supports(15, bin)) << "22 degrees or more";
}

// A step of sigma 1 has a gradient of 0.4 a pixel times its height, or a little less.
TEST(SupportMap, LeavesOutWeakEdges) {
  for (const auto& [step, expected] : {std::pair{0, 0}, {6, 0}, {10, 1}}) {
    const std::vector<std::uint32_t> map = support_map_reference(step_picture(step).view());
    EXPECT_EQ(map[16 * 33 + 15] & 1u, unsigned(expected)) << "step of " << step;
  }
}

// However thin chains run, a normal that crosses them finds a pixel.
TEST(SupportMap, LetsNoChainSlipThrough) {
  for (int degrees = 0; degrees < 180; degrees += 3) {
    const double angle = degrees * std::numbers::pi / 180, nx = std::cos(angle),
                 ny = std::sin(angle);
    test::Picture picture{61, 61, {}};
    for (int y = 0; y < 61; ++y)
      for (int x = 0; x < 61; ++x)
        picture.pixels.push_back(static_cast<std::uint8_t>(
            std::lround(127 + 80 * std::tanh((x - 30) * nx + (y - 30) * ny))));
    const std::vector<std::uint32_t> map = support_map_reference(picture.view());
    const int bin = static_cast<int>(std::lround(angle * BINS / std::numbers::pi)) % BINS;
    for (int along = -15; along <= 15; ++along)
      for (const double across : {-1.5, -0.7, 0.0, 0.7, 1.5}) {
        const auto x = std::lround(30 + across * nx - along * ny),
                   y = std::lround(30 + across * ny + along * nx);
        EXPECT_TRUE(map[std::size_t(y * 61 + x)] >> bin & 1u)
            << degrees << " degrees, " << along << " along, " << across << " across";
      }
  }
}

TEST(SupportMap, OfTheFastPathIsThatOfTheReference) {
  std::mt19937 rng = test::test_rng();
  ThreadPool pool(2);
  for (const test::Picture& picture : test::random_pictures(rng))
    EXPECT_EQ(support_map_fast(picture.view(), pool), support_map_reference(picture.view()))
        << picture.size();
}

TEST(SupportMap, AnImageWithoutPixelsIsOurBug) {
  ThreadPool pool(1);
  EXPECT_THROW(support_map_reference({}), LogicError);
  EXPECT_THROW(support_map_fast({}, pool), LogicError);
}

#ifdef EDGESCOUT_VULKAN
class SupportMapOnDevice : public test::GpuTest {};

TEST_F(SupportMapOnDevice, IsThatOfTheReference) {
  std::mt19937 rng = test::test_rng();
  gpu::SupportMapper mapper(*device);
  for (const test::Picture& picture : test::random_pictures(rng)) {
    gpu::Buffer<std::uint32_t> map, pixels;
    gpu::Batch batch(*device, "support map");
    mapper.record(batch, picture.view(), map, pixels);
    batch.run();
    EXPECT_EQ(read<std::uint32_t>(map, picture.pixels.size()),
              support_map_reference(picture.view()))
        << picture.size();
    EXPECT_EQ(read<std::uint8_t>(pixels, picture.pixels.size()), picture.pixels) << picture.size();
  }
}
#endif

}  // namespace
}  // namespace edgescout
