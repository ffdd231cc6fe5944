#include "host/eval/detection_curve.h"

#include <algorithm>
#include <set>

#include "host/core/random.h"

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

namespace {

// The rate at the last point of the curve with at most so many false positives. Every pose counts
// as often as its image.
int found_in(const std::vector<ScoredPose>& sorted, const std::vector<int>& times,
             double most_false) {
  std::set<int> found;
  int found_times = 0, false_positives = 0, kept = 0;
  for (std::size_t i = 0; i < sorted.size(); kept = found_times) {
    for (const double score = sorted[i].score; i < sorted.size() && sorted[i].score == score; ++i) {
      if (sorted[i].instance < 0)
        false_positives += times[sorted[i].image];
      else if (found.insert(sorted[i].instance).second)
        found_times += times[sorted[i].image];
    }
    if (false_positives > most_false) break;
  }
  return kept;
}

}  // namespace

double rate_at(const std::vector<CurvePoint>& curve, double false_positives) {
  double rate = 0;
  for (const CurvePoint& point : curve)
    if (point.false_positives <= false_positives) rate = std::max(rate, point.rate);
  return rate;
}

Draws draw_images(std::size_t images, int draws, std::uint64_t seed) {
  Random random(seed);
  Draws result(draws, std::vector<int>(images, 0));
  for (std::vector<int>& times : result)
    for (std::size_t i = 0; i < images; ++i) ++times[random.below(static_cast<int>(images))];
  return result;
}

std::vector<double> resampled_rates(std::vector<ScoredPose> poses,
                                    const std::vector<int>& instances,
                                    double false_positives_per_image, const Draws& draws) {
  std::ranges::sort(poses, std::ranges::greater{}, &ScoredPose::score);
  std::vector<double> rates;
  for (const std::vector<int>& times : draws) {
    int all = 0, images = 0;
    for (std::size_t i = 0; i < instances.size(); ++i)
      all += times[i] * instances[i], images += times[i];
    if (all > 0)
      rates.push_back(
          static_cast<double>(found_in(poses, times, false_positives_per_image * images)) / all);
  }
  return rates;
}

}  // namespace edgescout
