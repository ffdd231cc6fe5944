#include "host/cli/explain_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "host/overlay.h"

namespace edgescout {

namespace {

// The corners of the object's box in the image; those behind the camera are left out.
std::vector<cv::Point2f> box_corners_px(const Mesh& mesh, const Se3& camera_from_object,
                                        const Camera& camera) {
  std::vector<cv::Point2f> corners;
  for (int i = 0; i < 8; ++i) {
    Eigen::Vector3d corner_m;
    for (int axis = 0; axis < 3; ++axis)
      corner_m[axis] = (i >> axis & 1 ? mesh.box_max_m : mesh.box_min_m)[axis];
    const Eigen::Vector3d in_camera = camera_from_object * corner_m;
    if (in_camera.z() <= 0) continue;
    const Eigen::Vector2d pixel = project(camera, in_camera);
    corners.emplace_back(float(pixel.x()), float(pixel.y()));
  }
  return corners;
}

// What the poses cover, with a margin of a third.
cv::Rect surroundings(const Scene& scene, std::span<const OverlayPose> poses) {
  const Camera& camera = scene.views[0].camera;
  const cv::Rect whole(0, 0, camera.width, camera.height);
  cv::Rect covered;
  for (const OverlayPose& pose : poses) {
    const std::vector<cv::Point2f> corners = box_corners_px(
        scene.models[std::size_t(pose.object)].mesh, pose.camera_from_object, camera);
    if (!corners.empty()) covered |= cv::boundingRect(corners) & whole;
  }
  const int margin = std::max(covered.width, covered.height) / 3 + 8;
  return cv::Rect(covered.x - margin, covered.y - margin, covered.width + 2 * margin,
                  covered.height + 2 * margin) &
         whole;
}

RgbImage enlarged_part(RgbImage& image, const cv::Rect& part) {
  constexpr int size_px = 640, most = 4;
  const int times = std::clamp(size_px / std::max(part.width, part.height), 1, most);
  cv::Mat result;
  cv::resize(cv::Mat(image.height, image.width, CV_8UC3, image.pixels.data())(part), result, {},
             times, times, cv::INTER_NEAREST);
  return {result.cols, result.rows, {result.data, result.data + result.total() * 3}};
}

}  // namespace

RgbImage explain_picture(const Scene& scene, const ObjectPose& given,
                         const std::optional<Rival>& rival) {
  const ObjectView& view = scene.views[0];
  OverlayPose drawn{given.object, given.world_from_object, {}, ""};
  drawn.axes = false;
  std::vector<OverlayPose> poses{drawn};
  if (rival) {
    drawn.object = rival->object;
    drawn.camera_from_object = rival->world_from_object;
    drawn.compare = false;
    poses.insert(poses.begin(), drawn);  // below the given pose
  }
  RgbImage whole =
      draw_overlay(*view.image, view.camera, poses, scene.models, view.edges.get(), scene.backend);
  return enlarged_part(whole, surroundings(scene, poses));
}

}  // namespace edgescout
