#include "host/register/schedules.h"

namespace edgescout {

namespace {

constexpr int SMALL_DEPTH_MAP_PX = 96;  // cheaper to draw; its points are exact enough here

// Columns: loss, scale px, iterations, points per view (0: all), scale of the loss against depth in
// standard deviations, samples of the surface.
D2coOptions with_rounds(std::vector<D2coRound> rounds) {
  D2coOptions options;
  options.rounds = std::move(rounds);
  return options;
}

D2coOptions on_small_depth_maps(D2coOptions options) {
  options.visibility.depth_map_size_px = SMALL_DEPTH_MAP_PX;
  return options;
}

}  // namespace

std::vector<D2coRound> D2coOptions::default_rounds() {
  return {{LOSS_GEMAN_MCCLURE, 30, 12, 400},
          {LOSS_GEMAN_MCCLURE, 15, 12, 500},
          {LOSS_GEMAN_MCCLURE, 8, 12, 700},
          {LOSS_GEMAN_MCCLURE, 4, 12, 0},
          {LOSS_GEMAN_MCCLURE, 2, 12, 0}};
}

namespace schedules {

D2coOptions search() {
  return on_small_depth_maps(with_rounds(
      {{LOSS_GEMAN_MCCLURE, 20, 8, 200, 12, 80}, {LOSS_GEMAN_MCCLURE, 6, 8, 250, 6, 100}}));
}

D2coOptions coarse() {
  return with_rounds(
      {{LOSS_GEMAN_MCCLURE, 12, 6, 120, 20, 60}, {LOSS_GEMAN_MCCLURE, 3, 6, 120, 8, 60}});
}

D2coOptions medium() {
  return on_small_depth_maps(with_rounds(
      {{LOSS_GEMAN_MCCLURE, 12, 6, 150, 10, 80}, {LOSS_GEMAN_MCCLURE, 5, 6, 200, 5, 100}}));
}

D2coOptions fine() {
  return with_rounds({{LOSS_GEMAN_MCCLURE, 12, 8, 300, 6},
                      {LOSS_GEMAN_MCCLURE, 5, 8, 500, 4},
                      {LOSS_GEMAN_MCCLURE, 2, 8, 0, 3, 300}});
}

D2coRound unsearched() { return {LOSS_GEMAN_MCCLURE, 30, 10, 300}; }

D2coOptions particles() {
  return on_small_depth_maps(with_rounds({{LOSS_GEMAN_MCCLURE, 12, 8, 250},
                                          {LOSS_GEMAN_MCCLURE, 5, 8, 300},
                                          {LOSS_GEMAN_MCCLURE, 2, 6, 400}}));
}

EdgeIcpOptions particles_edge_icp() {
  EdgeIcpOptions options;
  options.max_points = 200;  // several views see every particle: some of its points are enough
  options.visibility.depth_map_size_px = SMALL_DEPTH_MAP_PX;
  return options;
}

D2coOptions extrinsics() {
  return with_rounds({{LOSS_GEMAN_MCCLURE, 30, 10, 300},
                      {LOSS_GEMAN_MCCLURE, 12, 8, 300},
                      {LOSS_GEMAN_MCCLURE, 5, 8, 400}});
}

}  // namespace schedules

}  // namespace edgescout
