#include "host/edge/lsd_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>

#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr int smallest_level_px = 16;
constexpr float same_edge_px = 2.0f, same_edge_rad = 15.0f * std::numbers::pi_v<float> / 180;

float orientation_between(float a, float b) {
  const float d = std::abs(a - b);
  return std::min(d, std::numbers::pi_v<float> - d);
}

// Points in cells as wide as the search radius: all near points lie in the nine cells around.
class PointGrid {
 public:
  PointGrid(int width, int height)
      : columns_(static_cast<int>(std::ceil(width / same_edge_px)) + 1),
        cells_(std::size_t(columns_) * (static_cast<int>(std::ceil(height / same_edge_px)) + 1)) {}
  void add(const EdgePoint& point) { cells_[cell(point.x_px, point.y_px)].push_back(point); }
  bool has_similar(const EdgePoint& point) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const float x = point.x_px + same_edge_px * dx, y = point.y_px + same_edge_px * dy;
        const std::size_t at = cell(x, y);
        if (x < 0 || y < 0 || at >= cells_.size()) continue;
        for (const EdgePoint& other : cells_[at])
          if (std::hypot(other.x_px - point.x_px, other.y_px - point.y_px) <= same_edge_px &&
              orientation_between(other.theta_rad, point.theta_rad) <= same_edge_rad)
            return true;
      }
    return false;
  }

 private:
  std::size_t cell(float x, float y) const {
    return std::size_t(std::max(0.0f, y) / same_edge_px) * columns_ +
           std::size_t(std::max(0.0f, x) / same_edge_px);
  }
  int columns_;
  std::vector<std::vector<EdgePoint>> cells_;
};

// Segments of one image, with pixel centres at integers. LSD works on a copy shrunk to 4/5. Its way
// back ignores the half pixel between a pixel's corner and its centre: 0.5 / 0.8 - 0.5 px are
// missing.
std::vector<cv::Vec4f> detect_segments(const cv::Mat& image) {
  constexpr float shrink = 0.8f, missing_px = 0.5f / shrink - 0.5f;
  std::vector<cv::Vec4f> segments;
  cv::createLineSegmentDetector(cv::LSD_REFINE_STD, shrink)->detect(image, segments);
  for (cv::Vec4f& s : segments) s += cv::Vec4f::all(missing_px);
  return segments;
}

float gradient_at(const Image& image, float x, float y) {
  const int cx = std::clamp(static_cast<int>(std::lround(x)), 1, image.width - 2);
  const int cy = std::clamp(static_cast<int>(std::lround(y)), 1, image.height - 2);
  return 0.5f * std::hypot(float(image.at(cx + 1, cy) - image.at(cx - 1, cy)),
                           float(image.at(cx, cy + 1) - image.at(cx, cy - 1)));
}

// Samples a segment, in pixels of the image itself, in steps of 1 px.
void draw_segment(const cv::Vec4f& segment, const Image& image, std::vector<EdgePoint>& points) {
  const float dx = segment[2] - segment[0], dy = segment[3] - segment[1],
              length = std::hypot(dx, dy);
  const int steps = std::max(1, static_cast<int>(std::lround(length)));
  constexpr float pi = std::numbers::pi_v<float>;
  float theta = std::atan2(dy, dx);
  if (theta < 0) theta += pi;
  if (theta >= pi) theta = 0;
  for (int k = 0; k <= steps; ++k) {
    const float t = float(k) / float(steps), x = segment[0] + t * dx, y = segment[1] + t * dy;
    if (x < -0.5f || y < -0.5f || x >= image.width - 0.5f || y >= image.height - 0.5f) continue;
    points.push_back({x, y, theta, gradient_at(image, x, y)});
  }
}

}  // namespace

void LsdOptions::validate() const {
  if (levels < 1 || levels > 6)
    throw InputError("options", "edge.lsd.levels", std::to_string(levels), "a value in [1, 6]");
}

std::vector<EdgePoint> lsd_edges(const Image& image, const LsdOptions& options) {
  options.validate();
  check(image.width >= 3 && image.height >= 3, "lsd_edges: an image smaller than 3 x 3 px");
  cv::Mat level(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data()));
  std::vector<EdgePoint> found;
  PointGrid finer(image.width, image.height);
  float scale = 1;  // image px per level px; pyrDown does not move the pixel centres that it keeps
  for (int k = 0; k < options.levels; ++k, scale *= 2) {
    if (k > 0) {
      cv::Mat half;
      cv::pyrDown(level, half);
      level = half;
    }
    if (std::min(level.cols, level.rows) < smallest_level_px && k > 0) break;
    std::vector<EdgePoint> points;
    for (const cv::Vec4f& segment : detect_segments(level))
      draw_segment(segment * scale, image, points);
    if (k > 0) std::erase_if(points, [&](const EdgePoint& p) { return finer.has_similar(p); });
    for (const EdgePoint& p : points) finer.add(p);
    found.insert(found.end(), points.begin(), points.end());
  }
  return found;
}

}  // namespace edgescout
