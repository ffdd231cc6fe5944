// Records the first two stages of the edge detector: edge_gradient and edge_thin
// (kernels/edge_stages.h and the headers of that name).
#pragma once

#include <array>

#include "kernels/edge_detect.h"
#include "kernels/gpu/batch.h"

namespace edgescout::gpu {

// LogicError: no pixels. InputError: more than the device binds, a word a pixel.
void check_image_size(const Device& device, const ImageView& image);

class EdgeCandidates {
 public:
  explicit EdgeCandidates(const Device& device);
  // `low`: least gradient of a candidate, gradient units. The image goes into `pixels`, four to a
  // word. Checks its size. Ends with a barrier.
  void record(Batch& batch, const ImageView& image, float sigma_px, std::int32_t low,
              Buffer<std::uint32_t>& pixels);

  // The planes of the last image, a word a pixel (edge_gradient.h, edge_thin.h).
  const RawBuffer& gradient() const { return gradient_; }
  const RawBuffer& labels() const { return labels_; }

 private:
  const Device& device_;
  std::array<Kernel, 2> gradient_passes_;
  Kernel thin_;
  Buffer<std::uint32_t> rows_, gradient_, labels_;
  Buffer<std::int32_t> weights_;
};

}  // namespace edgescout::gpu
