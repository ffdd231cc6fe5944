#include "kernels/gpu/template_score.h"

#include <algorithm>
#include <vector>

#include "kernels/gpu/point_range.h"
#include "kernels/template_score_push.h"
#include "template_score.spv.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(TemplatePoint) == 4 * TEMPLATE_POINT_WORDS);
static_assert(sizeof(TemplateJob) == 4 * TEMPLATE_JOB_WORDS);
static_assert(sizeof(TemplateHit) == 4 * TEMPLATE_HIT_WORDS);

// Of one batch: some hundredths of a second on the graphics of a small processor.
constexpr std::uint64_t max_lookups = std::uint64_t{1} << 28;

std::uint64_t lookups_of(const TemplateJob& job) {
  return std::uint64_t(job.columns) * job.rows * job.point_count;
}

}  // namespace

TemplateScore::TemplateScore(const Device& device)
    : device_(device),
      kernel_(device, {"template_score", template_score_spv, 7, sizeof(TemplateScorePush), {}}) {}

std::size_t TemplateScore::that_fit(std::span<const TemplateJob> jobs) const {
  const std::size_t most_bytes = device_.max_band_bytes();
  PointRange range;
  std::uint64_t lookups = 0;
  std::size_t count = 0;
  while (count < jobs.size()) {
    range.include(jobs[count].first_point, jobs[count].point_count);
    lookups += lookups_of(jobs[count]);
    const std::size_t bytes =
        std::max((count + 1) * sizeof(TemplateJob), range.size() * sizeof(TemplatePoint));
    if (count > 0 && (lookups > max_lookups || bytes > most_bytes)) break;
    ++count;
  }
  return count;
}

void TemplateScore::record(Batch& batch, const DeviceTensor& tensor,
                           std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs,
                           int anchor_step, std::span<TemplateHit> hits) {
  PointRange range;
  for (const TemplateJob& job : jobs) range.include(job.first_point, job.point_count);
  std::vector<TemplateJob> moved(jobs.begin(), jobs.end());
  for (TemplateJob& job : moved) job.first_point -= range.begin;
  points_.reserve(device_, range.size(), "template points");
  jobs_.reserve(device_, jobs.size(), "template jobs");
  hits_.reserve(device_, jobs.size(), "template hits");
  batch.upload(points_, points.subspan(range.begin, range.size()));
  batch.upload<TemplateJob>(jobs_, moved);
  batch.barrier();
  const auto count = static_cast<std::uint32_t>(jobs.size());
  const TemplateScorePush push{tensor.grid(), count, static_cast<std::uint32_t>(anchor_step)};
  batch.dispatch(
      kernel_.of(tensor), spread(count),
      {tensor.band(0), tensor.band(1), tensor.band(2), tensor.band(3), points_, jobs_, hits_},
      push);
  batch.download(hits_, hits);
}

}  // namespace edgescout::gpu
