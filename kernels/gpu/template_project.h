// Records template_project (kernels/template_project.h).
#pragma once

#include <span>
#include <vector>

#include "kernels/gpu/batch.h"
#include "kernels/template_project.h"

namespace edgescout::gpu {

class TemplateProject {
 public:
  explicit TemplateProject(const Device& device);
  // How many jobs from the front go into one batch: as many as the device binds with their points,
  // and not so many that they fill its memory. At least one.
  std::size_t that_fit(std::span<const TemplateProjectJob> jobs) const;
  // Jobs of a call that check_template_project() has seen; `planes` as ModelPointPlanes::values(),
  // on the device. Points and counts stay on the device until the next record().
  void record(Batch& batch, const Buffer<float>& planes, std::span<const TemplateProjectJob> jobs,
              const TemplateProjectOptions& options);
  void download(Batch& batch);
  // What download() brought, after the batch has run. `jobs` are those recorded last.
  void collect(std::span<const TemplateProjectJob> jobs, std::span<TemplatePoint> projected,
               std::span<std::uint32_t> too_near) const;

 private:
  const Device& device_;
  Kernel kernel_;
  Buffer<TemplateProjectJob> jobs_;
  Buffer<TemplatePoint> projected_;
  Buffer<std::uint32_t> too_near_;
  std::vector<TemplatePoint> host_projected_;
  std::vector<std::uint32_t> host_too_near_;
};

}  // namespace edgescout::gpu
