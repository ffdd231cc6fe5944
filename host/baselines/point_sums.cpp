#include "host/baselines/point_sums.h"

namespace edgescout {

void levenberg_marquardt(LmState& state, const SystemAt& system_at, int iterations,
                         double min_step_m, double min_step_rad) {
  restart(state);
  initialize(state, system_at(state.trial));
  for (int i = 0; i < iterations && state.active; ++i) {
    compute_step(state);
    accept_step(state, system_at(state.trial), min_step_m, min_step_rad);
  }
}

}  // namespace edgescout
