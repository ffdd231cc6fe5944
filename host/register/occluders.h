// What objects in known places hide of everything behind them in one view.
//
// visible_edges knows only what an object hides of itself. In a pile its neighbours hide more, and
// edges that cannot be seen count as missing: a right pose whose half is covered looks wrong. Where
// the neighbours are known, the covered points are left out of registration and score instead.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "host/register/d2co.h"

namespace edgescout {

struct Occluders {
  Camera camera;               // of the reduced map
  std::vector<float> depth_m;  // nearest known surface, row by row; DEPTH_EMPTY where there is none

  // Whether each of the 3 x 3 pixels around its projection lies nearer by more than `tolerance_m`:
  // certainly hidden, what is on an occluder's contour is not. Outside the image nothing is.
  bool hide(const Eigen::Vector3d& in_camera, double tolerance_m) const;
  // Whether one of them does: grey this close to an occluder may be the occluder's.
  bool may_hide(const Eigen::Vector3d& in_camera, double tolerance_m) const;
};

// Leaves the points of an object that the occluders do not hide.
void remove_hidden(std::vector<ModelPoint>& points, const Occluders& occluders,
                   const Se3& camera_from_object, double tolerance_m);

// Nothing where `known` is empty. The view's own occluders play no part.
std::shared_ptr<const Occluders> make_occluders(std::span<const EdgeModel> models,
                                                std::span<const ObjectPose> known,
                                                const RegisterView& view, Backend& backend);

// Known objects would hide themselves where a pose is a little off: what lies less than this behind
// their surface is not hidden.
double occlusion_tolerance_m(const EdgeModel& model);

}  // namespace edgescout
