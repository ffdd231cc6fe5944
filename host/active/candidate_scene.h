// Internal to host/active: every candidate as several possible views would see it: visible edges,
// surface, distance map, by the kernels depth_raster and candidate_map.
#pragma once

#include <span>
#include <vector>

#include "host/core/types.h"
#include "host/model/visible_edges.h"

namespace edgescout {

// Maps by view, then candidate. A candidate that reaches behind a camera is not in that view.
struct CandidateScene {
  int width = 0, height = 0;  // of the map
  std::size_t candidates = 0;
  std::vector<MapEdge> edges;
  std::vector<CandidateMap> maps;
  std::vector<std::uint32_t> nearest;
  std::vector<float> surface_m;
  std::vector<float> tolerance_m;  // one a candidate

  // What combination_chamfer reads of the given view; its particles are left to the caller.
  ChamferView seen_from(std::size_t view) const;
};

// `camera` is that of the map; `tolerance` is a fraction of a candidate's diameter: nearer behind
// its surface it hides nothing. All views in one call of each kernel and object: the caller bounds
// views times candidates.
CandidateScene draw_candidates(std::span<const EdgeModel> models,
                               std::span<const Detection> candidates, const Camera& camera,
                               std::span<const Se3> camera_from_world, Backend& backend,
                               const VisibilityOptions& visibility, double tolerance);

}  // namespace edgescout
