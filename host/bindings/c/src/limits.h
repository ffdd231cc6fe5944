// Limits of long calls.
#pragma once

#include "host/bindings/c/edgescout.h"
#include "host/core/time_limit.h"

namespace edgescout::c {

// Begins now. EDGESCOUT_BAD_INPUT: a number of seconds that is none or negative.
TimeLimit limit_of(const edgescout_limit* limit);

}  // namespace edgescout::c
