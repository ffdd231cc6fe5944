// What the Vulkan backend hands out: tensors, points and cells in the device's memory. Each keeps
// the device alive for as long as its memory is in use.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kernels/backend.h"
#include "kernels/gpu/batch.h"
#include "kernels/gpu/combination_chamfer.h"
#include "kernels/gpu/edge_support.h"
#include "kernels/gpu/pose_depth.h"
#include "kernels/gpu/pose_plan.h"
#include "kernels/gpu/shading_sums.h"
#include "kernels/gpu/tensor.h"

namespace edgescout::gpu {

class VulkanView : public BackendView {
 public:
  VulkanView(std::shared_ptr<const Device> device, const TensorShape& tensor_shape,
             std::uint64_t view_id)
      : id(view_id), device_(std::move(device)), values(*device_, tensor_shape) {
    shape = tensor_shape;
  }
  const std::uint64_t id;  // no other view of the backend has it
  const Device& device() const { return *device_; }
  std::vector<std::uint16_t> tensor() const override {
    std::vector<std::uint16_t> copy(shape.size());
    Batch batch(*device_, "tensor download");
    batch.download<std::uint16_t>(values.buffer(), copy);
    batch.run();
    return copy;
  }
  PoseView pose_view() const {
    return {&values, intrinsics, gradient_x2.size() > 0 ? &gradient_x2 : nullptr};
  }
  SupportMapView support_view() const {
    return {support_map.size() > 0 ? &support_map : nullptr, shape.width, shape.height};
  }
  // Without known surfaces.
  ShadingImageView shading_view() const {
    return {pixels.size() > 0 ? &pixels : nullptr, shape.width, shape.height, intrinsics, {}};
  }

 private:
  std::shared_ptr<const Device> device_;

 public:
  DeviceTensor values;
  Buffer<std::int16_t> gradient_x2;
  Buffer<std::uint32_t> support_map;
  Buffer<std::uint32_t> pixels;  // of the image, four to a word
};

class VulkanModelPoints : public BackendModelPoints {
 public:
  explicit VulkanModelPoints(std::shared_ptr<const Device> device) : device_(std::move(device)) {}
  const Device& device() const { return *device_; }

 private:
  std::shared_ptr<const Device> device_;

 public:
  Buffer<float> planes;
};

// Points of one kind. Too many for one binding stay with the host.
template <class Handle, class Point>
class VulkanPoints : public Handle {
 public:
  VulkanPoints(std::shared_ptr<const Device> device, Unfilled<Point> points)
      : device_(std::move(device)), host(std::move(points)) {}
  const Device& device() const { return *device_; }
  PosePoints points() const {
    return {std::as_bytes(std::span(host)), values.size() > 0 ? &values : nullptr};
  }

 private:
  std::shared_ptr<const Device> device_;

 public:
  Unfilled<Point> host;
  Buffer<Point> values;
};
using VulkanPosePoints = VulkanPoints<BackendPosePoints, ModelPoint>;
using VulkanSurfacePoints = VulkanPoints<BackendSurfacePoints, SurfacePoint>;

class VulkanDepth : public BackendDepth {
 public:
  VulkanDepth(std::shared_ptr<const Device> device, const DepthView& depth)
      : device_(std::move(device)), values(depth_buffer(*device_, depth.width, depth.height)) {
    width = depth.width;
    height = depth.height;
    intrinsics = depth.intrinsics;
  }
  const Device& device() const { return *device_; }
  DepthImageView view() const { return {&values, width, height, intrinsics}; }

 private:
  std::shared_ptr<const Device> device_;

 public:
  Buffer<float> values;
};

class VulkanChamfer : public BackendChamfer {
 public:
  VulkanChamfer(std::shared_ptr<const Device> device, std::size_t particle_count,
                std::uint32_t combination_count)
      : device_(std::move(device)), values(*device_, particle_count, combination_count) {
    particles = values.particles;
    combinations = values.combinations;
  }
  const Device& device() const { return *device_; }
  std::vector<ChamferCell> cells() const override {
    std::vector<std::uint32_t> sums(std::size_t(particles) * combinations), counts(sums.size());
    Batch batch(*device_, "cells download");
    batch.download<std::uint32_t>(values.sums, sums);
    batch.download<std::uint32_t>(values.counts, counts);
    batch.run();
    std::vector<ChamferCell> cells(sums.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
      cells[i] = {sums[i], std::uint16_t(counts[i] & 0xffffu), std::uint16_t(counts[i] >> 16)};
    return cells;
  }

 private:
  std::shared_ptr<const Device> device_;

 public:
  DeviceCells values;
};

}  // namespace edgescout::gpu
