// Records template_score (kernels/template_score.h, template_score_push.h).
#pragma once

#include <span>

#include "kernels/gpu/batch.h"
#include "kernels/gpu/tensor.h"
#include "kernels/template_score.h"

namespace edgescout::gpu {

class TemplateScore {
 public:
  explicit TemplateScore(const Device& device);
  // How many jobs from the front go into one batch: with the points they name as much as the device
  // binds, and so little work that no watchdog takes the device for hung. At least one.
  std::size_t that_fit(std::span<const TemplateJob> jobs) const;
  // `hits` are there when the batch has run. The jobs are those of a call that check_template_jobs
  // has seen.
  void record(Batch& batch, const DeviceTensor& tensor, std::span<const TemplatePoint> points,
              std::span<const TemplateJob> jobs, int anchor_step, std::span<TemplateHit> hits);

 private:
  const Device& device_;
  BandedKernel kernel_;
  Buffer<TemplatePoint> points_;
  Buffer<TemplateJob> jobs_;
  Buffer<TemplateHit> hits_;
};

}  // namespace edgescout::gpu
