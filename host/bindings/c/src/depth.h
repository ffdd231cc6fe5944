// Depth images of the caller, and the cameras that took them.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "host/bindings/c/edgescout.h"
#include "host/io/depth_registration.h"
#include "host/register/measured_depth.h"

namespace edgescout::c {

// The fields of a struct; all may be NULL.
struct GivenDepth {
  const edgescout_image* depth;
  const edgescout_camera* depth_camera;
  const double* camera_from_depth;
};

struct TakenDepth {
  MeasuredDepth stored;
  std::optional<DepthCamera> from;  // none: the camera of the image
};

// Nothing where there is none. `name` is that of the struct. EDGESCOUT_BAD_INPUT: a camera or pose
// without what it belongs to; what depth_of (images.h) refuses.
std::optional<TakenDepth> take_depth(const GivenDepth& given, const std::string& name);

// Of the camera of the image, lens included. Null where nothing was taken. EDGESCOUT_BAD_INPUT: a
// size other than the camera's.
std::shared_ptr<const MeasuredDepth> in_camera(const std::optional<TakenDepth>& taken,
                                               const Camera& camera, ThreadPool& pool);

}  // namespace edgescout::c
