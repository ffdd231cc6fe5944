#include "host/detect/probability_over_views.h"

#include <algorithm>
#include <cmath>

#include "host/detect/plausible_pairs.h"
#include "host/detect/probability.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr double LEAST_TO_STAND = 0.01;  // what is less probable is as good as ruled out already

double logistic(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

bool speaks(const PoseFeatures& f) {
  constexpr double min_points = 12, min_in_image = 0.2;
  return f.points >= min_points && f.in_image >= min_in_image;
}

const PoseFeatures& the_one_that_speaks(std::span<const PoseFeatures> by_view) {
  return *std::ranges::find_if(by_view, speaks);
}

double log_odds_of(const SeveralViews& sums) {
  constexpr double bias = -9.184, of_a_view = 0.198, by_log_psi_z_score = 2.463,
                   by_log_background_psi_z_score = 2.745, by_unexplained_grey = -3.324;
  constexpr int most =
      5;  // views that it is fitted to: more are not more than these, each says less
  const double sum = of_a_view * sums.views + by_log_psi_z_score * sums.log_psi_z_score +
                     by_log_background_psi_z_score * sums.log_background_psi_z_score +
                     by_unexplained_grey * sums.unexplained_grey;
  return bias + sum / sums.views * std::sqrt(double(std::min(sums.views, most)));
}

}  // namespace

SeveralViews sum_of_speaking(std::span<const PoseFeatures> by_view) {
  constexpr double least =
      2;  // standard errors: below that a view shows nothing of it, it may be hidden
  SeveralViews sums;
  for (const PoseFeatures& f : by_view) {
    if (!speaks(f)) continue;
    ++sums.views;
    sums.log_psi_z_score += std::log(std::max(psi_z_score(f), least));
    sums.log_background_psi_z_score += std::log(std::max(background_psi_z_score(f), least));
    sums.unexplained_grey += unexplained_grey(f.shading);
  }
  return sums;
}

double probability_over_views(std::span<const PoseFeatures> by_view) {
  const SeveralViews sums = sum_of_speaking(by_view);
  if (sums.views == 0) return 0;
  return sums.views == 1 ? pose_probability(the_one_that_speaks(by_view))
                         : logistic(log_odds_of(sums));
}

double merit(std::span<const PoseFeatures> by_view) {
  if (by_view.size() == 1) return log_odds(by_view[0]);
  const SeveralViews sums = sum_of_speaking(by_view);
  if (sums.views > 1) return log_odds_of(sums);
  const double p = probability_over_views(by_view);
  return std::log(p / (1 - p));
}

std::vector<double> probabilities_without_collisions(
    std::span<const EdgeModel> models, std::span<const ObjectPose> poses,
    std::span<const std::vector<PoseFeatures>> by_view, double penetration_m, ThreadPool& pool) {
  check(by_view.size() == poses.size(),
        "probabilities_without_collisions: as many features as poses");
  std::vector<double> all, placed;
  std::vector<ObjectPose> placed_poses;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    all.push_back(probability_over_views(by_view[i]));
    if (all[i] < LEAST_TO_STAND || sum_of_speaking(by_view[i]).views < 2) continue;
    placed.push_back(all[i]);
    placed_poses.push_back(poses[i]);
    owner.push_back(i);
  }
  const std::vector<double> left =
      exclusive_probabilities(placed, plausible_pairs(models, placed_poses, penetration_m, pool));
  for (std::size_t i = 0; i < left.size(); ++i) all[owner[i]] = left[i];
  return all;
}

}  // namespace edgescout
