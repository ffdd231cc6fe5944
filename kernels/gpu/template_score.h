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
  // `hits` are there when the batch has run. Throws LogicError on jobs that break the contract.
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
