// A depth map of what is known in one view, objects and measured surfaces: everything behind it is
// hidden.
//
// visible_edges removes what an object hides of itself. In a pile its neighbours hide more, and
// hidden edges count as missing: a right pose of a half covered part scores low. Where the
// neighbours are known, the covered points are left out of registration and score.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "host/model/visible_edges.h"
#include "host/register/scene.h"

namespace edgescout {

struct Occluders {
  Camera camera;               // of the reduced map
  std::vector<float> depth_m;  // nearest known surface, row by row; DEPTH_EMPTY where there is none

  // Whether the point is certainly hidden: all 3 x 3 pixels around its projection lie nearer by
  // more than `tolerance_m`. On an occluder's contour and outside the image no point is.
  bool hide(const Eigen::Vector3d& in_camera, double tolerance_m) const;
};

// Removes the points of an object that the occluders hide, and their marks where given.
void remove_hidden(std::vector<ModelPoint>& points, const Occluders& occluders,
                   const Se3& camera_from_object, double tolerance_m,
                   SilhouetteMarks* marks = nullptr);

// Removes those that a measured surface hides, without a map of the whole image: for few points.
// `camera` is that of the depth image.
void remove_hidden(std::vector<ModelPoint>& points, const MeasuredDepth& depth,
                   const Camera& camera, const Se3& camera_from_object, double tolerance_m);

// Of the known objects and of the view's depth image: a measured surface is nearer by three of its
// standard deviations than what it hides. Null where there is neither. Ignores the view's own
// occluders.
std::shared_ptr<const Occluders> make_occluders(std::span<const EdgeModel> models,
                                                std::span<const ObjectPose> known,
                                                const ObjectView& view, Backend& backend);

// Points less than this behind a known surface are not hidden. Without a tolerance a known object
// would hide itself where its pose is a little off.
double occlusion_tolerance_m(const EdgeModel& model);

}  // namespace edgescout
