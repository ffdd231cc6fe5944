#include "host/register/object_view.h"

namespace edgescout {

std::vector<ObjectView> on_coarse_tensors(std::span<const ObjectView> views) {
  std::vector<ObjectView> coarse(views.begin(), views.end());
  for (ObjectView& view : coarse)
    if (view.coarse) view.tensor = view.coarse;
  return coarse;
}

}  // namespace edgescout
