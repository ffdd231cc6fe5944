// The points of an object that an image shows.
//
// Registration compares no others. A point outside costs what the nearest pixel inside costs plus
// its distance from there (pose_normal_equations.h), which holds poses in the image: the outer
// points of a part that the border cuts would pull the part inwards, and away from the camera.
#pragma once

#include <span>
#include <vector>

#include "host/core/camera.h"
#include "host/core/se3.h"
#include "host/model/edge_model.h"

namespace edgescout {

// Whether the sphere around the object projects into the image as a whole.
bool is_wholly_in(const Camera& camera, const EdgeModel& model, const Se3& camera_from_object);

// How many points of the model project outside of the image or do not lie in front of the camera.
std::size_t count_outside(std::span<const ModelPoint> points, const EdgeModel& model,
                          const Camera& camera, const Se3& camera_from_object);

// Removes these points. Where they are more than half, all stay: such a pose is hardly right, and
// the image holds it.
void remove_outside(std::vector<ModelPoint>& points, const EdgeModel& model, const Camera& camera,
                    const Se3& camera_from_object);

}  // namespace edgescout
