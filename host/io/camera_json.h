// Internal to host/io: the code that camera files and BOP scenes share.
#pragma once

#include "host/core/camera.h"
#include "host/io/json_fields.h"

namespace edgescout {

// `k` is a 3x3 matrix by row. InputError: another count, a skew above 1e-3 px, a last row other
// than 0 0 1.
void set_intrinsics(Camera& camera, const std::vector<double>& k, const std::string& source,
                    const std::string& field);
// 0, 4, 5 or 8 coefficients in OpenCV's order. More are accepted if they are zero.
void set_distortion(Camera& camera, const std::vector<double>& coefficients,
                    const std::string& source, const std::string& field);
// Reads BOP's camera.json (fx fy cx cy width height) or an entry of scene_camera.json (cam_K), and
// `dist` if given.
Camera camera_from_bop(const JsonField& entry);

}  // namespace edgescout
