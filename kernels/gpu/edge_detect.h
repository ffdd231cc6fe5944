// Records the edge detector: edge_gradient and edge_thin (edge_candidates.h), then edge_link
// (kernels/edge_stages.h and the header of that name).
//
// Two batches: the first finds the edge pixels, the host sorts their indices row-major, the second
// computes their points. Of an image with uncommonly many edge pixels one between them fetches the
// rest of the list: to copy as many as there may be, a word a pixel, would take a discrete card
// longer than to find them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernels/edge_detect.h"
#include "kernels/gpu/batch.h"
#include "kernels/gpu/edge_candidates.h"

namespace edgescout::gpu {

class EdgeDetect {
 public:
  explicit EdgeDetect(const Device& device);
  // Validates the options. The first batch.
  void record_pixels(Batch& batch, const ImageView& image, const EdgeOptions& options);
  // After the first batch has run: whether the list is whole. Else record_rest goes into a batch of
  // its own.
  bool lists_all() const { return host_kept_.front() < host_kept_.size(); }
  void record_rest(Batch& batch);
  // The edge pixels' indices, sorted.
  std::vector<std::uint32_t> pixels() const;
  // The second batch: one point for every pixel of the list. `points` are there when it has run.
  void record_points(Batch& batch, std::span<const std::uint32_t> pixels,
                     std::span<EdgePoint> points);

  // The planes of the last image, a word a pixel (edge_gradient.h, edge_thin.h).
  const RawBuffer& gradient() const { return candidates_.gradient(); }
  const RawBuffer& labels() const { return candidates_.labels(); }

 private:
  void record_link(Batch& batch, std::uint32_t pass, std::uint32_t count) const;

  const Device& device_;
  EdgeCandidates candidates_;
  std::array<Kernel, 4> link_passes_;
  std::uint32_t width_ = 0, height_ = 0, high2_ = 0, min_length_px_ = 0;
  Buffer<std::uint32_t> image_, components_, kept_;
  Buffer<EdgePoint> points_;
  std::vector<std::uint32_t> host_kept_;
};

}  // namespace edgescout::gpu
