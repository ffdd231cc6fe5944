// Internal to host/io: what camera files and BOP scenes have in common.
#pragma once

#include "host/core/camera.h"
#include "host/io/json_fields.h"

namespace edgescout {

// A 3x3 matrix by row; InputError on another count, a skew above 1e-3 px, or a last row other than
// 0 0 1.
void set_intrinsics(Camera& camera, const std::vector<double>& k, const std::string& source,
                    const std::string& field);
// 0, 4, 5 or 8 coefficients in OpenCV's order; more only where they are zero.
void set_distortion(Camera& camera, const std::vector<double>& coefficients,
                    const std::string& source, const std::string& field);
// BOP's camera.json (fx fy cx cy width height) or an entry of scene_camera.json (cam_K); `dist`
// where given.
Camera camera_from_bop(const JsonField& entry);

}  // namespace edgescout
