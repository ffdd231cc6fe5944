// The options of the next view: names, bounds and help.
#include <cmath>

#include "host/active/next_view.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// In the order of Strategy.
constexpr const char* STRATEGIES[] = {"mi-max", "dis", "random", "fixed"};

}  // namespace

std::string to_string(Strategy strategy) { return STRATEGIES[int(strategy)]; }

Strategy strategy_from(const std::string& word) {
  for (const Strategy strategy :
       {Strategy::Information, Strategy::Disocclusion, Strategy::Random, Strategy::Fixed})
    if (word == to_string(strategy)) return strategy;
  throw InputError("options", "next_view.strategy", word, "mi-max, dis, random or fixed");
}

void describe_strategy(NextViewOptions& o, OptionVisitor& visit) {
  visit.group("Next view");
  visit.choice({"strategy",
                "How the next view is chosen. mi-max: most information; dis: most disoccluded "
                "points; random: any view; fixed: in the order of --sequence",
                OptionLevel::Basic},
               o.strategy, STRATEGIES);
  visit.number({"metre-cost",
                "Information subtracted from a view for each metre that the camera moves, nats"},
               o.motion_cost_per_m, 0.0, 1e6);
  visit.number({"radian-cost",
                "Information subtracted from a view for each radian that the camera turns, nats"},
               o.motion_cost_per_rad, 0.0, 1e6);
}

void describe(NextViewOptions& o, OptionVisitor& visit) {
  visit.group("Information");
  visit.number(
      {"map-reduction", "Image px that one px of the distance maps covers, along each axis"},
      o.reduction, 1.0, 16.0);
  visit.number({"chamfer-cap", "Largest distance in the distance maps, image px"}, o.cap_px, 0.1,
               255.0);
  visit.group("Belief");
  visit.number({"sigma",
                "Standard deviation of the mean edge distance of a right pose, image px; at least "
                "1/141 of --chamfer-cap"},
               o.sigma_px, 0.001, 1000.0);
}

void describe_ablations(NextViewOptions& o, OptionVisitor& visit) {
  visit.flag({"paper-formula", "Compute the expected information by the paper's own formula"},
             o.use_paper_formula);
  visit.number({"visibility-exponent",
                "Exponent by which unknown things hide more from lower cameras, without unit. 0: "
                "they hide nothing"},
               o.visibility_exponent, 0.0, 100.0);
  visit.number({"view-correlation-angle",
                "Angle within which two views give nearly the same information about a candidate, "
                "rad. 0: all views are independent"},
               o.view_correlation_angle_rad, 0.0, 100.0);
  visit.number({"exploration-bonus",
                "Information that a view is expected to give about objects without a candidate, "
                "nats. 0: none"},
               o.exploration_bonus_nats, 0.0, 1000.0);
  visit.number({"exploration-correlation-angle",
                "Angle within which two views give nearly the same information about objects "
                "without a candidate, rad. 0: all views are independent"},
               o.exploration_correlation_angle_rad, 0.0, 100.0);
  visit.number({"seen-distance",
                "A point of a part counts as seen if the image has an edge within this distance, "
                "px. 0: wherever it lies in the image, as in the paper"},
               o.seen_px, 0.0, double(EdgeIndex::MAX_RADIUS_PX));
}

void NextViewOptions::validate() const {
  NextViewOptions copy = *this;
  BoundsCheck in("next_view");
  describe_strategy(copy, in);
  describe(copy, in);
  describe_ablations(copy, in);
  in.require("chamfer-cap", cap_px, reduction / CHAMFER_STEPS_PER_PX,
             reduction * CHAMFER_CAP / CHAMFER_STEPS_PER_PX);
  in.require("sigma", sigma_px, cap_px / std::sqrt(2 * INFORMATION_MAX_SHARPNESS), 1e3);
  in.require("tolerance", tolerance, 0, 10);
  const double max_cost = is_in_nats(*this) ? 1e6 : 0;
  in.require("metre-cost", motion_cost_per_m, 0, max_cost);
  in.require("radian-cost", motion_cost_per_rad, 0, max_cost);
  visibility.validate();
}

bool is_in_nats(const NextViewOptions& options) {
  return options.strategy == Strategy::Information && !options.use_paper_formula;
}

}  // namespace edgescout
