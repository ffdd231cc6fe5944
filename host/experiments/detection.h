// Experiment 1: true and false positives of FDCM and LINE-2D on the same pose candidates (paper,
// Sec. 6, "Object Detection").
#pragma once

#include "host/experiments/experiment.h"

namespace edgescout {

Experiment detection_experiment();

}  // namespace edgescout
