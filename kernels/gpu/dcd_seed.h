// Records dcd_seed: edge points in, lists of seeds by cell out (kernels/dcd_seed.h).
#pragma once

#include <array>
#include <span>

#include "kernels/gpu/batch.h"
#include "kernels/tensor_layout.h"
#include "kernels/types.h"

namespace edgescout::gpu {

// The lists, and the scratch they are made with; grows and stays, so that a stream of images
// allocates once.
struct SeedLists {
  std::uint32_t cell_columns = 0, cell_rows = 0;
  Buffer<EdgePoint> points;
  Buffer<std::uint32_t> planes, cells, seeds, slots, placed;
};

class DcdSeed {
 public:
  explicit DcdSeed(const Device& device);
  void record(Batch& batch, std::span<const EdgePoint> edges, const TensorShape& shape,
              SeedLists& lists) const;

 private:
  const Device& device_;
  std::array<Kernel, 3> passes_;  // mark, offsets, fill
};

}  // namespace edgescout::gpu
