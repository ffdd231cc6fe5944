#include "host/io/pixel_map.h"

#include <opencv2/calib3d.hpp>

#include "host/core/lens.h"

namespace edgescout {

namespace {

cv::Matx33d matrix_of(const Camera& camera) {
  return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

PixelMap map_by_opencv(const Camera& camera) {
  PixelMap map;
  const int count = static_cast<int>(camera.distortion.size());
  const cv::Mat distortion(1, count, CV_64F, const_cast<double*>(camera.distortion.data()));
  cv::initUndistortRectifyMap(matrix_of(camera), distortion, cv::noArray(),
                              matrix_of(undistorted(camera)), {camera.width, camera.height},
                              CV_32FC1, map.x, map.y);
  return map;
}

// OpenCV has neither all of the models nor a skew.
PixelMap map_by_lens(const Camera& camera) {
  const Camera ideal = undistorted(camera);
  PixelMap map{cv::Mat(camera.height, camera.width, CV_32FC1),
               cv::Mat(camera.height, camera.width, CV_32FC1)};
  cv::parallel_for_({0, camera.height}, [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row)
      for (int column = 0; column < camera.width; ++column) {
        const Eigen::Vector3d ray = ray_through(ideal, {column, row});
        const Eigen::Vector2d seen = pixel_seeing(camera, ray.head<2>());
        map.x.at<float>(row, column) = static_cast<float>(seen.x());
        map.y.at<float>(row, column) = static_cast<float>(seen.y());
      }
  });
  return map;
}

}  // namespace

PixelMap map_to_original(const Camera& camera) {
  return camera.lens == LensModel::BrownConrady && camera.skew == 0 ? map_by_opencv(camera)
                                                                    : map_by_lens(camera);
}

}  // namespace edgescout
