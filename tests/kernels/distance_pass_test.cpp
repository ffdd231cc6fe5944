// distance_pass alone: capped distances to the nearest seed of each bin, exact
// (kernels/distance_pass.h).
#ifdef EDGESCOUT_VULKAN
#include "kernels/distance_pass.h"

#include <cmath>

#include "kernels/dcd_tensor.h"
#include "kernels/gpu/distance_pass.h"
#include "tests/kernels/gpu_fixture.h"

namespace edgescout {
namespace {

// Every pixel asks every seed.
std::vector<std::uint16_t> brute_force(std::span<const EdgePoint> edges, const TensorShape& shape,
                                       std::uint32_t cap) {
  std::vector<std::uint16_t> values(shape.size(), static_cast<std::uint16_t>(cap));
  for (const EdgePoint& edge : edges) {
    const Seed seed = seed_of(edge, shape);
    if (seed.bin < 0) continue;
    for (int y = 0; y < shape.height; ++y)
      for (int x = 0; x < shape.width; ++x) {
        const long squared = long(x - seed.x) * (x - seed.x) + long(y - seed.y) * (y - seed.y);
        const long units = std::lround(256.0L * std::sqrt(static_cast<long double>(squared)));
        std::uint16_t& value = values[shape.index(x, y, seed.bin)];
        if (units < long(value)) value = static_cast<std::uint16_t>(units);
      }
  }
  return values;
}

class DistancePassTest : public test::GpuTest {
 protected:
  std::vector<std::uint16_t> distances(std::span<const EdgePoint> edges, const TensorShape& shape,
                                       std::uint32_t cap) {
    const gpu::DcdSeed seed(*device);
    const gpu::DistancePass pass(*device);
    const gpu::DeviceTensor tensor(*device, shape);
    gpu::SeedLists lists;
    gpu::Batch batch(*device, "distances");
    seed.record(batch, edges, shape, lists);
    pass.record(batch, lists, cap, tensor);
    batch.run();
    return read<std::uint16_t>(tensor.buffer(), shape.size());
  }
};

TEST_F(DistancePassTest, MeetsBruteForce) {
  std::mt19937 rng = test::test_rng();
  for (const TensorShape& shape :
       std::vector<TensorShape>{{1, 1, 4}, {7, 5, 6}, {33, 17, 12}, {97, 130, 4}})
    for (const std::uint32_t cap : {1u, 256u, 8192u, 15360u, 65280u}) {
      SCOPED_TRACE(std::to_string(shape.width) + "x" + std::to_string(shape.height) + " cap " +
                   std::to_string(cap));
      const std::vector<EdgePoint> edges = test::random_edges(rng, shape.width, shape.height, 8);
      EXPECT_EQ(distances(edges, shape, cap), brute_force(edges, shape, cap));
    }
}

// One seed in a corner: every squared distance up to the largest cap is rounded, so that a root one
// unit off would show.
TEST_F(DistancePassTest, EveryRootIsExact) {
  const TensorShape shape{256, 256, 4};
  const std::vector<EdgePoint> corner{{0, 0, 0, 1}};
  EXPECT_EQ(distances(corner, shape, 65280), brute_force(corner, shape, 65280));
}

// As many seeds within the largest cap as there can be: those below the gap come last, after more
// turns than lavapipe lets a shader's loop take.
TEST_F(DistancePassTest, LooksAtEverySeedOfTheFullestWindow) {
  const int side = 17 * int(DCD_CELL), gap = 8 * int(DCD_CELL);
  std::vector<EdgePoint> edges;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side && y / int(DCD_CELL) != 8; ++x)
      edges.push_back({float(x), float(y), 0, 1});
  const TensorShape shape{side, side, 4};
  const std::vector<std::uint16_t> found = distances(edges, shape, 65280);
  for (int y = 0; y < side; ++y) {
    const int expected = std::max(0, std::min(y - gap + 1, gap + int(DCD_CELL) - y));
    for (int x = 0; x < side; ++x)
      ASSERT_EQ(found[shape.index(x, y, 0)], 256 * expected) << x << ", " << y;
  }
}

}  // namespace
}  // namespace edgescout
#endif
