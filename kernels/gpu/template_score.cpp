#include "kernels/gpu/template_score.h"

#include "kernels/error.h"
#include "kernels/template_score_push.h"
#include "template_score.spv.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(TemplatePoint) == 4 * TEMPLATE_POINT_WORDS);
static_assert(sizeof(TemplateJob) == 4 * TEMPLATE_JOB_WORDS);
static_assert(sizeof(TemplateHit) == 4 * TEMPLATE_HIT_WORDS);

void check_jobs(const TensorShape& shape, std::span<const TemplatePoint> points,
                std::span<const TemplateJob> jobs, int anchor_step, std::size_t hits) {
  check(hits == jobs.size(), "template_score: as many hits as jobs");
  check(anchor_step >= 1, "template_score: anchors at least a pixel apart");
  for (const TemplatePoint& point : points) check(point.bin < shape.bins, "template_score: bin out of range");
  for (const TemplateJob& job : jobs) {
    check(job.point_count >= 1 && job.point_count <= TEMPLATE_SCORE_MAX_POINTS,
          "template_score: points of a template");
    check(std::size_t(job.first_point) + job.point_count <= points.size(),
          "template_score: points beyond the list");
    check(job.columns >= 1 && job.rows >= 1, "template_score: a job without anchors");
  }
}

}  // namespace

TemplateScore::TemplateScore(const Device& device)
    : device_(device),
      kernel_(device, {"template_score", template_score_spv, 7, sizeof(TemplateScorePush), {}}) {}

void TemplateScore::record(Batch& batch, const DeviceTensor& tensor, std::span<const TemplatePoint> points,
                           std::span<const TemplateJob> jobs, int anchor_step, std::span<TemplateHit> hits) {
  check_jobs(tensor.shape(), points, jobs, anchor_step, hits.size());
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
