// Records edge_support (kernels/edge_support.h, edge_support_push.h).
#pragma once

#include <span>
#include <vector>

#include "kernels/edge_support.h"
#include "kernels/gpu/batch.h"

namespace edgescout::gpu {

// A view's support map on the device. Null: a view without an image.
struct SupportMapView {
  const RawBuffer* map;
  int width, height;
};

class SupportScorer {
 public:
  explicit SupportScorer(const Device& device);
  // How many problems from the front one batch takes: at least one.
  std::size_t that_fit(std::span<const SupportProblem> problems) const;
  // The problems are those of a call that check_edge_support has seen.
  void record(Batch& batch, std::span<const SupportMapView> views,
              std::span<const SupportPoint> points, std::span<const SupportProblem> problems);
  // After the batch has run: a result for every problem that was recorded last, all zero in a view
  // without an image.
  void collect(std::span<EdgeSupport> out) const;

 private:
  // The problems of order_.
  void upload(Batch& batch, std::span<const SupportPoint> points,
              std::span<const SupportProblem> problems);

  const Device& device_;
  Kernel kernel_;
  Buffer<SupportPoint> points_;
  Buffer<SupportProblem> problems_;
  Buffer<std::int32_t> tables_;
  Buffer<std::uint32_t> sums_;
  std::vector<std::uint32_t> order_;    // by view, of the problems whose view has an image
  std::vector<SupportSums> host_sums_;  // in that order
};

}  // namespace edgescout::gpu
