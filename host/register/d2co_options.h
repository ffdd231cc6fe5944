// How D2CO goes from a rough pose to a registered one (d2co.h).
//
// Public header.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/core/options.h"
#include "host/model/visible_edges.h"
#include "kernels/pose_normal_equations.h"

namespace edgescout {

// One stage of the schedule: the loss and how long it is kept.
struct D2coRound {
  std::uint32_t loss = LOSS_HUBER;
  float scale_px = 4;
  int iterations = 10;           // of Levenberg-Marquardt
  int max_points = 0;            // per view, evenly thinned; 0: all
  double depth_sigmas = 3;       // scale of the loss against measured depth, standard deviations
  int max_surface_points = 150;  // compared with measured depth, per view
};

// Which implementation minimises the cost. Both end in the same minima.
enum class Solver {
  Batched,  // all poses side by side, systems by a kernel on the backend's device
  Ceres,    // one pose after the other by Ceres on the host: the reference
};
std::string to_string(Solver solver);              // "batched", "ceres"
Solver solver_from_name(const std::string& name);  // InputError on another word

struct D2coOptions {
  // From a wide loss to a narrow one; visible points are recomputed before every round.
  std::vector<D2coRound> rounds = default_rounds();
  double min_step_m = 2e-6;  // a smaller step ends the round
  double min_step_rad = 2e-5;
  VisibilityOptions visibility;
  Solver solver = Solver::Batched;
  static std::vector<D2coRound> default_rounds();  // in schedules.cpp
  void validate() const;  // InputError naming the field and the violated bound
};

// Names the solver to `visit`: of the options of a registration it alone is the user's.
void describe_solver(D2coOptions& options, OptionVisitor& visit);

}  // namespace edgescout
