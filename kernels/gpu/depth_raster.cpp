#include "kernels/gpu/depth_raster.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "depth_raster.spv.h"
#include "kernels/depth_raster_push.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(DepthJob) == 4 * DEPTH_JOB_WORDS);

constexpr std::size_t max_depth_bytes = std::size_t{64} << 20;
constexpr std::size_t max_groups_y = 1u << 15;
constexpr std::uint32_t max_groups_x = 1u << 15;
// Triangles set up in one batch, once a band: some tenths of a second on the graphics of a small
// processor.
constexpr std::size_t max_set_ups = std::size_t{1} << 26;

std::uint32_t band_rows_of(int width) {
  return std::max(1u, DEPTH_BAND_PIXELS / static_cast<std::uint32_t>(width));
}

// A pose that is nowhere shows nothing. Shaders need not tell a NaN from a number, so it goes
// behind the camera here.
std::vector<DepthJob> with_poses_somewhere(std::span<const DepthJob> jobs) {
  std::vector<DepthJob> out(jobs.begin(), jobs.end());
  for (DepthJob& job : out)
    if (!std::ranges::all_of(job.camera_from_object.m, [](float v) { return std::isfinite(v); }))
      job.camera_from_object = {};
  return out;
}

}  // namespace

DepthRaster::DepthRaster(const Device& device)
    : device_(device),
      kernel_(device, {"depth_raster", depth_raster_spv, 4, sizeof(DepthRasterPush), {}}) {}

std::size_t DepthRaster::max_jobs(std::size_t triangles, int width, int height) const {
  const std::size_t map_bytes = std::size_t(width) * height * sizeof(float);
  const std::size_t bytes =
      std::min<std::size_t>(max_depth_bytes, device_.limits().maxStorageBufferRange);
  const std::size_t set_ups = triangles * groups_for(std::size_t(height), band_rows_of(width));
  const std::size_t drawn = max_set_ups / std::max<std::size_t>(set_ups, 1);
  return std::clamp<std::size_t>(std::min(bytes / map_bytes, drawn), 1, max_groups_y);
}

void DepthRaster::record(Batch& batch, const TriangleMesh& mesh, std::span<const DepthJob> jobs,
                         int width, int height) {
  const std::size_t pixels = jobs.size() * std::size_t(width) * std::size_t(height);
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size() / 3);
  vertices_.reserve(device_, mesh.vertices_m.size(), "mesh vertices");
  triangles_.reserve(device_, mesh.triangles.size(), "mesh triangles");
  jobs_.reserve(device_, jobs.size(), "depth jobs");
  depth_.reserve(device_, pixels, "depth maps");
  batch.upload(vertices_, mesh.vertices_m);
  batch.upload(triangles_, mesh.triangles);
  batch.upload<DepthJob>(jobs_, with_poses_somewhere(jobs));
  batch.fill(depth_, pixels * sizeof(float), std::bit_cast<std::uint32_t>(DEPTH_EMPTY));
  batch.barrier();
  const auto rows = static_cast<std::uint32_t>(height),
             maps = static_cast<std::uint32_t>(jobs.size());
  const std::uint32_t band_rows = band_rows_of(width);
  for (std::uint32_t first = 0; first < count; first += max_groups_x * DEPTH_GROUP) {
    const std::uint32_t groups = std::min(max_groups_x, groups_for(count - first, DEPTH_GROUP));
    const DepthRasterPush push{
        count, static_cast<std::uint32_t>(width), rows, DEPTH_NEAR_M, band_rows, first};
    batch.dispatch(kernel_, {groups, maps, groups_for(rows, band_rows)},
                   {vertices_, triangles_, jobs_, depth_}, push);
  }
}

}  // namespace edgescout::gpu
