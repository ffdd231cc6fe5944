// What every path asks of a list of pose problems before it reads what they name.
#pragma once

#include <cstddef>
#include <span>

#include "kernels/pose_normal_equations.h"

namespace edgescout {

// LogicError: a problem with points beyond the list of `points`, or of none of the `views`.
void check_pose_problems(std::span<const PoseProblem> problems, std::size_t points,
                         std::size_t views);

}  // namespace edgescout
