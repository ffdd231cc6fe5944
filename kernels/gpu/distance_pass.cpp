#include "kernels/gpu/distance_pass.h"

#include "distance_pass.spv.h"
#include "kernels/distance_pass.h"

namespace edgescout::gpu {

namespace {

Kernel make_kernel(const Device& device, std::uint32_t seeds_at_once) {
  const bool is_wide =
      device.info().hardware &&
      device.subgroup_size() > DISTANCE_WORDS * std::uint32_t{DISTANCE_LEAST_LANE_ROWS};
  const std::uint32_t lane_rows = DISTANCE_LEAST_LANE_ROWS * (is_wide ? 2 : 1);
  return Kernel(device, {"distance_pass",
                         distance_pass_spv,
                         3,
                         sizeof(DistancePassPush),
                         {seeds_at_once, lane_rows}});
}

}  // namespace

DistancePass::DistancePass(const Device& device)
    : plain_(make_kernel(device, 1)), many_(make_kernel(device, DISTANCE_MANY)) {}

void DistancePass::record(Batch& batch, const SeedLists& lists, std::uint32_t cap,
                          const DeviceTensor& tensor) const {
  const TensorShape& shape = tensor.shape();
  // The last distance below the cap, in whole cells: a seed further away cannot matter.
  const std::uint32_t reach_cells = groups_for(groups_for(cap, DCD_UNITS_PER_PX), DCD_CELL);
  const Kernel& kernel = reach_cells <= DISTANCE_PLAIN_REACH ? plain_ : many_;
  const auto tiles = static_cast<std::uint32_t>(shape.tiles_per_row());
  for (std::uint32_t band = 0; band < tensor.bands(); ++band) {
    const DistancePassPush push{static_cast<std::uint32_t>(shape.width),
                                static_cast<std::uint32_t>(shape.bins),
                                tiles,
                                tensor.first_row(band),
                                tensor.row_count(band),
                                lists.cell_columns,
                                lists.cell_rows,
                                reach_cells,
                                cap};
    const Groups groups{tiles, groups_for(tensor.row_count(band), DISTANCE_ROWS),
                        static_cast<std::uint32_t>(shape.bins)};
    batch.dispatch(kernel, groups, {lists.cells, lists.seeds, tensor.band(band)}, push);
  }
  batch.barrier();
}

}  // namespace edgescout::gpu
