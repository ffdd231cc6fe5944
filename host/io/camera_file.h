// Reads camera calibrations: ROS camera_info YAML, OpenCV YAML, BOP camera.json and
// scene_camera.json.
//
// Public header.
#pragma once

#include <filesystem>

#include "host/core/types.h"

namespace edgescout {

// The fields that are read:
//   ROS     image_width, image_height, camera_matrix, distortion_model (plumb_bob or
//           rational_polynomial), distortion_coefficients
//   OpenCV  `%YAML:1.0` with camera_matrix / cameraMatrix / K, distortion_coefficients /
//           dist_coeffs / D, image_width, image_height
//   BOP     camera.json: fx fy cx cy width height; scene_camera.json: cam_K, without a size. All of
//           its entries must agree.
// InputError naming file and field: it is missing or not finite, the focal length is negative, the
// distortion model is unknown.
Camera load_camera(const std::filesystem::path& file);

// Returns the camera for an image of the given size. The calibration's own size is accepted. A pure
// scale of it (same ratio within 0.5 %) is accepted only with `allow_scale`. Any other size is an
// InputError naming both sizes. A calibration without a size (0 x 0) takes the size of the image.
Camera camera_for_image(const Camera& calibration, int width, int height, bool allow_scale,
                        const std::string& source);

}  // namespace edgescout
