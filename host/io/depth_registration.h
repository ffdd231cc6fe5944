// Brings a depth image into the frame of an undistorted grey image.
//
// Public header.
#pragma once

#include <optional>

#include "host/core/camera.h"
#include "host/core/depth_image.h"
#include "host/core/se3.h"

namespace edgescout {

class ThreadPool;

// A depth camera beside the grey one.
struct DepthCamera {
  Camera camera;        // may have a lens
  Se3 grey_from_depth;  // maps points of the depth camera's frame to the grey camera's
};

// Resamples a depth image that has the camera of the grey image, lens included, to the pixels of
// undistorted(camera), each the nearest one. InputError: depth and camera differ in size.
DepthImage undistort_depth(const DepthImage& depth, const Camera& camera);

// Reprojects the surface that another camera measured: what the grey camera sees of it, the nearest
// of several. The surface is that of triangles between neighbouring pixels, without those whose
// corners differ by more than 2 % of their depth: there an object ends. Places that the depth
// camera did not see are missing. InputError: depth and depth.camera differ in size.
DepthImage register_depth(const DepthImage& depth, const DepthCamera& from, const Camera& grey,
                          ThreadPool& pool);

// Returns the depth image in the grey camera: by register_depth, or by undistort_depth where the
// depth image has the camera of the grey one.
DepthImage in_grey_camera(const DepthImage& depth, const std::optional<DepthCamera>& from,
                          const Camera& grey, ThreadPool& pool);

}  // namespace edgescout
