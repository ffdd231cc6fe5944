#include "kernels/pose_problems.h"

#include "kernels/error.h"

namespace edgescout {

void check_pose_problems(std::span<const PoseProblem> problems, std::size_t points,
                         std::size_t views) {
  for (const PoseProblem& problem : problems) {
    check(std::size_t(problem.first_point) + problem.point_count <= points,
          "poses: points beyond the list");
    check(problem.view < views, "poses: no such view");
  }
}

}  // namespace edgescout
