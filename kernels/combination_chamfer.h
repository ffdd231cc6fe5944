// Mean chamfer distance of every particle to every scene combination, seen from one view, without
// drawing one of them (paper, Sec. 5.2 and Eq. 16): the combination's distance at a pixel is the
// least of its members'.
//
// A *combination* is a combination of candidates, a *particle* a hypothetical pose with the edge
// points that show from the view. For particle i and combination C, over the particle's points
// whose nearest pixel p lies in the image:
//   hidden point:   a member's surface depth at p plus its tolerance is less than z. It leaves the
//   mean. hidden edge:    the edge point of member c nearest to p, where another member's surface
//   depth at *that edge point's* own
//                   nearest pixel plus its tolerance is less than its depth. Then c gives no
//                   distance at p, although a farther edge point of c might show: the mean is never
//                   too small for that, and rarely too large.
//   distance at p = min(cap, least chamfer_steps of the members' maps at p whose edge is not
//   hidden); seen = points not hidden, unseen = those of them flagged so, sum = sum of their
//   distances in 1/16 px of the map.
// mean_px = sum / (16 seen); the cap where nothing is seen.
//
// A member's tolerance keeps the one that stands for the particle's own object from hiding it: of
// the order of its position's uncertainty plus what depth changes over half a pixel of the map.
//
// Agreement: integers, equal on every path bit for bit. LogicError: lists of other sizes than the
// counts say, what candidate_map throws for, more than CHAMFER_MAX_POINTS points in a particle.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/candidate_map.h"

namespace edgescout {

// lavapipe ends a shader's loops after 65535 turns in all
inline constexpr std::uint32_t CHAMFER_MAX_POINTS = 16384;

struct ParticlePoint {
  float x_px, y_px;      // on the map
  float z_m;             // depth in the camera's frame
  std::uint32_t unseen;  // 1: not yet seen in a real view, else 0
};

// Everything seen from one view.
struct ChamferView {
  int width = 0, height = 0;                 // of the map
  std::span<const CandidateMap> candidates;  // in the order of the combinations' bits
  std::span<const MapEdge> edges;            // of all candidates
  std::span<const std::uint32_t> nearest;    // as candidate_map() gives it
  // depths with the layout of `nearest`, DEPTH_EMPTY where there is no object
  std::span<const float> surface_m;
  std::span<const float> tolerance_m;     // one a candidate, >= 0
  std::span<const ParticlePoint> points;  // of all particles
  // particles + 1: particle i has points [first_point[i], first_point[i + 1])
  std::span<const std::uint32_t> first_point;
  std::size_t particles() const { return first_point.empty() ? 0 : first_point.size() - 1; }
};

// One row of words a combination; candidate c is bit c % 32 of word c / 32. Bits beyond the
// candidates mean nothing.
struct CombinationBits {
  std::uint32_t count = 0, candidates = 0;
  std::span<const std::uint32_t> words;  // count * row_words()
  std::size_t row_words() const { return (std::size_t(candidates) + 31) / 32; }
  bool has(std::size_t combination, std::size_t candidate) const {
    return words[combination * row_words() + candidate / 32] >> (candidate % 32) & 1u;
  }
};

struct ChamferOptions {
  // px of the map, 1/16 to 255/16; rounded to 1/16
  float cap_px = float(CHAMFER_CAP) / float(CHAMFER_STEPS_PER_PX);
  std::uint32_t cap_steps() const {
    return std::uint32_t(std::lround(cap_px * float(CHAMFER_STEPS_PER_PX)));
  }
  void validate() const;  // throws InputError
};

struct ChamferCell {
  std::uint32_t sum = 0;  // 1/16 px of the map
  std::uint16_t seen = 0, unseen = 0;
};
inline double mean_px(const ChamferCell& cell, double cap_px) {
  return cell.seen == 0 ? cap_px : double(cell.sum) / (double(CHAMFER_STEPS_PER_PX) * cell.seen);
}

// What every path asks of its input; throws LogicError, and InputError for the options.
void check_chamfer(const ChamferView& view, const CombinationBits& combinations,
                   const ChamferOptions& options);

// Cells [particle][combination].
std::vector<ChamferCell> combination_chamfer_reference(const ChamferView& view,
                                                       const CombinationBits& combinations,
                                                       const ChamferOptions& options);
std::vector<ChamferCell> combination_chamfer_fast(const ChamferView& view,
                                                  const CombinationBits& combinations,
                                                  const ChamferOptions& options, ThreadPool& pool);

}  // namespace edgescout
