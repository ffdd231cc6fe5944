// All schedules of registration in one table: from a wide loss to a narrow one, with as many points
// and iterations as the stage needs. docs/research/ has the experiments behind them.
#pragma once

#include "host/register/d2co_options.h"
#include "host/register/edge_icp_options.h"

namespace edgescout::schedules {

// Detection (detect/detect.h): coarse -> medium -> fine.
D2coOptions coarse();    // coarse tensors, from templates some 0.2 rad apart
D2coOptions medium();    // full tensors: features mean nothing 3 px off
D2coOptions search();    // coarse tensors, from starts turned by up to 0.3 rad; precedes `fine`
D2coOptions fine();      // full tensors, all points in the last round
D2coRound unsearched();  // precedes `fine` where no search brought the start near

// Active detection.
D2coOptions particles();  // active/particles.h, on all real views
EdgeIcpOptions particles_edge_icp();
D2coOptions extrinsics();  // active/extrinsics_check.h, on all views and on one

}  // namespace edgescout::schedules
