#include "host/track/normal_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "host/core/lens.h"
#include "host/model/visible_edges.h"
#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

constexpr int line_margin = 2;  // samples that the derivative needs beyond the reach
constexpr int most_samples = 128;

// Positions in px of the searched image.
struct Line {
  Eigen::Vector2f middle, along, across;  // by one sample along the normal, along the edge
};

struct PosedEdge {
  double u_px, v_px, nx, ny;
};

std::optional<PosedEdge> posed_edge(const Pose& pose, const ModelPoint& model,
                                    const Intrinsics& k) {
  const PosedPoint<double> posed = pose_point<double>(pose, model);
  if (!can_be_seen(posed.point)) return std::nullopt;
  const ProjectedEdge<double> at = project_edge(posed, k);
  const double length = std::hypot(at.dx, at.dy);
  if (!(length > 0)) return std::nullopt;
  return PosedEdge{at.u, at.v, -at.dy / length, at.dx / length};
}

Line line_through(const SearchedImage& searched, const PosedEdge& edge) {
  const double step = searched.px_per_sample;
  Eigen::Vector2d middle(edge.u_px, edge.v_px), along(edge.nx * step, edge.ny * step);
  if (searched.camera.has_distortion()) {
    const auto seen = [&](const Eigen::Vector2d& ideal_px) {
      return pixel_seeing(searched.camera, ray_through(searched.ideal, ideal_px).head<2>());
    };
    const Eigen::Vector2d end = seen(middle + along);
    middle = seen(middle);
    along = end - middle;
  }
  const Eigen::Vector2f sample_along = (along / step).cast<float>();
  return {((middle.array() + 0.5) / step - 0.5).cast<float>(),
          sample_along,
          {-sample_along.y(), sample_along.x()}};
}

// Whether bilinear sampling stays inside the image.
bool is_inside(const Image& image, const Eigen::Vector2f& at) {
  return at.x() >= 0 && at.y() >= 0 && at.x() < float(image.width - 1) &&
         at.y() < float(image.height - 1);
}

bool is_inside(const Image& image, const Line& line, int reach) {
  const Eigen::Vector2f end = float(reach) * line.along;
  for (const Eigen::Vector2f& middle :
       {Eigen::Vector2f(line.middle - line.across), Eigen::Vector2f(line.middle + line.across)})
    if (!is_inside(image, middle - end) || !is_inside(image, middle + end)) return false;
  return true;
}

float sampled(const Image& image, const Eigen::Vector2f& at) {
  const int x = int(at.x()), y = int(at.y());
  const float fx = at.x() - float(x), fy = at.y() - float(y);
  const std::uint8_t* top = image.pixels.data() + std::size_t(y) * image.width + x;
  const std::uint8_t* bottom = top + image.width;
  const float above = top[0] + fx * (top[1] - top[0]),
              below = bottom[0] + fx * (bottom[1] - bottom[0]);
  return above + fy * (below - above);
}

// Mean over three places along the edge.
float grey_on(const Image& image, const Line& line, int sample) {
  const Eigen::Vector2f at = line.middle + float(sample) * line.along;
  return 0.25f * (sampled(image, at - line.across) + sampled(image, at + line.across)) +
         0.5f * sampled(image, at);
}

// The derivative of the grey values, smoothed by [1 2 1] / 4.
float derivative(const float* grey) { return (grey[2] - grey[-2] + 2 * (grey[1] - grey[-1])) / 8; }

class LineReader {
 public:
  LineReader(const Image& image, int reach) : image_(image), reach_(reach) {}

  // Appends the edges of the line in the order of their offsets.
  void add_edges(const Line& line, float min_contrast, float px_per_sample,
                 std::vector<LineEdge>& edges) {
    differentiate(line);
    for (int s = 1; s < 2 * reach_; ++s) {
      const float before = std::abs(slopes_[s - 1]), here = std::abs(slopes_[s]),
                  after = std::abs(slopes_[s + 1]);
      if (here < min_contrast || here <= before || here < after) continue;
      const float shift = 0.5f * (before - after) / (before - 2 * here + after);
      edges.push_back({(float(s - reach_) + shift) * px_per_sample, slopes_[s]});
    }
  }

 private:
  void differentiate(const Line& line) {
    const int first = -reach_ - line_margin;
    for (int i = 0; i <= 2 * (reach_ + line_margin); ++i)
      grey_[i] = grey_on(image_, line, first + i);
    for (int s = 0; s <= 2 * reach_; ++s) slopes_[s] = derivative(&grey_[s + line_margin]);
  }

  const Image& image_;
  int reach_;
  std::array<float, most_samples> grey_{}, slopes_{};
};

int reach_in_samples(const SearchedImage& image, double reach_px) {
  return std::clamp(int(std::ceil(reach_px / image.px_per_sample)), 1,
                    (most_samples - 1) / 2 - line_margin);
}

}  // namespace

SearchedImage searched(const Image& image, const Camera& camera, const MeasuredDepth* depth) {
  return {&image, camera, undistorted(camera), 1, depth};
}

NormalSearch search_normals(const SearchedImage& image, const Se3& camera_from_object,
                            std::span<const ModelPoint> points,
                            std::span<const float> expected_contrasts,
                            const NormalSearchOptions& options) {
  NormalSearch found;
  found.reach_px = options.reach_px;
  const int reach = reach_in_samples(image, options.reach_px);
  LineReader reader(*image.image, reach);
  const Pose pose = to_pose(camera_from_object);
  const Intrinsics k = intrinsics_of(image.ideal);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<PosedEdge> edge = posed_edge(pose, points[i], k);
    if (!edge) continue;
    const Line line = line_through(image, *edge);
    if (!is_inside(*image.image, line, reach + line_margin)) continue;
    const auto first = std::uint32_t(found.edges.size());
    reader.add_edges(line, options.min_contrast, float(image.px_per_sample), found.edges);
    found.points.push_back({points[i], edge->u_px, edge->v_px, edge->nx, edge->ny, first,
                            std::uint32_t(found.edges.size()),
                            expected_contrasts.empty() ? 0.0f : expected_contrasts[i]});
  }
  return found;
}

std::vector<float> contrasts_at(const SearchedImage& image, const Se3& camera_from_object,
                                std::span<const ModelPoint> points) {
  std::vector<float> contrasts(points.size(), 0.0f);
  const Pose pose = to_pose(camera_from_object);
  const Intrinsics k = intrinsics_of(image.ideal);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::optional<PosedEdge> edge = posed_edge(pose, points[i], k);
    if (!edge) continue;
    const Line line = line_through(image, *edge);
    if (!is_inside(*image.image, line, line_margin)) continue;
    std::array<float, 2 * line_margin + 1> grey;
    for (int s = -line_margin; s <= line_margin; ++s)
      grey[s + line_margin] = grey_on(*image.image, line, s);
    contrasts[i] = derivative(&grey[line_margin]);
  }
  return contrasts;
}

}  // namespace edgescout
