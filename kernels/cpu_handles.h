// What the CPU backends hand out: tensors, points and cells in the memory of the host.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "kernels/backend.h"

namespace edgescout {

// Tensor memory, aligned to a large page and handed back to a small store: a fresh 94 MB costs as
// much in page faults as half a tensor. Any thread may call.
class TensorMemory {
 public:
  using Block = std::span<std::uint16_t>;
  TensorMemory() = default;
  TensorMemory(const TensorMemory&) = delete;
  TensorMemory& operator=(const TensorMemory&) = delete;
  ~TensorMemory();
  Block take(std::size_t size);  // std::bad_alloc
  void give_back(Block block);

 private:
  std::mutex mutex_;
  std::vector<Block> free_;
};

class CpuView : public BackendView {
 public:
  CpuView(std::shared_ptr<TensorMemory> memory, std::size_t size)
      : memory_(std::move(memory)), values(memory_->take(size)) {}
  ~CpuView() override { memory_->give_back(values); }
  std::vector<std::uint16_t> tensor() const override { return {values.begin(), values.end()}; }
  TensorView tensor_view() const { return {values, shape, intrinsics}; }
  ImageView image() const {
    return pixels.empty() ? ImageView{} : ImageView{shape.width, shape.height, pixels.data()};
  }
  SupportView support_view() const { return {support_map, shape.width, shape.height}; }

 private:
  std::shared_ptr<TensorMemory> memory_;

 public:
  std::span<std::uint16_t> values;
  std::vector<std::uint8_t> pixels;
  std::vector<std::int16_t> gradient_x2;
  std::vector<std::uint32_t> support_map;
};

template <class Handle, class Point>
class CpuPoints : public Handle {
 public:
  explicit CpuPoints(Unfilled<Point> given) : points(std::move(given)) {}
  Unfilled<Point> points;
};
using CpuPosePoints = CpuPoints<BackendPosePoints, ModelPoint>;
using CpuSurfacePoints = CpuPoints<BackendSurfacePoints, SurfacePoint>;

class CpuDepth : public BackendDepth {
 public:
  explicit CpuDepth(const DepthView& depth) : values(depth.z_m.begin(), depth.z_m.end()) {
    width = depth.width;
    height = depth.height;
    intrinsics = depth.intrinsics;
  }
  DepthView depth_view() const { return {values, width, height, intrinsics}; }
  std::vector<float> values;
};

class CpuModelPoints : public BackendModelPoints {
 public:
  explicit CpuModelPoints(std::span<const ModelPoint> points) : planes(points) {
    count = planes.count();
  }
  ModelPointPlanes planes;
};

class CpuChamfer : public BackendChamfer {
 public:
  std::vector<ChamferCell> cells() const override { return values; }
  std::vector<ChamferCell> values;
};

}  // namespace edgescout
