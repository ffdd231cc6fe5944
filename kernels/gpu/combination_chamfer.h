// Records combination_chamfer (kernels/combination_chamfer.h, chamfer_plan.h, chamfer_push.h): the
// plan is made on the processor, the combinations are the device's.
#pragma once

#include "kernels/chamfer_plan.h"
#include "kernels/gpu/batch.h"

namespace edgescout::gpu {

// The cells of one view, [particle][combination].
struct DeviceCells {
  std::uint32_t particles = 0, combinations = 0;
  Buffer<std::uint32_t> sums, counts;  // counts: unseen << 16 | seen
  // Throws GpuError where the device does not bind as much.
  DeviceCells(const Device& device, std::size_t particles, std::uint32_t combinations);
};

class CombinationChamfer {
 public:
  explicit CombinationChamfer(const Device& device);
  // `cells` are there when the batch has run.
  void record(Batch& batch, const ChamferPlan& plan, const CombinationBits& combinations,
              const DeviceCells& cells);

 private:
  void upload(Batch& batch, const ChamferPlan& plan, const CombinationBits& combinations);
  // Words of 32 combinations whose rows fit the device together.
  std::uint32_t tile_words(const ChamferPlan& plan, std::uint32_t words) const;
  void record_tile(Batch& batch, const ChamferPlan& plan, const ChamferPush& tile,
                   const DeviceCells& cells);

  const Device& device_;
  Kernel masks_kernel_, rows_kernel_, sums_kernel_;
  Buffer<ChamferMask> masks_;
  Buffer<ChamferRow> rows_;
  Buffer<ChamferRun> particles_;
  Buffer<ChamferVisit> visits_;
  Buffer<std::uint32_t> hiders_, reach_, columns_, bits_, bytes_;
};

}  // namespace edgescout::gpu
