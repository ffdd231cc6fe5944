// dcd_seed alone: its cells hold every distinct seed once, in the right cell (kernels/dcd_seed.h).
#ifdef EDGESCOUT_VULKAN
#include "kernels/dcd_seed.h"

#include <set>
#include <tuple>

#include "kernels/dcd_tensor.h"
#include "kernels/gpu/dcd_seed.h"
#include "tests/kernels/gpu_fixture.h"

namespace edgescout {
namespace {

using SeedSet = std::set<std::tuple<int, int, int>>;  // bin, y, x

class DcdSeedTest : public test::GpuTest {
 protected:
  // Reads the lists cell by cell; every seed must lie in its cell, and appear once.
  SeedSet listed(const gpu::SeedLists& lists, const TensorShape& shape, std::size_t points) const {
    const std::size_t cells = std::size_t(shape.bins) * lists.cell_rows * lists.cell_columns;
    const auto table = read<std::uint32_t>(lists.cells, cells * DCD_SEED_CELL_WORDS);
    const auto seeds = read<std::uint32_t>(lists.seeds, points);
    SeedSet set;
    for (std::size_t c = 0; c < cells; ++c)
      for (std::uint32_t i = 0; i < table[c * DCD_SEED_CELL_WORDS + 1]; ++i) {
        const std::uint32_t seed = seeds.at(table[c * DCD_SEED_CELL_WORDS] + i), x = seed & 0xffffu,
                            y = seed >> 16;
        const std::size_t bin = c / (lists.cell_rows * lists.cell_columns);
        EXPECT_EQ((bin * lists.cell_rows + y / DCD_CELL) * lists.cell_columns + x / DCD_CELL, c);
        EXPECT_TRUE(set.emplace(int(bin), int(y), int(x)).second) << "twice: " << x << ", " << y;
      }
    return set;
  }
};

TEST_F(DcdSeedTest, ListsEveryDistinctSeedOnce) {
  std::mt19937 rng = test::test_rng();
  const gpu::DcdSeed kernel(*device);
  gpu::SeedLists lists;
  for (const TensorShape& shape : std::vector<TensorShape>{
           {1, 1, 4}, {7, 5, 60}, {33, 17, 60}, {32, 64, 10}, {131, 70, 128}}) {
    SCOPED_TRACE(std::to_string(shape.width) + "x" + std::to_string(shape.height));
    std::vector<EdgePoint> edges =
        test::random_edges(rng, shape.width, shape.height, shape.width * 5);
    edges.insert(edges.end(), edges.begin(),
                 edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2));
    SeedSet expected;
    for (const EdgePoint& edge : edges)
      if (const Seed seed = seed_of(edge, shape); seed.bin >= 0)
        expected.emplace(seed.bin, seed.y, seed.x);
    gpu::Batch batch(*device, "dcd_seed");
    kernel.record(batch, edges, shape, lists);
    batch.run();
    EXPECT_EQ(listed(lists, shape, edges.size()), expected);
  }
}

// A device takes so many workgroups along one dimension: 65,535 of 64 points here.
TEST_F(DcdSeedTest, TakesMorePointsThanGroupsStandInARow) {
  const TensorShape shape{40, 40, 4};
  std::vector<EdgePoint> edges((std::size_t{1} << 22) + 1, {3, 4, 0, 10});
  edges.push_back({39, 38, 0, 10});
  const gpu::DcdSeed kernel(*device);
  gpu::SeedLists lists;
  gpu::Batch batch(*device, "dcd_seed");
  kernel.record(batch, edges, shape, lists);
  batch.run();
  EXPECT_EQ(listed(lists, shape, edges.size()), (SeedSet{{0, 4, 3}, {0, 38, 39}}));
}

}  // namespace
}  // namespace edgescout
#endif
