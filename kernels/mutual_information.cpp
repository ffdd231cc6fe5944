#include "kernels/mutual_information.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kernels/error.h"

namespace edgescout {

namespace {

// Of the logarithms' exponentials; one that is -infinity counts nothing.
double log_sum_exp(std::span<const double> logs) {
  const double top = *std::ranges::max_element(logs);
  if (std::isinf(top)) return top;
  double sum = 0;
  for (const double v : logs) sum += std::exp(v - top);
  return top + std::log(sum);
}

std::vector<double> log_weights(std::span<const ParticleBelief> beliefs) {
  std::vector<double> logs;
  for (const ParticleBelief& belief : beliefs) logs.push_back(belief.log_weight);
  const double total = log_sum_exp(logs);
  for (double& v : logs) v -= total;
  return logs;
}

// log l_ij, with Upsilon where the paper's own form is asked for.
double log_likelihood(const ChamferCell& cell, double cap_px, const ParticleBelief& belief, const InformationOptions& options) {
  const double seen = std::max(0.5, double(belief.already_seen) + cell.fresh), mu = mean_px(cell, cap_px);
  const double upsilon = options.literal ? belief.upsilon_px2 : 0;
  return std::log(seen / belief.total) - (mu * mu + upsilon) / options.scale_px2;
}

std::vector<double> log_likelihoods(const ChamferTable& table, std::uint32_t i, const ParticleBelief& belief,
                                    const InformationOptions& options) {
  std::vector<double> logs;
  for (std::uint32_t j = 0; j < table.realizations; ++j)
    logs.push_back(log_likelihood(table.cells[std::size_t(i) * table.realizations + j], table.cap_px, belief, options));
  if (options.literal) return logs;
  const double total = log_sum_exp(logs);
  for (double& v : logs) v -= total;
  return logs;
}

}  // namespace

void InformationOptions::validate() const {
  if (!(scale_px2 > 0 && std::isfinite(scale_px2)))
    throw InputError("information options", "scale_px2", std::to_string(scale_px2), "a number above 0");
}

void check_information(std::uint32_t particles, std::uint32_t realizations, std::span<const ParticleBelief> beliefs,
                       const InformationOptions& options) {
  options.validate();
  check(particles > 0 && realizations > 0, "mutual_information: no particles or no realizations");
  check(beliefs.size() == particles, "mutual_information: as many beliefs as particles");
  bool any = false;
  for (const ParticleBelief& belief : beliefs) {
    check(belief.log_weight < std::numeric_limits<double>::infinity(), "mutual_information: a log weight that is none");
    check(belief.total > 0, "mutual_information: a template without points");
    any = any || std::isfinite(belief.log_weight);
  }
  check(any, "mutual_information: all weights are 0");
}

double mutual_information_reference(const ChamferTable& table, std::span<const ParticleBelief> beliefs,
                                    const InformationOptions& options) {
  check_information(table.particles, table.realizations, beliefs, options);
  const std::vector<double> log_weight = log_weights(beliefs);
  std::vector<std::vector<double>> log_rows;
  for (std::uint32_t i = 0; i < table.particles; ++i) log_rows.push_back(log_likelihoods(table, i, beliefs[i], options));
  double information = 0;
  for (std::uint32_t j = 0; j < table.realizations; ++j) {
    std::vector<double> joint;
    for (std::uint32_t i = 0; i < table.particles; ++i) joint.push_back(log_weight[i] + log_rows[i][j]);
    const double log_evidence = log_sum_exp(joint);
    for (std::uint32_t i = 0; i < table.particles; ++i)
      if (std::isfinite(joint[i])) information += std::exp(joint[i]) * (log_rows[i][j] - log_evidence);
  }
  // Rounding alone can take it below.
  return std::max(0.0, information);
}

double mutual_information_fast(const ChamferTable& table, std::span<const ParticleBelief> beliefs, const InformationOptions& options,
                               ThreadPool&) {
  return mutual_information_reference(table, beliefs, options);
}

}  // namespace edgescout
