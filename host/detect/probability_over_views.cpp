#include "host/detect/probability_over_views.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "host/detect/probability.h"

namespace edgescout {

namespace {

double logistic(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

std::vector<PoseFeatures> speaking(std::span<const PoseFeatures> by_view) {
  constexpr double min_points = 12, min_in_image = 0.2;
  std::vector<PoseFeatures> views;
  for (const PoseFeatures& f : by_view)
    if (f.points >= min_points && f.in_image >= min_in_image) views.push_back(f);
  return views;
}

double log_odds_of_several(std::span<const PoseFeatures> views) {
  constexpr double bias = -9.184, of_a_view = 0.198, by_log_evidence = 2.463, by_log_over_beside = 2.745,
                   by_unexplained_grey = -3.324;
  constexpr double least = 2;  // standard errors: below that a view shows nothing of it, it may be hidden
  double sum = 0;
  for (const PoseFeatures& f : views)
    sum += of_a_view + by_log_evidence * std::log(std::max(evidence(f), least)) +
           by_log_over_beside * std::log(std::max(evidence_over_beside(f), least)) +
           by_unexplained_grey * unexplained_grey(f.shading);
  return bias + sum / std::sqrt(double(views.size()));
}

}  // namespace

double probability_over_views(std::span<const PoseFeatures> by_view) {
  const std::vector<PoseFeatures> views = speaking(by_view);
  if (views.empty()) return 0;
  return views.size() == 1 ? pose_probability(views[0]) : logistic(log_odds_of_several(views));
}

double merit(std::span<const PoseFeatures> by_view) {
  const std::vector<PoseFeatures> views = by_view.size() == 1 ? std::vector{by_view[0]} : speaking(by_view);
  if (views.empty()) return -std::numeric_limits<double>::infinity();
  return views.size() == 1 ? log_odds(views[0]) : log_odds_of_several(views);
}

}  // namespace edgescout
