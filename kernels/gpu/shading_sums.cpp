#include "kernels/gpu/shading_sums.h"

#include <algorithm>
#include <bit>

#include "shading_sums.spv.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(ShadingMap) == 4 * SHADING_MAP_WORDS);

constexpr int SIZE = int(SHADING_MAP_PX);

ShadingPush push_of(const ShadingImageView& view, float tolerance_m) {
  ShadingPush push{};
  push.width = static_cast<std::uint32_t>(view.width);
  push.height = static_cast<std::uint32_t>(view.height);
  push.tolerance_m = tolerance_m;
  push.max_bend = static_cast<float>(SHADING_MAX_BEND);
  if (!view.known.depth_m) return push;
  push.known_width = static_cast<std::uint32_t>(view.known.width);
  push.known_height = static_cast<std::uint32_t>(view.known.height);
  push.known_fx = view.known.intrinsics.fx;
  push.known_fy = view.known.intrinsics.fy;
  push.known_cx = view.known.intrinsics.cx;
  push.known_cy = view.known.intrinsics.cy;
  return push;
}

ShadingSums to_sums(std::span<const std::uint32_t, SHADING_SUM_WORDS> words) {
  ShadingSums sums;
  for (std::size_t e = 0; e < SHADING_SYSTEM; ++e)
    sums.system[e] = double(std::bit_cast<float>(words[e]));
  // The first row of the system holds the sums of the harmonics.
  for (std::size_t a = 0; a < SHADING_HARMONICS; ++a)
    sums.right[a] = double(std::bit_cast<float>(words[SHADING_SYSTEM + a])) +
                    double(SHADING_MIDDLE_GREY) * sums.system[a];
  sums.pixels = words[SHADING_FLOATS];
  sums.grey = words[SHADING_FLOATS + 1];
  sums.squares = words[SHADING_FLOATS + 2];
  return sums;
}

}  // namespace

ShadingSummer::ShadingSummer(const Device& device)
    : device_(device),
      kernel_(device, {"shading_sums", shading_sums_spv, 5, sizeof(ShadingPush), {}}) {}

std::size_t ShadingSummer::that_fit(const DepthRaster& raster, std::size_t triangles) const {
  const std::size_t sums = device_.max_band_bytes() / (SHADING_SUM_WORDS * sizeof(std::uint32_t));
  return std::clamp<std::size_t>(sums, 1, raster.max_jobs(triangles, SIZE, SIZE));
}

void ShadingSummer::record(Batch& batch, DepthRaster& raster,
                           std::span<const ShadingImageView> views, const TriangleMesh& mesh,
                           std::span<const ShadingJob> jobs, float tolerance_m) {
  const auto view_of = [&](std::uint32_t i) { return jobs[i].view; };
  order_.clear();
  for (std::uint32_t i = 0; i < jobs.size(); ++i)
    if (views[view_of(i)].image) order_.push_back(i);
  std::ranges::stable_sort(order_, {}, view_of);
  host_sums_.resize(order_.size() * SHADING_SUM_WORDS);
  if (order_.empty()) return;
  std::vector<DepthJob> drawn;
  std::vector<ShadingMap> maps;
  for (const std::uint32_t i : order_) {
    const ShadingJob& job = jobs[i];
    const Intrinsics k = shading_map_camera(job, views[job.view].intrinsics);
    drawn.push_back({job.camera_from_object, k});
    maps.push_back({job.x_px, job.y_px, job.stride_px, k.fx, k.fy, k.cx, k.cy});
  }
  maps_.reserve(device_, maps.size(), "shading maps");
  sums_.reserve(device_, host_sums_.size(), "shading sums");
  batch.upload<ShadingMap>(maps_, maps);
  raster.record(batch, mesh, drawn, SIZE, SIZE);
  batch.barrier();
  // A run of jobs in one view is a dispatch.
  for (std::size_t first = 0, last = 0; first < order_.size(); first = last) {
    const ShadingImageView& view = views[view_of(order_[first])];
    while (last < order_.size() && view_of(order_[last]) == view_of(order_[first])) ++last;
    ShadingPush push = push_of(view, tolerance_m);
    push.first_job = static_cast<std::uint32_t>(first);
    push.job_count = static_cast<std::uint32_t>(last - first);
    const RawBuffer& known = view.known.depth_m ? *view.known.depth_m : *view.image;
    batch.dispatch(kernel_, spread(push.job_count),
                   {raster.maps(), maps_, *view.image, known, sums_}, push);
  }
  batch.download<std::uint32_t>(sums_, host_sums_);
}

void ShadingSummer::collect(std::span<ShadingSums> out) const {
  std::ranges::fill(out, ShadingSums{});
  for (std::size_t n = 0; n < order_.size(); ++n)
    out[order_[n]] =
        to_sums(std::span(host_sums_).subspan(n * SHADING_SUM_WORDS).first<SHADING_SUM_WORDS>());
}

}  // namespace edgescout::gpu
