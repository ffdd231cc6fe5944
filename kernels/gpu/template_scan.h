// Records template_scan (kernels/template_scan.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/gpu/batch.h"
#include "kernels/gpu/tensor.h"
#include "kernels/template_scan.h"

namespace edgescout::gpu {

class TemplateScanner {
 public:
  explicit TemplateScanner(const Device& device);
  // Whether the device can hold and bind the planes of such a tensor.
  bool holds_planes(const TensorShape& shape, int anchor_step) const;
  // How many regions from `first` on go into one batch: what the device binds, and so little work
  // that no watchdog takes the device for hung. At least one.
  std::size_t regions_that_fit(const TemplateScan& scan, std::size_t first) const;
  // The planes stay until another view's are recorded. `view_id` tells views apart.
  void record_planes(Batch& batch, const DeviceTensor& tensor, std::uint64_t view_id,
                     int anchor_step);
  // Of a call that check_template_scan() has seen.
  void record(Batch& batch, const Buffer<float>& points, const TemplateScan& scan,
              std::size_t first_region, std::size_t regions);
  // The hits of the regions recorded last, after the batch has run.
  void collect(const TemplateScan& scan, std::size_t first_region, std::span<TemplateHit> hits);

 private:
  const Device& device_;
  BandedKernel planes_kernel_;
  Kernel scan_kernel_;
  TexelBuffer planes_;
  Buffer<std::uint32_t> input_, hits_;
  TemplatePlanesGrid grid_{};  // of the planes
  TensorShape shape_;          // of their tensor
  std::uint64_t recorded_planes_of_ = 0;
  std::uint64_t planes_of_ = 0;  // 0: none whose batch has run
  std::vector<std::uint32_t> host_hits_;
};

}  // namespace edgescout::gpu
