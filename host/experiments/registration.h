// Experiment 2: the rate of correct registrations by the start's distance for all methods, and
// their times (paper, Sec. 6, "Object Registration").
#pragma once

#include "host/experiments/experiment.h"

namespace edgescout {

Experiment registration_experiment();

}  // namespace edgescout
