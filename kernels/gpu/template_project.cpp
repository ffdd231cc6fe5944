#include "kernels/gpu/template_project.h"

#include <algorithm>

#include "kernels/gpu/point_range.h"
#include "template_project.spv.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(TemplateProjectJob) == 4 * TEMPLATE_PROJECT_JOB_WORDS);
static_assert(sizeof(TemplatePoint) == 8);  // a uvec2

constexpr std::size_t max_projected_bytes = std::size_t{64} << 20;

PointRange places_of(std::span<const TemplateProjectJob> jobs) {
  PointRange places;
  for (const TemplateProjectJob& job : jobs) places.include(job.first_projected, job.point_count);
  return places;
}

}  // namespace

TemplateProject::TemplateProject(const Device& device)
    : device_(device),
      kernel_(device,
              {"template_project", template_project_spv, 4, sizeof(TemplateProjectPush), {}}) {}

std::size_t TemplateProject::that_fit(std::span<const TemplateProjectJob> jobs) const {
  const std::size_t most = std::min<std::size_t>(max_projected_bytes, device_.max_band_bytes());
  PointRange places;
  std::size_t count = 0;
  while (count < jobs.size()) {
    places.include(jobs[count].first_projected, jobs[count].point_count);
    const std::size_t bytes =
        std::max((count + 1) * sizeof(TemplateProjectJob), places.size() * sizeof(TemplatePoint));
    if (count > 0 && bytes > most) break;
    ++count;
  }
  return count;
}

void TemplateProject::record(Batch& batch, const Buffer<float>& planes,
                             std::span<const TemplateProjectJob> jobs,
                             const TemplateProjectOptions& options) {
  const PointRange places = places_of(jobs);
  std::vector<TemplateProjectJob> moved(jobs.begin(), jobs.end());
  for (TemplateProjectJob& job : moved) job.first_projected -= places.begin;
  host_projected_.resize(places.size());
  host_too_near_.resize(jobs.size());
  jobs_.reserve(device_, jobs.size(), "projection jobs");
  projected_.reserve(device_, places.size(), "projected templates");
  too_near_.reserve(device_, jobs.size(), "counts of points too near");
  batch.upload<TemplateProjectJob>(jobs_, moved);
  batch.barrier();
  const auto count = static_cast<std::uint32_t>(jobs.size());
  const Intrinsics& k = options.intrinsics;
  const TemplateProjectPush push{
      k.fx,
      k.fy,
      k.cx,
      k.cy,
      options.nearest_m,
      static_cast<std::uint32_t>(options.bins),
      static_cast<std::uint32_t>(planes.size() / TEMPLATE_PROJECT_PLANES),
      count};
  batch.dispatch(kernel_, spread(count), {planes, jobs_, projected_, too_near_}, push);
}

void TemplateProject::download(Batch& batch) {
  batch.download<TemplatePoint>(projected_, host_projected_);
  batch.download<std::uint32_t>(too_near_, host_too_near_);
}

void TemplateProject::collect(std::span<const TemplateProjectJob> jobs,
                              std::span<TemplatePoint> projected,
                              std::span<std::uint32_t> too_near) const {
  const std::uint32_t first = places_of(jobs).begin;
  for (const TemplateProjectJob& job : jobs)
    std::copy_n(host_projected_.begin() + (job.first_projected - first), job.point_count,
                projected.begin() + job.first_projected);
  std::ranges::copy(host_too_near_, too_near.begin());
}

}  // namespace edgescout::gpu
