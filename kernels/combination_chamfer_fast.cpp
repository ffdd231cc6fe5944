// Combinations in blocks of 64, one byte each: a block's masks and rows stay in the second-level
// cache, its sums in registers.
#include <algorithm>
#include <array>
#include <span>

#include "kernels/chamfer_plan.h"
#include "kernels/combination_chamfer.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr std::size_t block = 64;
using Bytes = std::uint8_t __attribute__((vector_size(block)));
using Pairs = std::uint16_t __attribute__((vector_size(block)));
// A template forgets the alignment that is an attribute: vectors keep these.
struct alignas(block) Lanes {
  Bytes bytes;
};

// 0xff where the candidate is no member, [candidate][combination of the block].
std::vector<Lanes> absent_members(const CombinationBits& combinations, std::size_t first) {
  std::vector<Lanes> absent(combinations.candidates);
  for (std::size_t lane = 0; lane < block; ++lane)
    for (std::uint32_t c = 0; c < combinations.candidates; ++c)
      absent[c].bytes[lane] =
          first + lane < combinations.count && combinations.has(first + lane, c) ? 0 : 0xff;
  return absent;
}

// 0xff where the mask does not have the combination.
EDGESCOUT_SIMD_CLONES
void fill_masks(const ChamferPlan& plan, const Lanes* absent, Lanes* masks) {
  for (std::size_t m = 0; m < plan.masks.size(); ++m) {
    const ChamferMask& mask = plan.masks[m];
    Bytes out = mask.member == CHAMFER_NO_MEMBER ? Bytes{} : absent[mask.member].bytes;
    for (std::uint32_t h = 0; h < mask.hider_count; ++h)
      out |= ~absent[plan.hiders[mask.first_hider + h]].bytes;
    masks[m].bytes = out;
  }
}

EDGESCOUT_SIMD_CLONES
void fill_rows(const ChamferPlan& plan, const Lanes* masks, Lanes* rows) {
  constexpr std::uint32_t stride = 8;  // between looks whether every combination has its distance
  const Bytes cap = Bytes{} + static_cast<std::uint8_t>(plan.cap);
  for (std::size_t r = 0; r < plan.rows.size(); ++r) {
    const ChamferRow& row = plan.rows[r];
    const std::uint32_t *reach = plan.reach.data() + row.first_reach,
                        *end = reach + row.reach_count;
    Bytes least = cap;
    while (reach != end) {
      const std::uint32_t* stop = std::min(reach + stride, end);
      for (; reach != stop; ++reach) {
        const Bytes distance =
            (Bytes{} + static_cast<std::uint8_t>(*reach >> 24)) | masks[*reach & 0xffffffu].bytes;
        least = distance < least ? distance : least;
      }
      if (reach == end) break;
      const Bytes next = Bytes{} + static_cast<std::uint8_t>(*reach >> 24);
      using Words = std::uint64_t __attribute__((vector_size(block)));
      const Words farther = reinterpret_cast<Words>(least > next);
      std::uint64_t any = 0;
      for (std::size_t w = 0; w < block / 8; ++w) any |= farther[w];
      if (any == 0) break;
    }
    rows[r].bytes = least & ~masks[row.visible].bytes;
  }
}

struct Sums {
  std::array<std::uint32_t, block> distance{}, hidden{}, hidden_unseen{};
};

void flush(const Bytes& bytes, std::array<std::uint32_t, block>& sums) {
  for (std::size_t lane = 0; lane < block; ++lane) sums[lane] += bytes[lane];
}

using Visits = std::span<const ChamferVisit>;

// As many visits, from the first, as have at most CHAMFER_POINTS_AT_ONCE points: sums of distances
// fit 16 bits, counts a byte.
Visits take(Visits visits) {
  std::size_t count = 0;
  for (std::uint32_t points = 0; count < visits.size(); ++count) {
    points += visits[count].count;
    if (points > CHAMFER_POINTS_AT_ONCE) break;
  }
  return visits.first(count);
}

EDGESCOUT_SIMD_CLONES
void add_distances(Visits visits, const Lanes* rows, Sums& sums) {
  Pairs even{}, odd{};
  for (const ChamferVisit& visit : visits) {
    const Pairs row = reinterpret_cast<Pairs>(rows[visit.row].bytes);
    even += (row & 0xff) * visit.count;
    odd += (row >> 8) * visit.count;
  }
  for (std::size_t lane = 0; lane < block / 2; ++lane) {
    sums.distance[2 * lane] += even[lane];
    sums.distance[2 * lane + 1] += odd[lane];
  }
}

EDGESCOUT_SIMD_CLONES
void count_hidden(Visits visits, const ChamferPlan& plan, const Lanes* masks, Sums& sums) {
  Bytes hidden{}, unseen{};
  for (const ChamferVisit& visit : visits) {
    const Bytes gone = masks[plan.rows[visit.row].visible].bytes;
    hidden += gone & static_cast<std::uint8_t>(visit.count);
    unseen += gone & static_cast<std::uint8_t>(visit.unseen);
  }
  flush(hidden, sums.hidden);
  flush(unseen, sums.hidden_unseen);
}

Sums sums_of(const ChamferPlan& plan, const ChamferRun& run, const Lanes* masks,
             const Lanes* rows) {
  Sums sums;
  const Visits all = Visits(plan.visits).subspan(run.first, run.end - run.first);
  for (Visits rest = all, now; !rest.empty(); rest = rest.subspan(now.size())) {
    now = take(rest);
    add_distances(now, rows, sums);
  }
  for (Visits rest = all.subspan(run.first_hideable - run.first), now; !rest.empty();
       rest = rest.subspan(now.size())) {
    now = take(rest);
    count_hidden(now, plan, masks, sums);
  }
  return sums;
}

}  // namespace

std::vector<ChamferCell> combination_chamfer_fast(const ChamferView& view,
                                                  const CombinationBits& combinations,
                                                  const ChamferOptions& options, ThreadPool& pool) {
  check_chamfer(view, combinations, options);
  const ChamferPlan plan = plan_chamfer(view, options, pool);
  std::vector<ChamferCell> cells(view.particles() * combinations.count);
  pool.for_each((combinations.count + block - 1) / block, [&](std::size_t b) {
    const std::size_t first = b * block, lanes = std::min(block, combinations.count - first);
    const std::vector<Lanes> absent = absent_members(combinations, first);
    std::vector<Lanes> masks(plan.masks.size()), rows(plan.rows.size());
    fill_masks(plan, absent.data(), masks.data());
    fill_rows(plan, masks.data(), rows.data());
    for (std::size_t i = 0; i < plan.particles.size(); ++i) {
      const ChamferRun& run = plan.particles[i];
      const Sums sums = sums_of(plan, run, masks.data(), rows.data());
      for (std::size_t lane = 0; lane < lanes; ++lane)
        cells[i * combinations.count + first + lane] = {
            sums.distance[lane], std::uint16_t(run.points - sums.hidden[lane]),
            std::uint16_t(run.unseen - sums.hidden_unseen[lane])};
    }
  });
  return cells;
}

}  // namespace edgescout
