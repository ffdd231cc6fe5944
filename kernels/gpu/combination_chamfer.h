// Records combination_chamfer (kernels/combination_chamfer.h, chamfer_plan.h, chamfer_push.h): the
// plan is made on the processor, the combinations are the device's.
#pragma once

#include <span>
#include <vector>

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

// What the device needs of one view's plan.
struct DevicePlan {
  std::uint32_t cap = 0;
  Buffer<ChamferMask> masks;
  Buffer<ChamferRow> rows;
  Buffer<ChamferRun> particles;
  Buffer<ChamferVisit> visits;
  Buffer<std::uint32_t> hiders, reach;
};

class CombinationChamfer {
 public:
  explicit CombinationChamfer(const Device& device);
  // One plan and one list of cells a view. The cells are there when the batch has run; until then
  // this must not record another.
  void record(Batch& batch, std::span<const ChamferPlan> plans, const CombinationBits& combinations,
              std::span<const DeviceCells> cells);

 private:
  // Some words of 32 combinations of one view.
  struct Tile {
    std::size_t view;
    std::uint32_t first_word, words;
  };
  // Masks and rows of a tile.
  struct TileMemory {
    Buffer<std::uint32_t> bits, bytes;
  };

  DevicePlan uploaded(Batch& batch, const ChamferPlan& plan) const;
  // All tiles, those together that the device works on side by side.
  std::vector<std::vector<Tile>> side_by_side(std::uint32_t words) const;
  void reserve(std::span<const std::vector<Tile>> groups);
  void record_tiles(Batch& batch, std::span<const Tile> tiles, const CombinationBits& combinations,
                    std::span<const DeviceCells> cells) const;

  const Device& device_;
  Kernel masks_kernel_, rows_kernel_, sums_kernel_;
  std::vector<DevicePlan> plans_;
  Buffer<std::uint32_t> columns_;
  std::vector<TileMemory> memory_;  // of the tiles of a group, used again by the next
};

}  // namespace edgescout::gpu
