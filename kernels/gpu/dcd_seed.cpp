#include "kernels/gpu/dcd_seed.h"

#include <numbers>

#include "dcd_seed.spv.h"
#include "kernels/dcd_seed.h"

namespace edgescout::gpu {

namespace {

Kernel make_pass(const Device& device, std::uint32_t pass) {
  return Kernel(device, {"dcd_seed", dcd_seed_spv, 6, sizeof(DcdSeedPush), {pass}});
}

}  // namespace

DcdSeed::DcdSeed(const Device& device)
    : device_(device),
      passes_{make_pass(device, DCD_SEED_MARK), make_pass(device, DCD_SEED_OFFSETS),
              make_pass(device, DCD_SEED_FILL)} {}

void DcdSeed::record(Batch& batch, std::span<const EdgePoint> edges, const TensorShape& shape,
                     SeedLists& lists) const {
  const auto count = static_cast<std::uint32_t>(edges.size());
  const auto width = static_cast<std::uint32_t>(shape.width),
             height = static_cast<std::uint32_t>(shape.height);
  const auto bins = static_cast<std::uint32_t>(shape.bins);
  const std::uint32_t words = (width + 31) / 32;
  lists.cell_columns = groups_for(width, DCD_CELL);
  lists.cell_rows = groups_for(height, DCD_CELL);
  const std::size_t cell_rows = std::size_t(bins) * lists.cell_rows,
                    plane_words = std::size_t(bins) * height * words,
                    cell_words = cell_rows * lists.cell_columns * DCD_SEED_CELL_WORDS;
  lists.points.reserve(device_, count, "edge points");
  lists.planes.reserve(device_, plane_words, "seed planes");
  lists.cells.reserve(device_, cell_words, "seed cells");
  lists.seeds.reserve(device_, count, "seeds");
  lists.slots.reserve(device_, count, "seed slots");
  lists.placed.reserve(device_, 1, "seed count");

  const DcdSeedPush push{count,           width,
                         height,          bins,
                         words,           lists.cell_columns,
                         lists.cell_rows, shape.bins / std::numbers::pi_v<float>};
  const auto dispatch = [&](std::uint32_t pass, std::size_t invocations) {
    batch.dispatch(
        passes_[pass], spread(groups_for(invocations, DCD_SEED_GROUP)),
        {lists.points, lists.planes, lists.cells, lists.seeds, lists.slots, lists.placed}, push);
    batch.barrier();
  };
  batch.upload(lists.points, edges);
  batch.fill(lists.planes, plane_words * sizeof(std::uint32_t), 0);
  batch.fill(lists.cells, cell_words * sizeof(std::uint32_t), 0);
  batch.fill(lists.placed, sizeof(std::uint32_t), 0);
  batch.barrier();
  dispatch(DCD_SEED_MARK, count);
  dispatch(DCD_SEED_OFFSETS, cell_rows);
  dispatch(DCD_SEED_FILL, count);
}

}  // namespace edgescout::gpu
