// Records point_visibility (kernels/point_visibility.h) after the depth maps that it reads.
#pragma once

#include <span>
#include <vector>

#include "kernels/gpu/batch.h"
#include "kernels/gpu/depth_raster.h"
#include "kernels/point_visibility.h"

namespace edgescout::gpu {

class PointVisibility {
 public:
  explicit PointVisibility(const Device& device);
  // How many jobs from the front go into one batch: what the device binds with the points they
  // name, and no more maps than `raster` draws at once. At least one.
  std::size_t that_fit(const DepthRaster& raster, std::size_t triangles,
                       const VisibilityPoints& points, std::span<const VisibilityJob> jobs,
                       int size) const;
  // Of a call that check_point_visibility() has seen.
  void record(Batch& batch, DepthRaster& raster, const TriangleMesh& mesh,
              const VisibilityPoints& points, std::span<const VisibilityJob> jobs, int size);
  // The flags of the jobs recorded last, after the batch has run.
  void collect(std::span<std::uint8_t> flags) const;

 private:
  const Device& device_;
  Kernel kernel_;
  Buffer<float> points_;
  Buffer<VisibilityJob> jobs_;
  Buffer<std::uint32_t> words_;
  std::vector<std::uint32_t> host_words_;
  std::vector<std::uint32_t> counts_;  // of points, by job
};

}  // namespace edgescout::gpu
