// What a view is expected to tell about the particles: mutual information between the particle and
// the combination seen there (paper, Eq. 15), from the cells of combination_chamfer.
//
// With particle i, combination j, mu_ij = mean_px (Eq. 16), s = scale_px2 and
//   gamma_ij = (already_seen_i + fresh_ij) / total_i        (Eq. 20; of a particle never seen, half
//   a point), log l_ij = log gamma_ij - mu_ij^2 / s,
// a likelihood is a distribution over what may be seen: L_ij = l_ij / sum_j l_ij, in the log
// domain. Then, w_i being the normalised weights, p_j = sum_i w_i L_ij and
//   I = sum_i w_i sum_j L_ij log(L_ij / p_j)    in nats, in [0, min(log particles, log
//   combinations)].
// The real views stand in the weights alone. `use_paper_formula` is the paper's own form instead:
// L_ij = l_ij exp(-upsilon_i / s), not normalised (Eq. 19 and 20). It is still >= 0, but no mutual
// information: it falls with every real view and where all is unlikely, and has no bound of this
// kind; below exp(-745) it is 0.
//
// Agreement: the reference and the fast path to 1e-9 (1 + I), Vulkan, in float, to 1e-4 (1 + I) +
// 1e-6 q for scale_px2 of at least cap_px^2 / INFORMATION_MAX_SHARPNESS, q = cap_px^2 / scale_px2
// being the most nats that mu^2 / s comes to (a device may be off by 3e-7 of a quotient, and
// squares it). LogicError: no particles or no combinations, more than INFORMATION_MAX_PARTICLES,
// beliefs of another number than the particles, a total of 0, a log weight that is no number or
// +infinity, or all weights 0.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "kernels/combination_chamfer.h"

namespace edgescout {

inline constexpr std::uint32_t INFORMATION_MAX_PARTICLES = 16384;  // as CHAMFER_MAX_POINTS
inline constexpr double INFORMATION_MAX_SHARPNESS =
    10000;  // more nats than that float does not tell apart

struct ParticleBelief {
  double log_weight = 0;  // natural logarithm, up to a constant common to all; -infinity: weight 0
  std::uint32_t already_seen = 0;  // points of its template seen in real views
  std::uint32_t total = 1;         // points of its template
  double upsilon_px2 = 0;          // sum of squared means over real views, px of the map (Eq. 18);
                                   // `use_paper_formula` reads it
};

struct InformationOptions {
  double scale_px2 = 8;  // s = 2 sigma^2, px of the map; > 0
  bool use_paper_formula = false;
  void validate() const;  // throws InputError
};

// The cells of one view, [particle][combination], and the cap they were made with.
struct ChamferTable {
  std::uint32_t particles = 0, combinations = 0;
  double cap_px = 0;
  std::span<const ChamferCell> cells;
};

// What every path asks of its input; throws LogicError, and InputError for the options.
void check_information(std::uint32_t particles, std::uint32_t combinations,
                       std::span<const ParticleBelief> beliefs, const InformationOptions& options);

// log w_i; -infinity for a weight of 0.
std::vector<double> normalised_log_weights(std::span<const ParticleBelief> beliefs);

double mutual_information_reference(const ChamferTable& table,
                                    std::span<const ParticleBelief> beliefs,
                                    const InformationOptions& options);
double mutual_information_fast(const ChamferTable& table, std::span<const ParticleBelief> beliefs,
                               const InformationOptions& options, ThreadPool& pool);

}  // namespace edgescout
