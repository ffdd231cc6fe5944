// Internal to host/active: all candidates as several possible views would see them: visible edges,
// surface and distance map. Made by the kernels depth_raster and candidate_map.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/core/types.h"
#include "host/model/visible_edges.h"
#include "host/register/occluders.h"

namespace edgescout {

// Maps in the order view, then candidate. A candidate that reaches behind a camera has an empty map
// in that view.
struct CandidateScene {
  int width = 0, height = 0;  // of a map
  std::size_t candidates = 0;
  std::vector<MapEdge> edges;
  std::vector<CandidateMap> maps;
  std::vector<std::uint32_t> nearest;
  std::vector<float> surface_m;
  std::vector<float> tolerance_m;  // one per candidate

  // Input of combination_chamfer for the given view. The caller adds the particles.
  ChamferView chamfer_view(std::size_t view) const;
};

struct CandidateSceneOptions {
  VisibilityOptions visibility;
  // Fraction of a candidate's diameter: a candidate hides nothing that lies less than this behind
  // its surface.
  double tolerance = 0.1;
  // What was measured hides candidates as well (measured_surface.h): one per view, or none.
  std::span<const Occluders> measured = {};
};

// `camera` is that of the maps. Each kernel is called once per object for all views: the caller
// bounds views times candidates. LogicError: more pixels than 32 bits can count, measured surfaces
// of another number of views.
CandidateScene draw_candidates(std::span<const EdgeModel> models,
                               std::span<const Detection> candidates, const Camera& camera,
                               std::span<const Se3> camera_from_world, Backend& backend,
                               const CandidateSceneOptions& options);

}  // namespace edgescout
