// Records depth_raster (kernels/depth_raster.h, depth_raster_push.h).
#pragma once

#include <span>

#include "kernels/depth_raster.h"
#include "kernels/gpu/batch.h"

namespace edgescout::gpu {

class DepthRaster {
 public:
  explicit DepthRaster(const Device& device);
  // Maps one batch may draw, at least one: what the device binds at once, not so many that they
  // fill its memory, and with so many triangles as a driver that ends long work lets it draw.
  std::size_t max_jobs(std::size_t triangles, int width, int height) const;
  // At most max_jobs() jobs of a call that check_depth_raster() has seen. The maps stay on the
  // device until the next record().
  void record(Batch& batch, const TriangleMesh& mesh, std::span<const DepthJob> jobs, int width,
              int height);
  // They are there when the batch has run.
  void download(Batch& batch, std::span<float> depth) const { batch.download(depth_, depth); }
  const RawBuffer& maps() const { return depth_; }

 private:
  const Device& device_;
  Kernel kernel_;
  Buffer<float> vertices_;
  Buffer<std::uint32_t> triangles_;
  Buffer<DepthJob> jobs_;
  Buffer<float> depth_;
};

}  // namespace edgescout::gpu
