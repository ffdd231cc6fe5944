#include "host/register/d2co_options.h"

#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr const char* SOLVERS[] = {"batched", "ceres"};  // in the order of Solver

}  // namespace

std::string to_string(Solver solver) { return SOLVERS[int(solver)]; }

Solver solver_from_name(const std::string& name) {
  for (const Solver solver : {Solver::Batched, Solver::Ceres})
    if (name == to_string(solver)) return solver;
  throw InputError("options", "register.solver", "\"" + name + "\"", "batched or ceres");
}

void describe_solver(D2coOptions& o, OptionVisitor& visit) {
  visit.choice({"solver",
                "Solver of the registration. batched: all poses side by side, on the device; "
                "ceres: one pose after the other by Ceres, on the host"},
               o.solver, SOLVERS);
}

void D2coOptions::validate() const {
  const BoundsCheck in("register");
  if (rounds.empty()) throw InputError("options", "register.rounds", "none", "at least one round");
  for (const D2coRound& round : rounds) {
    if (round.loss != LOSS_HUBER && round.loss != LOSS_GEMAN_MCCLURE)
      throw InputError("options", "register.loss", std::to_string(round.loss),
                       "Huber's or Geman and McClure's");
    in.require("scale", round.scale_px, 1e-3, 1000);
    in.require("iterations", round.iterations, 1, 1000);
    in.require("max_points", round.max_points, 0, 1e6);
    in.require("depth_sigmas", round.depth_sigmas, 1e-3, 1000);
    in.require("max_surface_points", round.max_surface_points, 0, 1e6);
  }
  in.require("min_step_m", min_step_m, 0, 1e9);
  in.require("min_step_rad", min_step_rad, 0, 1e9);
  visibility.validate();
}

}  // namespace edgescout
