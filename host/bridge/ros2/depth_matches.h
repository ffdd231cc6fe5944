// Keeps the latest depth images and answers which belongs to an image, by their stamps.
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "host/bridge/ros2/messages.h"

namespace edgescout::ros2 {

struct DepthWait {
  double seconds = 0.2;       // how long an image waits for its depth image after it came
  double tolerance_s = 0.01;  // of their stamps
};

using DepthMessage = std::shared_ptr<const msg::Image>;

class DepthMatches {
 public:
  static constexpr std::size_t most_kept = 8;

  explicit DepthMatches(double tolerance_s) : tolerance_s_(tolerance_s) {}

  // Between the stamps; nothing where they are farther apart than the tolerance.
  std::optional<double> apart_s(const msg::Image& depth, const msg::Header& image) const;
  // In any order of stamps; the earliest to come goes.
  void add(DepthMessage depth);
  // The nearest in time, within the tolerance; of several the last to come. Null: none.
  DepthMessage of(const msg::Header& image) const;

 private:
  double tolerance_s_;
  std::deque<DepthMessage> kept_;  // the latest to come last
};

}  // namespace edgescout::ros2
