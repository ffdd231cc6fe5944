// Runs one registration job: reads its images, refines its starts and makes the result of each
// view.
#pragma once

#include <span>
#include <vector>

#include "host/cli/register_batch.h"
#include "host/cli/view_results.h"

namespace edgescout {

// A job whose images are read. The job must outlive it.
struct ReadyJob {
  const RegisterJob* job;
  std::vector<PreparedView> views;
  std::vector<ObjectPose> starts;  // in the job's order
};

// InputError: an image or a camera that cannot be used.
ReadyJob prepare_job(const RegisterJob& job, const DepthReader& depth, Backend& backend,
                     const RegisterOptions& options);

// Refines the starts in all views, in their order. A pose that no image shows gets OUT_OF_SIGHT and
// a warning. `edge_models` are those of `models`. InputError: an image too large for the device.
Detections refine_job(const ReadyJob& ready, std::span<const RegisterModel> models,
                      std::span<const EdgeModel> edge_models, Backend& backend,
                      const RegisterOptions& options);

// Returns the result of one view: the poses whose starts were given in it.
ImageResult result_of(const ReadyJob& ready, std::size_t view, const Detections& found,
                      std::span<const RegisterModel> models, const Backend& backend);

}  // namespace edgescout
