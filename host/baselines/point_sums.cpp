#include "host/baselines/point_sums.h"

namespace edgescout {

void levenberg_marquardt(PoseTrack& track, const SystemAt& system_at, int iterations,
                         double min_step_m, double min_step_rad) {
  restart(track);
  begin_at(track, system_at(track.trial));
  for (int i = 0; i < iterations && track.active; ++i) {
    propose(track);
    judge(track, system_at(track.trial), min_step_m, min_step_rad);
  }
}

}  // namespace edgescout
