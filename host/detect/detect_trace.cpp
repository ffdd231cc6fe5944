#include "host/detect/detect_trace.h"

#include <algorithm>

#include "kernels/error.h"

namespace edgescout {

bool is_copy(const ObjectPose& a, const ObjectPose& b) {
  return a.object == b.object &&
         a.world_from_object.translation_m == b.world_from_object.translation_m &&
         a.world_from_object.rotation.coeffs() == b.world_from_object.rotation.coeffs();
}

std::vector<PoseEstimate> selected_estimates(const SelectionTrace& selection) {
  std::vector<PoseEstimate> selected;
  for (const Detection& detection : selection.selected) {
    const auto pose = std::ranges::find_if(
        selection.competing, [&](const PoseEstimate& p) { return is_copy(p, detection); });
    check(pose != selection.competing.end(), "selected_estimates: a pose that did not compete");
    selected.push_back(*pose);
  }
  return selected;
}

}  // namespace edgescout
