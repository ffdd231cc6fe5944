#include "host/eval/detection_curve.h"

#include <algorithm>
#include <set>

namespace edgescout {

std::vector<CurvePoint> detection_curve(std::vector<ScoredPose> poses, int instances) {
  std::ranges::sort(poses, std::ranges::greater{}, &ScoredPose::score);
  std::vector<CurvePoint> curve{{}};
  std::set<int> found;
  for (std::size_t i = 0; i < poses.size();) {
    CurvePoint point = curve.back();
    for (const double score = poses[i].score; i < poses.size() && poses[i].score == score; ++i) {
      if (poses[i].instance < 0)
        ++point.false_positives;
      else
        found.insert(poses[i].instance);
    }
    point.found = static_cast<int>(found.size());
    point.rate = instances > 0 ? static_cast<double>(point.found) / instances : 0;
    curve.push_back(point);
  }
  return curve;
}

double rate_at(const std::vector<CurvePoint>& curve, double false_positives) {
  double rate = 0;
  for (const CurvePoint& point : curve)
    if (point.false_positives <= false_positives) rate = std::max(rate, point.rate);
  return rate;
}

}  // namespace edgescout
