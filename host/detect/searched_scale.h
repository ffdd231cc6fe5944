// One scale of a template set as the scan searches it: its templates by number, and their poses.
#pragma once

#include <numbers>
#include <vector>

#include "host/detect/coarse_scan.h"

namespace edgescout {

// The parameters of a template by its number. Numbers run over viewpoints, in-plane turns and
// distances; the distance changes fastest.
struct TemplateNumbering {
  std::size_t viewpoints;
  int in_plane_steps;
  std::vector<double> distances_m;

  std::size_t count() const { return viewpoints * in_plane_steps * distances_m.size(); }
  int viewpoint(std::size_t t) const { return int(t / (in_plane_steps * distances_m.size())); }
  double in_plane_rad(std::size_t t) const {
    return 2 * std::numbers::pi / in_plane_steps * double(t / distances_m.size() % in_plane_steps);
  }
  double distance_m(std::size_t t) const { return distances_m[t % distances_m.size()]; }
};

// A template at its best anchor of a region.
struct ScoredTemplate {
  std::size_t number;
  Eigen::Vector2d anchor_px;
  double mean_px, rank;
};

// One scale of a template set and the tensors on which it is scanned.
struct SearchedScale {
  const TemplateSet& set;
  int index;  // of distance_scales
  const ReducedTensors& level;
  TemplateNumbering numbering;

  SearchedScale(const TemplateSet& templates, int scale, const ObjectView& view)
      : set(templates),
        index(scale),
        level(view.reduced[level_of_scale(templates, scale, view)]),
        numbering{
            set.views.size(), set.options.in_plane_steps,
            template_distances_m(set.options, distance_scales(set.options)[std::size_t(scale)])} {}

  Se3 camera_from_object(std::size_t number, const Eigen::Vector2d& anchor_px) const {
    return place_template(set, set.views[std::size_t(numbering.viewpoint(number))],
                          numbering.in_plane_rad(number), numbering.distance_m(number), anchor_px,
                          level.camera);
  }

  ScanHit hit_of(const ScoredTemplate& scored) const {
    return {{0, camera_from_object(scored.number, scored.anchor_px)},
            numbering.viewpoint(scored.number),
            index,
            scored.mean_px,
            scored.rank};
  }
};

}  // namespace edgescout
