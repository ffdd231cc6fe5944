// Experiment 3: one view against three (paper, Sec. 6, "Multi-view Object Registration", N_v = 2).
#pragma once

#include "host/experiments/experiment.h"

namespace edgescout {

Experiment multiview_experiment();

}  // namespace edgescout
