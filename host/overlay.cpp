#include "host/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "host/captions.h"
#include "host/model/visible_edges.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr float match_px = 3, max_turn_rad = 0.35f;
const cv::Scalar matched(60, 230, 60), unmatched(255, 120, 20), unknown(60, 220, 255);
const cv::Scalar axis_colours[3] = {{255, 50, 50}, {50, 255, 50}, {80, 120, 255}};

struct PlacedWords {
  std::string words;
  Eigen::Vector2d at_px;
};

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

  // All at once, so that none covers another.
  void texts(std::vector<PlacedWords> texts) {
    std::erase_if(texts, [&](const PlacedWords& text) { return !is_near(text.at_px); });
    std::vector<Caption> captions;
    for (const PlacedWords& text : texts)
      captions.push_back({text.at_px, size_px(text.words) + Eigen::Vector2i::Constant(margin_px)});
    const std::vector<Eigen::Vector2i> corners =
        place_captions(captions, {canvas_.cols, canvas_.rows});
    for (std::size_t i = 0; i < texts.size(); ++i) text(texts[i], corners[i], captions[i].size_px);
  }

  RgbImage take() const {
    RgbImage image{canvas_.cols, canvas_.rows, {}};
    image.pixels.assign(canvas_.data, canvas_.data + canvas_.total() * 3);
    return image;
  }

 private:
  static constexpr int fraction_bits = 4;
  static constexpr int font = cv::FONT_HERSHEY_SIMPLEX, margin_px = 3;

  double font_scale() const { return std::clamp(canvas_.cols / 1600.0, 0.4, 1.5); }

  Eigen::Vector2i size_px(const std::string& words) const {
    int below_line = 0;
    const cv::Size size = cv::getTextSize(words, font, font_scale(), 1, &below_line);
    return {size.width, size.height + below_line};
  }

  // A line leads from the point to words that stand away from it.
  void text(const PlacedWords& text, const Eigen::Vector2i& corner,
            const Eigen::Vector2i& size_px) {
    const Eigen::Vector2d middle = corner.cast<double>() + 0.5 * size_px.cast<double>(),
                          reach = 0.5 * size_px.cast<double>() + Eigen::Vector2d(12, 12);
    if (((text.at_px - middle).cwiseAbs().array() > reach.array()).any())
      cv::line(canvas_, fixed_point(text.at_px), fixed_point(middle), {200, 200, 200}, 1,
               cv::LINE_AA, fraction_bits);
    int below_line = 0;
    const int height = cv::getTextSize(text.words, font, font_scale(), 1, &below_line).height;
    const cv::Point line_start(corner.x() + 1, corner.y() + height + 1);
    cv::putText(canvas_, text.words, line_start, font, font_scale(), {0, 0, 0}, 3, cv::LINE_AA);
    cv::putText(canvas_, text.words, line_start, font, font_scale(), {255, 255, 255}, 1,
                cv::LINE_AA);
  }

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

// A probability below 1 is not written as 1.
std::string caption_of(const OverlayPose& pose) {
  if (!pose.score) return pose.label;
  char score[32];
  std::snprintf(score, sizeof score, "%.2f", std::floor(100 * *pose.score + 1e-6) / 100);
  return pose.label.empty() ? score : pose.label + " " + score;
}

void draw_axes(Canvas& canvas, const OverlayPose& pose, const EdgeModel& model) {
  const Eigen::Vector3d center = pose.camera_from_object * model.center_m;
  for (int axis = 0; axis < 3; ++axis)
    canvas.line(center,
                pose.camera_from_object *
                    (model.center_m + 0.25 * model.mesh.diameter_m * Eigen::Vector3d::Unit(axis)),
                axis_colours[axis], 2);
}

}  // namespace

RgbImage draw_overlay(const Image& image, const Camera& camera, std::span<const OverlayPose> poses,
                      std::span<const EdgeModel> models, const EdgeIndex* edges, Backend& backend) {
  check(image.width == camera.width && image.height == camera.height,
        "draw_overlay: image and camera differ in size");
  Canvas canvas(image, camera);
  std::vector<PlacedWords> texts;
  for (const OverlayPose& pose : poses) {
    const EdgeModel& model = models[static_cast<std::size_t>(pose.object)];
    if ((pose.camera_from_object * model.center_m).z() <= 0) continue;
    draw_edges(canvas, camera, pose, model,
               visible_edges(model, {&pose.camera_from_object, 1}, backend)[0],
               pose.compare ? edges : nullptr);
    if (!pose.axes) continue;
    draw_axes(canvas, pose, model);
    texts.push_back({caption_of(pose), project(camera, pose.camera_from_object * model.center_m)});
  }
  canvas.texts(texts);
  return canvas.take();
}

}  // namespace edgescout
