#include "host/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "host/model/visible_edges.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr float match_px = 3, max_turn_rad = 0.35f;
const cv::Scalar matched(60, 230, 60), unmatched(255, 120, 20), unknown(60, 220, 255);
const cv::Scalar axis_colours[3] = {{255, 50, 50}, {50, 255, 50}, {80, 120, 255}};

class Canvas {
 public:
  Canvas(const Image& image, const Camera& camera)
      : camera_(camera), canvas_(image.height, image.width, CV_8UC3) {
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const auto grey = static_cast<std::uint8_t>(image.at(x, y) / 2 + 32);
        canvas_.at<cv::Vec3b>(y, x) = {grey, grey, grey};
      }
  }

  // Draws nothing if an end is behind the camera.
  void line(const Eigen::Vector3d& from_in_camera, const Eigen::Vector3d& to_in_camera,
            const cv::Scalar& colour, int thickness) {
    if (from_in_camera.z() <= 0 || to_in_camera.z() <= 0) return;
    const Eigen::Vector2d a = project(camera_, from_in_camera), b = project(camera_, to_in_camera);
    if (!is_near(a) || !is_near(b)) return;
    cv::line(canvas_, fixed_point(a), fixed_point(b), colour, thickness, cv::LINE_AA,
             fraction_bits);
  }

  void text(const std::string& words, const Eigen::Vector2d& at) {
    if (!is_near(at)) return;
    const cv::Point corner(static_cast<int>(std::lround(at.x())) + 6,
                           static_cast<int>(std::lround(at.y())) - 6);
    const double size = std::clamp(canvas_.cols / 1600.0, 0.4, 1.5);
    cv::putText(canvas_, words, corner, cv::FONT_HERSHEY_SIMPLEX, size, {0, 0, 0}, 3, cv::LINE_AA);
    cv::putText(canvas_, words, corner, cv::FONT_HERSHEY_SIMPLEX, size, {255, 255, 255}, 1,
                cv::LINE_AA);
  }

  RgbImage take() const {
    RgbImage image{canvas_.cols, canvas_.rows, {}};
    image.pixels.assign(canvas_.data, canvas_.data + canvas_.total() * 3);
    return image;
  }

 private:
  static constexpr int fraction_bits = 4;
  // Coordinates far outside the image would overflow OpenCV's fixed point.
  bool is_near(const Eigen::Vector2d& p) const {
    return p.cwiseAbs().maxCoeff() < 4.0 * std::max(canvas_.cols, canvas_.rows);
  }
  static cv::Point fixed_point(const Eigen::Vector2d& p) {
    return {static_cast<int>(std::lround(p.x() * (1 << fraction_bits))),
            static_cast<int>(std::lround(p.y() * (1 << fraction_bits)))};
  }
  const Camera& camera_;
  cv::Mat canvas_;
};

bool explains_edge(const EdgeIndex& edges, const Camera& camera,
                   const Eigen::Vector3d& from_in_camera, const Eigen::Vector3d& to_in_camera) {
  const Eigen::Vector2d a = project(camera, from_in_camera), b = project(camera, to_in_camera),
                        middle = 0.5 * (a + b);
  if (middle.x() < 0 || middle.y() < 0 || middle.x() > camera.width - 1 ||
      middle.y() > camera.height - 1)
    return false;
  const Eigen::Vector2d along = b - a;
  return edges.nearest(middle.cast<float>(), along.cast<float>(), {match_px, max_turn_rad}) !=
         nullptr;
}

// Each raster point represents a piece of edge that is one raster step long.
void draw_edges(Canvas& canvas, const Camera& camera, const OverlayPose& pose,
                const EdgeModel& model, std::span<const ModelPoint> points,
                const EdgeIndex* edges) {
  for (const ModelPoint& point : points) {
    const Eigen::Vector3d x(point.x_m, point.y_m, point.z_m),
        half = 0.5 * model.raster_step_m * Eigen::Vector3d(point.tx, point.ty, point.tz);
    const Eigen::Vector3d from = pose.camera_from_object * (x - half),
                          to = pose.camera_from_object * (x + half);
    if (from.z() <= 0 || to.z() <= 0) continue;
    const cv::Scalar& colour = !edges                                    ? unknown
                               : explains_edge(*edges, camera, from, to) ? matched
                                                                         : unmatched;
    canvas.line(from, to, colour, 1);
  }
}

std::string caption_of(const OverlayPose& pose) {
  if (!pose.score) return pose.label;
  char score[32];
  std::snprintf(score, sizeof score, "%.2f", *pose.score);
  return pose.label.empty() ? score : pose.label + " " + score;
}

void draw_axes(Canvas& canvas, const Camera& camera, const OverlayPose& pose,
               const EdgeModel& model) {
  const Eigen::Vector3d center = pose.camera_from_object * model.center_m;
  for (int axis = 0; axis < 3; ++axis)
    canvas.line(center,
                pose.camera_from_object *
                    (model.center_m + 0.25 * model.mesh.diameter_m * Eigen::Vector3d::Unit(axis)),
                axis_colours[axis], 2);
  canvas.text(caption_of(pose), project(camera, center));
}

}  // namespace

RgbImage draw_overlay(const Image& image, const Camera& camera, std::span<const OverlayPose> poses,
                      std::span<const EdgeModel> models, const EdgeIndex* edges, Backend& backend) {
  check(image.width == camera.width && image.height == camera.height,
        "draw_overlay: image and camera differ in size");
  Canvas canvas(image, camera);
  for (const OverlayPose& pose : poses) {
    const EdgeModel& model = models[static_cast<std::size_t>(pose.object)];
    if ((pose.camera_from_object * model.center_m).z() <= 0) continue;
    draw_edges(canvas, camera, pose, model,
               visible_edges(model, {&pose.camera_from_object, 1}, backend)[0],
               pose.compare ? edges : nullptr);
    if (pose.axes) draw_axes(canvas, camera, pose, model);
  }
  return canvas.take();
}

}  // namespace edgescout
