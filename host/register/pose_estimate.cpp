#include "host/register/pose_estimate.h"

#include "kernels/error.h"

namespace edgescout {

std::string to_string(Convergence convergence) {
  switch (convergence) {
    case Convergence::Converged:
      return "converged";
    case Convergence::NoDecrease:
      return "no decrease";
    case Convergence::IterationLimit:
      return "iteration limit";
    case Convergence::TooFewEdges:
      return "too few edges";
    case Convergence::NoPoints:
      return "no visible points";
    case Convergence::OutOfTime:
      return "out of time";
  }
  throw LogicError("unknown convergence");
}

}  // namespace edgescout
