// Camera calibrations from ROS camera_info YAML, OpenCV YAML and BOP scene_camera.json /
// camera.json.
#pragma once

#include <filesystem>

#include "host/core/types.h"

namespace edgescout {

// ROS: image_width, image_height, camera_matrix, distortion_model (plumb_bob, rational_polynomial),
// distortion_coefficients. OpenCV: `%YAML:1.0` with camera_matrix / cameraMatrix / K,
// distortion_coefficients / dist_coeffs / D, image_width, image_height. BOP camera.json: fx fy cx
// cy width height; an entry of scene_camera.json, or all where they agree: cam_K, no size.
// InputError naming file and field: missing, not finite, negative focal length, unknown distortion
// model.
Camera load_camera(const std::filesystem::path& file);

// The camera for an image of the given size. The calibration's own size passes; a pure scale (same
// ratio within 0.5 %) passes only with `allow_scale`; everything else is an InputError naming both
// sizes. A calibration without a size (0 x 0) takes the image's.
Camera camera_for_image(const Camera& calibration, int width, int height, bool allow_scale,
                        const std::string& source);

}  // namespace edgescout
