// Boxes on a table that a camera goes around: candidates, particles near them and combinations of
// candidates, as the choice of the next view sees them.
#pragma once

#include "kernels/cases/chamfer_cases.h"
#include "kernels/mutual_information.h"

namespace edgescout::bench {

struct NextViewSize {
  int views, candidates, particles, points, width, height;
  std::uint32_t combinations;
};
inline constexpr NextViewSize paper_size{32, 40, 200, 500, 256, 192, 1000};

class NextViewInput {
 public:
  explicit NextViewInput(const NextViewSize& size);
  // What view 0 to views - 1 shows; its maps (`nearest`) have their size, but are not drawn.
  test::ChamferInput view(int index) const;
  const std::vector<ParticleBelief>& beliefs() const { return beliefs_; }

 private:
  NextViewSize size_;
  std::vector<test::Box> candidates_, particles_;  // in the world, z up
  std::vector<std::uint32_t> combinations_;
  std::vector<ParticleBelief> beliefs_;
};

}  // namespace edgescout::bench
