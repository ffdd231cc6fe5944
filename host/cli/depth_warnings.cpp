#include "host/cli/depth_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/log.h"
#include "host/core/option_names.h"
#include "host/core/quantile.h"
#include "host/detect/depth_check.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

std::string question_of(DepthFault fault) {
  switch (fault) {
    case DepthFault::Unit:
      return "is the depth of another unit (" + option_name("depth-unit") + ")?";
    case DepthFault::Moved:
      return "is the pose of the depth camera wrong (" + option_name("depth-pose") + ")?";
    case DepthFault::OtherImage:
      return "is it the depth of another image?";
  }
  throw LogicError("question_of: unknown fault");
}

}  // namespace

// Several poses, since the edges of one hold its distance badly. Errors that all poses share, such
// as bright surfaces that look larger, do not average out: the offset must be as large as the
// poses' spread.
std::string bias_warning(std::span<const DepthOffset> offsets) {
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

void DepthWarnings::check_view(const std::string& image, const ObjectView& view,
                               const Range& distances_m) {
  if (!view.depth || !view.edges) return;
  ++checked_;
  for (const DepthWarning& warning : check_depth(view, distances_m))
    add(question_of(warning.fault), image, warning.found);
}

void DepthWarnings::compare(const std::string& image, const Scene& scene,
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

void DepthWarnings::add(const std::string& kind, const std::string& image,
                        const std::string& what) {
  log(LogLevel::Debug, image + ": " + what);
  Warning& warning = warnings_[kind];
  if (warning.images++ == 0) warning.first = image + ": " + what;
}

void DepthWarnings::log_warnings() const {
  const std::string bias = bias_warning(offsets_);
  if (!bias.empty()) log(LogLevel::Warning, bias);

  for (const auto& [kind, warning] : warnings_)
    log(LogLevel::Warning, fmt::format("{}; {} so in {} of {} images with depth", warning.first,
                                       kind, warning.images, checked_));
}

}  // namespace edgescout
