#include "kernels/gpu/edge_detect.h"

#include <algorithm>

#include "edge_link.spv.h"
#include "kernels/edge_link.h"
#include "kernels/edge_stages.h"
#include "kernels/error.h"

namespace edgescout::gpu {

namespace {

constexpr std::size_t MOST_AT_FIRST = std::size_t{1}
                                      << 16;  // edge pixels; 1024x768 hardly ever has as many

Kernel link_pass(const Device& device, std::uint32_t pass) {
  return Kernel(device, {"edge_link", edge_link_spv, 5, sizeof(EdgeLinkPush), {pass}});
}

}  // namespace

EdgeDetect::EdgeDetect(const Device& device)
    : device_(device),
      candidates_(device),
      link_passes_{link_pass(device, EDGE_LINK_MERGE), link_pass(device, EDGE_LINK_COUNT),
                   link_pass(device, EDGE_LINK_KEEP), link_pass(device, EDGE_LINK_POINT)} {}

void EdgeDetect::record_link(Batch& batch, std::uint32_t pass, std::uint32_t count) const {
  const EdgeLinkPush push{width_, height_, high2_, min_length_px_, count};
  batch.dispatch(link_passes_[pass], spread(groups_for(count, EDGE_GROUP)),
                 {gradient(), labels(), components_, kept_, points_}, push);
  batch.barrier();
}

void EdgeDetect::record_pixels(Batch& batch, const ImageView& image, const EdgeOptions& options) {
  options.validate();
  check_image_size(device_, image);
  const std::int32_t high = edge_threshold(options.high_threshold);
  width_ = static_cast<std::uint32_t>(image.width);
  height_ = static_cast<std::uint32_t>(image.height);
  high2_ = static_cast<std::uint32_t>(high * high);
  min_length_px_ = static_cast<std::uint32_t>(options.min_length_px);
  const std::size_t count = std::size_t(width_) * height_;
  components_.reserve(device_, count, "edge components");
  kept_.reserve(device_, count + 1, "edge pixels");
  points_.reserve(device_, 1, "edge points");

  batch.fill(components_, count * sizeof(std::uint32_t), 0);
  batch.fill(kept_, sizeof(std::uint32_t), 0);
  candidates_.record(batch, image, options.sigma_px, edge_threshold(options.low_threshold), image_);
  for (const std::uint32_t pass : {EDGE_LINK_MERGE, EDGE_LINK_COUNT, EDGE_LINK_KEEP})
    record_link(batch, pass, static_cast<std::uint32_t>(count));
  host_kept_.resize(1 + std::min(count, MOST_AT_FIRST));
  batch.download<std::uint32_t>(kept_, host_kept_);
}

void EdgeDetect::record_rest(Batch& batch) {
  host_kept_.resize(1 + host_kept_.front());
  batch.download<std::uint32_t>(kept_, host_kept_);
}

std::vector<std::uint32_t> EdgeDetect::pixels() const {
  check(lists_all(), "edge_detect: a list that was cut");
  std::vector<std::uint32_t> list(host_kept_.begin() + 1,
                                  host_kept_.begin() + 1 + host_kept_.front());
  std::ranges::sort(list);
  return list;
}

void EdgeDetect::record_points(Batch& batch, std::span<const std::uint32_t> pixels,
                               std::span<EdgePoint> points) {
  check(points.size() == pixels.size(), "detect_edges: as many points as pixels");
  host_kept_.assign(1, static_cast<std::uint32_t>(pixels.size()));
  host_kept_.insert(host_kept_.end(), pixels.begin(), pixels.end());
  points_.reserve(device_, points.size(), "edge points");
  batch.upload<std::uint32_t>(kept_, host_kept_);
  batch.barrier();
  record_link(batch, EDGE_LINK_POINT, static_cast<std::uint32_t>(pixels.size()));
  batch.download(points_, points);
}

}  // namespace edgescout::gpu
