#include "host/detect/depth_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>

#include "host/core/quantile.h"
#include "host/edge/depth_edges.h"
#include "host/edge/edge_index.h"
#include "host/register/measured_depth.h"

namespace edgescout {

namespace {

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::optional<DepthWarning> alignment_warning(const DepthEdges& edges) {
  if (edges.fit == DepthFit::Elsewhere)
    return DepthWarning{
        DepthFault::OtherImage,
        fmt::format("{} of {} jumps of depth lie on edges, {} by chance", percent(edges.in_place),
                    edges.jumps, percent(edges.by_chance))};
  if (edges.fit == DepthFit::Moved)
    return DepthWarning{
        DepthFault::Moved,
        fmt::format(
            "{} of {} jumps of depth lie on edges, {} would if it were moved by ({}, {}) px",
            percent(edges.in_place), edges.jumps, percent(edges.best), edges.dx_px, edges.dy_px)};
  return {};
}

std::vector<float> measured_values(const DepthImage& depth) {
  std::vector<float> values;
  std::ranges::copy_if(depth.z_m, std::back_inserter(values), [](float z_m) { return z_m > 0; });
  return values;
}

double share_inside(std::span<const float> values, const Range& distances_m, double factor) {
  const auto inside = std::ranges::count_if(values, [&](float z_m) {
    return z_m * factor >= distances_m.low && z_m * factor <= distances_m.high;
  });
  return double(inside) / double(values.size());
}

// The power of ten by which most values lie inside the range; none: it cannot be the unit.
std::optional<double> unit_that_fits(std::span<const float> values, const Range& distances_m) {
  constexpr double most = 0.5;
  for (const double factor : {0.1, 10.0, 0.01, 100.0, 0.001, 1000.0})
    if (share_inside(values, distances_m, factor) > most) return factor;
  return {};
}

std::optional<DepthWarning> unit_warning(const DepthImage& depth, const Range& distances_m) {
  constexpr std::size_t fewest = 1000;
  constexpr double least_share = 0.01;
  const std::vector<float> values = measured_values(depth);
  if (values.size() < fewest) return {};
  if (share_inside(values, distances_m, 1) > least_share) return {};
  const std::optional<double> factor = unit_that_fits(values, distances_m);
  if (!factor) return {};
  return DepthWarning{
      DepthFault::Unit,
      fmt::format("depth has a median of {:.4g} m, objects are sought at {:.4g} to "
                  "{:.4g} m: {:g} times the "
                  "unit would fit",
                  upper_median(values), distances_m.low, distances_m.high, *factor)};
}

}  // namespace

std::vector<DepthWarning> check_depth(const ObjectView& view, const Range& distances_m) {
  if (!view.depth || !view.edges) return {};
  const DepthImage& depth = view.depth->image;
  std::vector<DepthWarning> warnings;
  if (const auto unit = unit_warning(depth, distances_m)) warnings.push_back(*unit);
  if (const auto alignment =
          alignment_warning(compare_depth_edges(depth, view.depth->noise, view.edges->points())))
    warnings.push_back(*alignment);
  return warnings;
}

Range surface_distances_m(std::span<const TemplateSet> sets) {
  constexpr double at_the_border = 0.8;  // of a wide image: along the axis, not along the ray
  Range distances{std::numeric_limits<double>::infinity(), 0};
  for (const TemplateSet& set : sets) {
    distances.low =
        std::min(distances.low,
                 std::max(0.0, at_the_border * set.options.distance_min_m - set.model.radius_m));
    distances.high = std::max(distances.high, set.options.distance_max_m + set.model.radius_m);
  }
  return distances;
}

}  // namespace edgescout
