// A DCD tensor in device memory, in the layout of tensor_layout.h.
//
// A device binds at most maxStorageBufferRange bytes at once (128 MiB on lavapipe, where a
// 1920x1200x60 tensor has 276 MB), so the tensor is cut into up to TENSOR_MAX_BANDS bands of whole
// rows, one binding each. All bands but the last have the same number of rows.
#pragma once

#include <map>
#include <vector>

#include "kernels/gpu/batch.h"
#include "kernels/gpu/buffer.h"
#include "kernels/tensor_bands.h"
#include "kernels/tensor_layout.h"

namespace edgescout::gpu {

class DeviceTensor {
 public:
  // Throws InputError where the device cannot hold or bind a tensor of this shape.
  DeviceTensor(const Device& device, const TensorShape& shape);

  const TensorShape& shape() const { return shape_; }
  const RawBuffer& buffer() const { return buffer_; }
  std::uint32_t bands() const { return bands_; }
  std::uint32_t band_rows() const { return band_rows_; }
  std::uint32_t first_row(std::uint32_t band) const { return band * band_rows_; }
  std::uint32_t row_count(std::uint32_t band) const;
  // Band `band` as a binding; a band that does not exist repeats the last one, so that every
  // binding of a reader is valid.
  Bound band(std::uint32_t band) const;
  // What a reader has to know.
  TensorGrid grid() const;

 private:
  TensorShape shape_;
  VkDeviceSize row_bytes_ = 0;
  std::uint32_t band_rows_ = 0, bands_ = 0;
  RawBuffer buffer_;
};

// A kernel that reads tensors: specialized to the number of bands, made when first needed.
class BandedKernel {
 public:
  BandedKernel(const Device& device, KernelSource source)
      : device_(device), source_(std::move(source)) {}
  const Kernel& of(const DeviceTensor& tensor);

 private:
  const Device& device_;
  KernelSource source_;
  std::map<std::uint32_t, Kernel> kernels_;
};

}  // namespace edgescout::gpu
