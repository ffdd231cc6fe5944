// Checks whether a depth image can be that of its grey image: its unit and its alignment.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/core/options.h"
#include "host/model/template_set.h"
#include "host/register/object_view.h"

namespace edgescout {

enum class DepthFault {
  Unit,        // values are ten, a hundred or a thousand times off
  Moved,       // jumps of depth lie beside the edges: the pose of the depth camera
  OtherImage,  // jumps of depth lie on no edges
};

struct DepthWarning {
  DepthFault fault;
  std::string found;  // the numbers that speak for it
};

// Of a view with edges; none without depth. `distances_m`: where surfaces of the objects may be,
// along the camera's axis.
std::vector<DepthWarning> check_depth(const ObjectView& view, const Range& distances_m);

// Where the surfaces of these objects may be, along the axis of a camera.
Range surface_distances_m(std::span<const TemplateSet> sets);

}  // namespace edgescout
