#include "kernels/gpu/template_score.h"

#include "kernels/template_score_push.h"
#include "template_score.spv.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(TemplatePoint) == 4 * TEMPLATE_POINT_WORDS);
static_assert(sizeof(TemplateJob) == 4 * TEMPLATE_JOB_WORDS);
static_assert(sizeof(TemplateHit) == 4 * TEMPLATE_HIT_WORDS);

}  // namespace

TemplateScore::TemplateScore(const Device& device)
    : device_(device),
      kernel_(device, {"template_score", template_score_spv, 7, sizeof(TemplateScorePush), {}}) {}

void TemplateScore::record(Batch& batch, const DeviceTensor& tensor, std::span<const TemplatePoint> points,
                           std::span<const TemplateJob> jobs, int anchor_step, std::span<TemplateHit> hits) {
  check_template_jobs(tensor.shape(), points, jobs, anchor_step, hits.size());
  points_.reserve(device_, points.size(), "template points");
  jobs_.reserve(device_, jobs.size(), "template jobs");
  hits_.reserve(device_, jobs.size(), "template hits");
  batch.upload(points_, points);
  batch.upload(jobs_, jobs);
  batch.barrier();
  const auto count = static_cast<std::uint32_t>(jobs.size());
  const TemplateScorePush push{tensor.grid(), count, static_cast<std::uint32_t>(anchor_step)};
  batch.dispatch(kernel_.of(tensor), spread(count),
                 {tensor.band(0), tensor.band(1), tensor.band(2), tensor.band(3), points_, jobs_, hits_},
                 push);
  batch.download(hits_, hits);
}

}  // namespace edgescout::gpu
