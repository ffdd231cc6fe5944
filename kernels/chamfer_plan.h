// combination_chamfer without its combinations: what the fast path and Vulkan share. Everything
// that does not depend on the combination is decided here once, so that what remains is bytes to
// look up and to add.
//
// A *mask* is a set of combinations: those with a candidate, but without any of those that hide it.
// A *row* is what a point meets at one pixel when given surfaces lie in front of it: for every
// combination the distance, one byte, 0 where the point is hidden. Many points of many particles
// share a row.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/chamfer_push.h"
#include "kernels/combination_chamfer.h"

namespace edgescout {

struct ChamferMask {
  std::uint32_t member = CHAMFER_NO_MEMBER;  // every combination, but
  std::uint32_t first_hider = 0,
                hider_count = 0;  // those with one of hiders[first_hider, + hider_count)
};

struct ChamferRow {
  // Distances in 1/16 px << 24 | mask, nearest first: the first whose mask has the combination is
  // its distance.
  std::uint32_t first_reach = 0, reach_count = 0;
  std::uint32_t visible = 0;  // mask; 0: nothing hides it
};

// Neighbouring points of a particle on one row.
struct ChamferVisit {
  std::uint32_t row = 0;
  std::uint16_t count = 0;   // points, 1 to CHAMFER_POINTS_AT_ONCE
  std::uint16_t unseen = 0;  // of them
};

struct ChamferRun {
  std::uint32_t first = 0, first_hideable = 0,
                end = 0;  // of `visits`: those to rows that nothing hides, then the others
  std::uint32_t points = 0, unseen = 0;  // of all of them
};

struct ChamferPlan {
  std::uint32_t cap = CHAMFER_CAP;
  std::vector<ChamferMask> masks;  // 0: all combinations; 1 + c: those with candidate c
  std::vector<std::uint32_t> hiders, reach;
  std::vector<ChamferRow> rows;
  std::vector<ChamferVisit> visits;
  std::vector<ChamferRun> particles;
};

// Of what check_chamfer() has passed. Throws LogicError for more than 2^24 masks or 2^31 rows, and
// for a nearest edge point that is none.
ChamferPlan plan_chamfer(const ChamferView& view, const ChamferOptions& options, ThreadPool& pool);

}  // namespace edgescout
