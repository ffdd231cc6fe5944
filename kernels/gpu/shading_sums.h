// Records shading_sums (kernels/shading_sums.h, shading_sums_push.h) after the depth maps that it
// reads.
#pragma once

#include <span>
#include <vector>

#include "kernels/gpu/batch.h"
#include "kernels/gpu/depth_raster.h"
#include "kernels/gpu/pose_depth.h"
#include "kernels/shading_sums.h"

namespace edgescout::gpu {

// One view as the kernel reads it. Image null: a view without one. Depth null: nothing is known.
struct ShadingImageView {
  const RawBuffer* image;
  int width, height;
  Intrinsics intrinsics;
  DepthImageView known;
};

class ShadingSummer {
 public:
  explicit ShadingSummer(const Device& device);
  // How many jobs one batch takes: no more maps than `raster` draws at once. At least one.
  std::size_t that_fit(const DepthRaster& raster, std::size_t triangles) const;
  // Of a call that check_shading_sums() has seen.
  void record(Batch& batch, DepthRaster& raster, std::span<const ShadingImageView> views,
              const TriangleMesh& mesh, std::span<const ShadingJob> jobs, float tolerance_m);
  // After the batch has run: the sums of the jobs recorded last, all zero in a view without an
  // image.
  void collect(std::span<ShadingSums> out) const;

 private:
  const Device& device_;
  Kernel kernel_;
  Buffer<ShadingMap> maps_;
  Buffer<std::uint32_t> sums_;
  std::vector<std::uint32_t> order_;  // by view, of the jobs whose view has an image
  std::vector<std::uint32_t> host_sums_;
};

}  // namespace edgescout::gpu
