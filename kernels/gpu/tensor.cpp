#include "kernels/gpu/tensor.h"

#include <algorithm>

#include "kernels/error.h"

namespace edgescout::gpu {

namespace {

[[noreturn]] void too_large(const TensorShape& shape, const std::string& room) {
  throw InputError("image", "size",
                   std::to_string(shape.width) + "x" + std::to_string(shape.height) + " with " +
                       std::to_string(shape.bins) + " bins: a tensor of " +
                       std::to_string(2 * shape.size()) + " bytes",
                   room + " (a smaller image, fewer bins, or --device cpu)");
}

std::string at_most(VkDeviceSize bytes, const Device& device) {
  return "at most " + std::to_string(bytes) + " bytes on " + device.info().name;
}

}  // namespace

DeviceTensor::DeviceTensor(const Device& device, const TensorShape& shape) : shape_(shape) {
  const VkDeviceSize range = device.max_band_bytes();
  row_bytes_ = VkDeviceSize(shape.tiles_per_row()) * shape.bins * DCD_TILE * sizeof(std::uint16_t);
  const VkDeviceSize bytes = row_bytes_ * shape.height;
  const auto height = static_cast<VkDeviceSize>(shape.height);
  const VkDeviceSize rows = std::min(range / row_bytes_, height);
  band_rows_ = static_cast<std::uint32_t>(
      rows == height ? height : rows / TENSOR_BAND_ROW_STEP * TENSOR_BAND_ROW_STEP);
  const VkDeviceSize band_bytes =
      range / row_bytes_ / TENSOR_BAND_ROW_STEP * TENSOR_BAND_ROW_STEP * row_bytes_;
  const VkDeviceSize most =
      std::min<VkDeviceSize>(device.max_allocation_bytes(), TENSOR_MAX_BANDS * band_bytes);
  if (band_rows_ == 0) too_large(shape, at_most(range, device));
  bands_ = static_cast<std::uint32_t>((height + band_rows_ - 1) / band_rows_);
  if (bands_ > TENSOR_MAX_BANDS || bytes > device.max_allocation_bytes())
    too_large(shape, at_most(most, device));
  try {
    buffer_ = RawBuffer(device, bytes, Memory::device, "tensor");
  } catch (const OutOfDeviceMemory&) {
    too_large(shape, "no more than " + device.info().name + " has free");
  }
}

std::uint32_t DeviceTensor::row_count(std::uint32_t band) const {
  return std::min(band_rows_, static_cast<std::uint32_t>(shape_.height) - first_row(band));
}

Bound DeviceTensor::band(std::uint32_t band) const {
  const std::uint32_t real = std::min(band, bands_ - 1);
  return {buffer_, first_row(real) * row_bytes_, row_count(real) * row_bytes_};
}

TensorGrid DeviceTensor::grid() const {
  return {static_cast<std::uint32_t>(shape_.width), static_cast<std::uint32_t>(shape_.height),
          static_cast<std::uint32_t>(shape_.bins),
          static_cast<std::uint32_t>(shape_.tiles_per_row()), band_rows_};
}

const Kernel& BandedKernel::of(const DeviceTensor& tensor) {
  const auto found = kernels_.find(tensor.bands());
  if (found != kernels_.end()) return found->second;
  KernelSource source = source_;
  source.constants = {tensor.bands()};
  return kernels_.emplace(tensor.bands(), Kernel(device_, source)).first->second;
}

}  // namespace edgescout::gpu
