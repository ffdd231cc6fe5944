#include "host/bridge/ros2/depth_matches.h"

#include <cmath>

#include "host/bridge/ros2/frames.h"

namespace edgescout::ros2 {

void DepthMatches::add(DepthMessage depth) {
  kept_.push_back(std::move(depth));
  if (kept_.size() > most_kept) kept_.pop_front();
}

std::optional<double> DepthMatches::apart_s(const msg::Image& depth,
                                            const msg::Header& image) const {
  const double seconds =
      1e-9 * std::abs(double(nanoseconds(depth.header.stamp) - nanoseconds(image.stamp)));
  return seconds <= tolerance_s_ ? std::optional(seconds) : std::nullopt;
}

DepthMessage DepthMatches::of(const msg::Header& image) const {
  DepthMessage nearest;
  for (const DepthMessage& depth : kept_) {
    const std::optional<double> apart = apart_s(*depth, image);
    if (apart && (!nearest || *apart <= *apart_s(*nearest, image))) nearest = depth;
  }
  return nearest;
}

}  // namespace edgescout::ros2
