#include "host/bridge/ros2/depth_matches.h"

#include <cmath>

#include "host/bridge/ros2/frames.h"

namespace edgescout::ros2 {

void DepthMatches::add(DepthMessage depth) {
  kept_.push_back(std::move(depth));
  if (kept_.size() > most_kept) kept_.pop_front();
}

DepthMessage DepthMatches::of(const msg::Header& image) const {
  DepthMessage nearest;
  double least_s = tolerance_s_;
  for (const DepthMessage& depth : kept_) {
    const double apart_s =
        1e-9 * std::abs(double(nanoseconds(depth->header.stamp) - nanoseconds(image.stamp)));
    if (apart_s > least_s) continue;
    least_s = apart_s;
    nearest = depth;
  }
  return nearest;
}

}  // namespace edgescout::ros2
