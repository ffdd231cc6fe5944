#include "kernels/gpu/edge_candidates.h"

#include <span>
#include <vector>

#include "edge_gradient.spv.h"
#include "edge_thin.spv.h"
#include "kernels/edge_stages.h"
#include "kernels/edge_thin.h"
#include "kernels/error.h"

namespace edgescout::gpu {

namespace {

Kernel gradient_pass(const Device& device, std::uint32_t pass) {
  return Kernel(device, {"edge_gradient", edge_gradient_spv, 4, sizeof(EdgeGradientPush), {pass}});
}

std::vector<std::int32_t> both_halves(const EdgeWeights& weights) {
  std::vector<std::int32_t> both(weights.smooth.begin(), weights.smooth.end());
  both.insert(both.end(), weights.derivative.begin(), weights.derivative.end());
  return both;
}

}  // namespace

void check_image_size(const Device& device, const ImageView& image) {
  check(image.width > 0 && image.height > 0 && image.pixels,
        "edge_gradient: an image without pixels");
  const std::uint64_t most = device.limits().maxStorageBufferRange / sizeof(std::uint32_t) - 1;
  const std::uint64_t pixels = std::uint64_t(image.width) * std::uint64_t(image.height);
  if (pixels > most)
    throw InputError("image", "size",
                     std::to_string(image.width) + "x" + std::to_string(image.height),
                     "at most " + std::to_string(most) + " pixels on " + device.info().name);
}

EdgeCandidates::EdgeCandidates(const Device& device)
    : device_(device),
      gradient_passes_{gradient_pass(device, EDGE_ROWS), gradient_pass(device, EDGE_COLUMNS)},
      thin_(device, {"edge_thin", edge_thin_spv, 2, sizeof(EdgeThinPush), {}}) {}

void EdgeCandidates::record(Batch& batch, const ImageView& image, float sigma_px, std::int32_t low,
                            Buffer<std::uint32_t>& pixels) {
  check_image_size(device_, image);
  const auto width = static_cast<std::uint32_t>(image.width),
             height = static_cast<std::uint32_t>(image.height);
  const std::size_t count = std::size_t(width) * height;
  pixels.reserve(device_, (count + 3) / 4, "image");
  rows_.reserve(device_, count, "edge rows");
  gradient_.reserve(device_, count, "edge gradient");
  labels_.reserve(device_, count, "edge labels");
  const EdgeWeights weights = edge_weights(sigma_px);
  const std::vector<std::int32_t> both = both_halves(weights);
  weights_.reserve(device_, both.size(), "edge weights");
  batch.upload<std::int32_t>(weights_, both);
  batch.upload(pixels, std::span(image.pixels, count));
  batch.barrier();
  const Groups groups{groups_for(width, EDGE_GROUP), height};
  const EdgeGradientPush push{width, height, static_cast<std::uint32_t>(weights.radius)};
  for (const Kernel& pass : gradient_passes_) {
    batch.dispatch(pass, groups, {pixels, weights_, rows_, gradient_}, push);
    batch.barrier();
  }
  const EdgeThinPush thin{width, height, static_cast<std::uint32_t>(low * low)};
  batch.dispatch(thin_, groups, {gradient_, labels_}, thin);
  batch.barrier();
}

}  // namespace edgescout::gpu
