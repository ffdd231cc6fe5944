#include "host/cli/depth_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/core/log.h"
#include "host/core/quantile.h"
#include "host/edge/depth_edges.h"
#include "host/edge/edge_index.h"
#include "host/register/measured_depth.h"

namespace edgescout {

namespace {

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

// What to say of the place of jumps; empty: nothing.
std::string doubt_of_place(const DepthEdges& edges) {
  if (edges.fit == DepthFit::Elsewhere)
    return fmt::format("{} of {} jumps of depth lie on edges, {} by chance",
                       percent(edges.in_place), edges.jumps, percent(edges.by_chance));
  if (edges.fit == DepthFit::Moved)
    return fmt::format(
        "{} of {} jumps of depth lie on edges, {} would if it were moved by ({}, {}) px",
        percent(edges.in_place), edges.jumps, percent(edges.best), edges.dx_px, edges.dy_px);
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

std::string doubt_of_unit(const DepthImage& depth, const Range& distances_m) {
  constexpr std::size_t fewest = 1000;
  constexpr double least_share = 0.01;
  const std::vector<float> values = measured_values(depth);
  if (values.size() < fewest) return {};
  if (share_inside(values, distances_m, 1) > least_share) return {};
  const std::optional<double> factor = unit_that_fits(values, distances_m);
  if (!factor) return {};
  return fmt::format(
      "depth has a median of {:.4g} m, objects are sought at {:.4g} to {:.4g} m: {:g} times the "
      "unit would fit",
      upper_median(values), distances_m.low, distances_m.high, *factor);
}

}  // namespace

// Several poses, since the edges of one hold its distance badly. Errors that all poses share, such
// as bright surfaces that look larger, do not average out: the offset must be as large as the
// poses' spread.
std::string doubt_of_bias(std::span<const DepthOffset> offsets) {
  constexpr std::size_t fewest = 5;
  constexpr double least_errors = 4, of_normal = 1.4826, of_median = 1.2533;
  if (offsets.size() < fewest) return {};
  std::vector<double> values, deviations;
  for (const DepthOffset& offset : offsets) values.push_back(offset.offset_m);
  const double offset_m = upper_median(values);
  for (const double value : values) deviations.push_back(std::abs(value - offset_m));
  const double spread_m = of_normal * upper_median(deviations),
               error_m = of_median * spread_m / std::sqrt(double(values.size()));
  if (std::abs(offset_m) <= std::max(least_errors * error_m, spread_m)) return {};
  return fmt::format(
      "depth moves poses {:.2f} +- {:.2f} mm {} the camera than their edges alone, in the median "
      "of {}: is the sensor biased?",
      1e3 * std::abs(offset_m), 1e3 * error_m, offset_m > 0 ? "farther from" : "nearer to",
      values.size());
}

void DepthDoubts::look_at(const std::string& image, const ObjectView& view,
                          const Range& distances_m) {
  if (!view.depth || !view.edges) return;
  ++looked_at_;
  const DepthImage& depth = view.depth->image;
  add("is the depth of another unit (--depth-unit)?", image, doubt_of_unit(depth, distances_m));
  const DepthEdges edges = compare_depth_edges(depth, view.depth->noise, view.edges->points());
  add(edges.fit == DepthFit::Moved ? "is the pose of the depth camera wrong (--depth-pose)?"
                                   : "is it the depth of another image?",
      image, doubt_of_place(edges));
}

void DepthDoubts::compare(const std::string& image, const Scene& scene,
                          std::span<const Detection> found) {
  constexpr double least_probability = 0.5;
  constexpr std::size_t most_poses = 8;  // the most probable: enough, and little work
  const ObjectView& view = scene.views.front();
  if (!view.depth || !view.edges) return;
  std::vector<ObjectPose> poses;
  for (const Detection& detection : found)
    if (detection.probability >= least_probability && poses.size() < most_poses)
      poses.push_back(detection);
  const std::vector<DepthOffset> offsets = depth_offsets(scene.models, view, scene.backend, poses);
  std::string shown;
  for (const DepthOffset& offset : offsets)
    shown += fmt::format(" {:.2f}+-{:.2f}", 1e3 * offset.offset_m, 1e3 * offset.sigma_m);
  if (!offsets.empty())
    log(LogLevel::Debug,
        fmt::format("{}: poses with depth are farther than by edges alone, mm:{}", image, shown));
  offsets_.insert(offsets_.end(), offsets.begin(), offsets.end());
}

void DepthDoubts::add(const std::string& kind, const std::string& image, const std::string& what) {
  if (what.empty()) return;
  log(LogLevel::Debug, image + ": " + what);
  Doubt& doubt = doubts_[kind];
  if (doubt.images++ == 0) doubt.first = image + ": " + what;
}

void DepthDoubts::say() const {
  const std::string bias = doubt_of_bias(offsets_);
  if (!bias.empty()) log(LogLevel::Warning, bias);

  for (const auto& [kind, doubt] : doubts_)
    log(LogLevel::Warning, fmt::format("{}; {} so in {} of {} images with depth", doubt.first, kind,
                                       doubt.images, looked_at_));
}

}  // namespace edgescout
