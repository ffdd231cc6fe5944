// Records support_map (kernels/support_map.h, support_map_push.h).
#pragma once

#include <array>

#include "kernels/gpu/edge_candidates.h"
#include "kernels/support_map.h"

namespace edgescout::gpu {

class SupportMapper {
 public:
  explicit SupportMapper(const Device& device);
  // `map` grows to a word a pixel, `pixels` to the image, four to a word. They are there when the
  // batch has run.
  void record(Batch& batch, const ImageView& image, Buffer<std::uint32_t>& map,
              Buffer<std::uint32_t>& pixels);

 private:
  const Device& device_;
  EdgeCandidates candidates_;
  std::array<Kernel, 2> passes_;
  Buffer<std::int32_t> tables_;
  Buffer<std::uint32_t> directions_;
};

}  // namespace edgescout::gpu
