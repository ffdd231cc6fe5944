#include "kernels/gpu/mutual_information.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "information_columns.spv.h"
#include "information_rows.spv.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(InformationBelief) == 4 * INFORMATION_BELIEF_WORDS);

std::vector<InformationBelief> beliefs_for_device(std::span<const ParticleBelief> beliefs,
                                                  const InformationOptions& options) {
  std::vector<InformationBelief> out;
  const std::vector<double> log_weight = normalised_log_weights(beliefs);
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    const double upsilon =
        options.use_paper_formula ? beliefs[i].upsilon_px2 / options.scale_px2 : 0;
    out.push_back({float(std::exp(log_weight[i])), float(beliefs[i].already_seen),
                   float(std::log(double(beliefs[i].total)) + upsilon)});
  }
  return out;
}

}  // namespace

MutualInformation::MutualInformation(const Device& device)
    : device_(device),
      rows_kernel_(device,
                   {"information_rows", information_rows_spv, 4, sizeof(InformationPush), {}}),
      columns_kernel_(
          device,
          {"information_columns", information_columns_spv, 5, sizeof(InformationPush), {}}) {}

void MutualInformation::record(Batch& batch, const DeviceCells& cells, double cap_px,
                               std::span<const ParticleBelief> beliefs,
                               const InformationOptions& options) {
  check_information(cells.particles, cells.combinations, beliefs, options);
  const std::vector<InformationBelief> own = beliefs_for_device(beliefs, options);
  beliefs_.reserve(device_, own.size(), "beliefs");
  shifts_.reserve(device_, own.size(), "log likelihoods");
  shares_.reserve(device_, cells.combinations, "information");
  batch.upload<InformationBelief>(beliefs_, own);
  log_scale_ = 0;
  if (options.use_paper_formula) {
    const float least = std::ranges::min(own, {}, &InformationBelief::log_offset).log_offset;
    log_scale_ = -double(least);
    batch.upload<float>(shifts_, std::vector<float>(own.size(), -least));
  }
  batch.barrier();
  const InformationPush push{cells.particles, cells.combinations, float(cap_px),
                             float(1 / options.scale_px2)};
  if (!options.use_paper_formula) {
    batch.dispatch(rows_kernel_, spread(cells.particles),
                   {cells.sums, cells.counts, beliefs_, shifts_}, push);
    batch.barrier();
  }
  batch.dispatch(columns_kernel_, spread(groups_for(cells.combinations, INFORMATION_GROUP)),
                 {cells.sums, cells.counts, beliefs_, shifts_, shares_}, push);
  host_shares_.resize(cells.combinations);
  batch.download<float>(shares_, host_shares_);
}

double MutualInformation::information() const {
  return std::exp(log_scale_) * std::accumulate(host_shares_.begin(), host_shares_.end(), 0.0);
}

}  // namespace edgescout::gpu
