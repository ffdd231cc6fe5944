// The definition: every particle against every combination, point by point and member by member.
#include <algorithm>
#include <cmath>
#include <string>

#include "kernels/combination_chamfer.h"
#include "kernels/depth_raster.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

class Combination {
 public:
  Combination(const ChamferView& view, const CombinationBits& combinations, std::size_t j,
              const ChamferOptions& options)
      : view_(view), cap_(options.cap_steps()) {
    for (std::uint32_t c = 0; c < combinations.candidates; ++c)
      if (combinations.has(j, c)) members_.push_back(c);
  }

  // Whether a member other than `own` stands in front of depth z at a pixel.
  bool hides(int x, int y, float z_m, std::uint32_t own) const {
    return std::ranges::any_of(members_, [&](std::uint32_t c) {
      const CandidateMap& map = view_.candidates[c];
      return c != own && map.window.contains(x, y) &&
             view_.surface_m[map.first_pixel + map.window.index(x, y)] + view_.tolerance_m[c] < z_m;
    });
  }

  std::uint32_t distance(int x, int y) const {
    std::uint32_t least = cap_;
    for (const std::uint32_t c : members_) {
      const CandidateMap& map = view_.candidates[c];
      if (!map.window.contains(x, y)) continue;
      const std::uint32_t word = view_.nearest[map.first_pixel + map.window.index(x, y)];
      if (word == CANDIDATE_MAP_EMPTY) continue;
      check((word & 0xffffu) < map.edge_count,
            "combination_chamfer: a nearest edge point that is none");
      if (edge_hidden(c, view_.edges[map.first_edge + (word & 0xffffu)])) continue;
      least = std::min(least, chamfer_steps(word));
    }
    return least;
  }

 private:
  bool edge_hidden(std::uint32_t c, const MapEdge& edge) const {
    int x = 0, y = 0;
    check(nearest_pixel(edge.x_px, edge.y_px, view_.width, view_.height, x, y),
          "combination_chamfer: a nearest edge point outside");
    return hides(x, y, edge.z_m, c);
  }

  const ChamferView& view_;
  std::uint32_t cap_;
  std::vector<std::uint32_t> members_;
};

constexpr std::uint32_t nobody = ~0u;

ChamferCell cell_of(const ChamferView& view, const Combination& combination, std::size_t particle) {
  ChamferCell cell;
  for (std::uint32_t p = view.first_point[particle]; p < view.first_point[particle + 1]; ++p) {
    const ParticlePoint& point = view.points[p];
    int x = 0, y = 0;
    if (!nearest_pixel(point.x_px, point.y_px, view.width, view.height, x, y)) continue;
    if (combination.hides(x, y, point.z_m, nobody)) continue;
    cell.sum += combination.distance(x, y);
    ++cell.seen;
    cell.unseen += static_cast<std::uint16_t>(point.unseen);
  }
  return cell;
}

}  // namespace

void ChamferOptions::validate() const {
  const float most = float(CHAMFER_CAP) / float(CHAMFER_STEPS_PER_PX);
  if (!(cap_px >= 1 / float(CHAMFER_STEPS_PER_PX) && cap_px <= most))
    throw InputError("chamfer options", "cap_px", std::to_string(cap_px),
                     "0.0625 to " + std::to_string(most));
}

void check_chamfer(const ChamferView& view, const CombinationBits& combinations,
                   const ChamferOptions& options) {
  options.validate();
  check_candidate_maps(view.edges.size(), view.candidates, view.width, view.height,
                       view.nearest.size());
  check(view.surface_m.size() == view.nearest.size(),
        "combination_chamfer: as many surface depths as pixels");
  check(
      view.tolerance_m.size() == view.candidates.size() &&
          std::ranges::all_of(view.tolerance_m, [](float tolerance_m) { return tolerance_m >= 0; }),
      "combination_chamfer: one tolerance from 0 a candidate");
  check(combinations.candidates == view.candidates.size(),
        "combination_chamfer: combinations of other candidates");
  check(combinations.words.size() == combinations.count * combinations.row_words(),
        "combination_chamfer: words of the combinations");
  check(!view.first_point.empty() && view.first_point.back() <= view.points.size(),
        "combination_chamfer: points beyond the list");
  for (std::size_t i = 0; i < view.particles(); ++i) {
    const std::uint32_t first = view.first_point[i], end = view.first_point[i + 1];
    check(first <= end && end - first <= CHAMFER_MAX_POINTS,
          "combination_chamfer: points of a particle");
  }
  for (std::uint32_t p = view.first_point.front(); p < view.first_point.back(); ++p)
    check(view.points[p].unseen <= 1, "combination_chamfer: unseen is 0 or 1");
}

std::vector<ChamferCell> combination_chamfer_reference(const ChamferView& view,
                                                       const CombinationBits& combinations,
                                                       const ChamferOptions& options) {
  check_chamfer(view, combinations, options);
  std::vector<ChamferCell> cells(view.particles() * combinations.count);
  for (std::size_t j = 0; j < combinations.count; ++j) {
    const Combination combination(view, combinations, j, options);
    for (std::size_t i = 0; i < view.particles(); ++i)
      cells[i * combinations.count + j] = cell_of(view, combination, i);
  }
  return cells;
}

}  // namespace edgescout
