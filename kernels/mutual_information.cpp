#include "kernels/mutual_information.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "kernels/error.h"
#include "kernels/thread_pool.h"

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

// log l_ij, with Upsilon where the paper's own form is asked for.
double log_likelihood(const ChamferCell& cell, double cap_px, const ParticleBelief& belief,
                      const InformationOptions& options) {
  const double seen = std::max(0.5, double(belief.already_seen) + cell.unseen),
               mu = mean_px(cell, cap_px);
  const double upsilon = options.use_paper_formula ? belief.upsilon_px2 : 0;
  return std::log(seen / belief.total) - (mu * mu + upsilon) / options.scale_px2;
}

std::vector<double> log_likelihoods(const ChamferTable& table, std::uint32_t i,
                                    const ParticleBelief& belief,
                                    const InformationOptions& options) {
  std::vector<double> logs;
  for (std::uint32_t j = 0; j < table.combinations; ++j)
    logs.push_back(log_likelihood(table.cells[std::size_t(i) * table.combinations + j],
                                  table.cap_px, belief, options));
  if (options.use_paper_formula) return logs;
  const double total = log_sum_exp(logs);
  for (double& v : logs) v -= total;
  return logs;
}

void check_table(const ChamferTable& table, std::span<const ParticleBelief> beliefs,
                 const InformationOptions& options) {
  check_information(table.particles, table.combinations, beliefs, options);
  check(table.cells.size() == std::size_t(table.particles) * table.combinations,
        "mutual_information: cells of the table");
}

}  // namespace

std::vector<double> normalised_log_weights(std::span<const ParticleBelief> beliefs) {
  std::vector<double> logs;
  for (const ParticleBelief& belief : beliefs) logs.push_back(belief.log_weight);
  const double total = log_sum_exp(logs);
  for (double& v : logs) v -= total;
  return logs;
}

void InformationOptions::validate() const {
  if (!(scale_px2 > 0 && std::isfinite(scale_px2)))
    throw InputError("information options", "scale_px2", std::to_string(scale_px2),
                     "a number above 0");
}

void check_information(std::uint32_t particles, std::uint32_t combinations,
                       std::span<const ParticleBelief> beliefs, const InformationOptions& options) {
  options.validate();
  check(particles > 0 && combinations > 0, "mutual_information: no particles or no combinations");
  check(particles <= INFORMATION_MAX_PARTICLES, "mutual_information: too many particles");
  check(beliefs.size() == particles, "mutual_information: as many beliefs as particles");
  bool any = false;
  for (const ParticleBelief& belief : beliefs) {
    check(belief.log_weight < std::numeric_limits<double>::infinity(),
          "mutual_information: a log weight that is none");
    check(belief.total > 0, "mutual_information: a template without points");
    any = any || std::isfinite(belief.log_weight);
  }
  check(any, "mutual_information: all weights are 0");
}

double mutual_information_reference(const ChamferTable& table,
                                    std::span<const ParticleBelief> beliefs,
                                    const InformationOptions& options) {
  check_table(table, beliefs, options);
  const std::vector<double> log_weight = normalised_log_weights(beliefs);
  std::vector<std::vector<double>> log_rows;
  for (std::uint32_t i = 0; i < table.particles; ++i)
    log_rows.push_back(log_likelihoods(table, i, beliefs[i], options));
  double information = 0;
  for (std::uint32_t j = 0; j < table.combinations; ++j) {
    std::vector<double> joint;
    for (std::uint32_t i = 0; i < table.particles; ++i)
      joint.push_back(log_weight[i] + log_rows[i][j]);
    const double log_evidence = log_sum_exp(joint);
    for (std::uint32_t i = 0; i < table.particles; ++i)
      if (std::isfinite(joint[i]))
        information += std::exp(joint[i]) * (log_rows[i][j] - log_evidence);
  }
  // Rounding alone can take it below.
  return std::max(0.0, information);
}

namespace {

// What a run of particles adds: to the evidence of every combination, and to the mean of sum_j L
// log L.
struct Share {
  std::vector<double> evidence;
  double mean_l_log_l = 0;
};

class FastInformation {
 public:
  FastInformation(const ChamferTable& table, std::span<const ParticleBelief> beliefs,
                  const InformationOptions& options)
      : table_(table),
        beliefs_(beliefs),
        options_(options),
        log_weight_(normalised_log_weights(beliefs)) {
    std::size_t unseen = 0, seen = 0;
    for (const ChamferCell& cell : table.cells) unseen = std::max<std::size_t>(unseen, cell.unseen);
    for (const ParticleBelief& belief : beliefs)
      seen = std::max<std::size_t>(seen, belief.already_seen);
    log_count_.push_back(std::log(0.5));
    for (std::size_t k = 1; k <= std::min(unseen + seen, most_tabled); ++k)
      log_count_.push_back(std::log(double(k)));
  }

  Share share(std::size_t begin, std::size_t end) const {
    Share sum{std::vector<double>(table_.combinations, 0.0)};
    std::vector<double> logs(table_.combinations);
    for (std::size_t i = begin; i < end; ++i) {
      const double weight = std::exp(log_weight_[i]);
      if (weight == 0) continue;
      fill_logs(i, logs);
      const double shift = options_.use_paper_formula ? 0 : log_sum_exp(logs);
      double l_log_l = 0;
      for (std::size_t j = 0; j < logs.size(); ++j) {
        const double log_l = logs[j] - shift, l = std::exp(log_l);
        sum.evidence[j] += weight * l;
        l_log_l += l * log_l;
      }
      sum.mean_l_log_l += weight * l_log_l;
    }
    return sum;
  }

 private:
  static constexpr std::size_t most_tabled = 1u << 17;

  void fill_logs(std::size_t i, std::span<double> logs) const {
    const ParticleBelief& belief = beliefs_[i];
    const double offset =
        std::log(double(belief.total)) +
        (options_.use_paper_formula ? belief.upsilon_px2 / options_.scale_px2 : 0);
    const std::span cells = table_.cells.subspan(i * table_.combinations, table_.combinations);
    for (std::size_t j = 0; j < logs.size(); ++j) {
      const double mu = mean_px(cells[j], table_.cap_px);
      logs[j] = log_count(std::size_t(belief.already_seen) + cells[j].unseen) -
                mu * mu / options_.scale_px2 - offset;
    }
  }
  double log_count(std::size_t k) const {
    return k < log_count_.size() ? log_count_[k] : std::log(double(k));
  }

  const ChamferTable& table_;
  std::span<const ParticleBelief> beliefs_;
  const InformationOptions& options_;
  std::vector<double> log_weight_;
  std::vector<double> log_count_;  // of points seen, half a point for none
};

}  // namespace

// I = sum_i w_i sum_j L log L - sum_j p log p: one look at every particle, and no table beside the
// cells.
double mutual_information_fast(const ChamferTable& table, std::span<const ParticleBelief> beliefs,
                               const InformationOptions& options, ThreadPool& pool) {
  check_table(table, beliefs, options);
  const FastInformation information(table, beliefs, options);
  constexpr std::size_t chunk = 16;  // sums are of the same order whatever the number of threads
  std::vector<Share> shares((table.particles + chunk - 1) / chunk);
  pool.for_each(shares.size(), [&](std::size_t s) {
    shares[s] =
        information.share(s * chunk, std::min<std::size_t>(table.particles, (s + 1) * chunk));
  });
  double sum = 0;
  for (const Share& share : shares) sum += share.mean_l_log_l;
  for (std::uint32_t j = 0; j < table.combinations; ++j) {
    double evidence = 0;
    for (const Share& share : shares) evidence += share.evidence[j];
    if (evidence > 0) sum -= evidence * std::log(evidence);
  }
  return std::max(0.0, sum);
}

}  // namespace edgescout
