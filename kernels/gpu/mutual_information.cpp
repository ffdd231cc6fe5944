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

void MutualInformation::record(Batch& batch, std::span<const DeviceCells> cells, double cap_px,
                               std::span<const ParticleBelief> beliefs,
                               const InformationOptions& options) {
  for (const DeviceCells& of_view : cells)
    check_information(of_view.particles, of_view.combinations, beliefs, options);
  const std::vector<InformationBelief> own = beliefs_for_device(beliefs, options);
  beliefs_.reserve(device_, own.size(), "beliefs");
  batch.upload<InformationBelief>(beliefs_, own);
  const float least = std::ranges::min(own, {}, &InformationBelief::log_offset).log_offset;
  log_scale_ = options.use_paper_formula ? -double(least) : 0;
  const auto push_of = [&](const DeviceCells& of_view) {
    return InformationPush{of_view.particles, of_view.combinations, float(cap_px),
                           float(1 / options.scale_px2)};
  };
  views_.resize(cells.size());
  for (std::size_t v = 0; v < cells.size(); ++v) {
    views_[v].shifts.reserve(device_, own.size(), "log likelihoods");
    views_[v].shares.reserve(device_, cells[v].combinations, "information");
    views_[v].host_shares.resize(cells[v].combinations);
    if (options.use_paper_formula)
      batch.upload<float>(views_[v].shifts, std::vector<float>(own.size(), -least));
  }
  batch.barrier();
  if (!options.use_paper_formula) {
    for (std::size_t v = 0; v < cells.size(); ++v)
      batch.dispatch(rows_kernel_, spread(cells[v].particles),
                     {cells[v].sums, cells[v].counts, beliefs_, views_[v].shifts},
                     push_of(cells[v]));
    batch.barrier();
  }
  for (std::size_t v = 0; v < cells.size(); ++v)
    batch.dispatch(columns_kernel_, spread(groups_for(cells[v].combinations, INFORMATION_GROUP)),
                   {cells[v].sums, cells[v].counts, beliefs_, views_[v].shifts, views_[v].shares},
                   push_of(cells[v]));
  for (OfView& view : views_) batch.download<float>(view.shares, view.host_shares);
}

std::vector<double> MutualInformation::information() const {
  std::vector<double> nats;
  for (const OfView& view : views_)
    nats.push_back(std::exp(log_scale_) *
                   std::accumulate(view.host_shares.begin(), view.host_shares.end(), 0.0));
  return nats;
}

}  // namespace edgescout::gpu
