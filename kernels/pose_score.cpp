#include "kernels/pose_score.h"

#include <cmath>

#include "kernels/error.h"
#include "kernels/pose_geometry.h"
#include "kernels/thread_pool.h"

namespace edgescout {

std::vector<std::int16_t> image_gradient_x2(const ImageView& image) {
  std::vector<std::int16_t> gradient(std::size_t(image.width) * image.height * 2, 0);
  for (int y = 1; y + 1 < image.height; ++y)
    for (int x = 1; x + 1 < image.width; ++x) {
      const std::uint8_t* p = image.pixels + std::size_t(y) * image.width + x;
      std::int16_t* g = gradient.data() + 2 * (std::size_t(y) * image.width + x);
      g[0] = static_cast<std::int16_t>(p[1] - p[-1]);
      g[1] = static_cast<std::int16_t>(p[image.width] - p[-image.width]);
    }
  return gradient;
}

namespace {

// |n . g| / |g| with n the unit normal of the projected edge (Eq. 10); 0 where the gradient is too
// weak to have a direction.
template <typename T>
T direction_agreement(const ScoreView& view, const ProjectedEdge<T>& edge, float min_gradient) {
  const TensorShape& s = view.tensor.shape;
  const int x = int(std::floor(edge.u + T(0.5))), y = int(std::floor(edge.v + T(0.5)));
  const std::int16_t* g = view.gradient_x2.data() + 2 * (std::size_t(y) * s.width + x);
  const T gx = g[0], gy = g[1], strength2 = gx * gx + gy * gy,
          length2 = edge.dx * edge.dx + edge.dy * edge.dy;
  const T floor2 = T(4) * min_gradient * min_gradient;
  if (strength2 < floor2 || strength2 == 0 || length2 == 0) return 0;
  return std::abs(edge.dx * gy - edge.dy * gx) / std::sqrt(strength2 * length2);
}

template <typename T>
PoseScore score_problem(const ScoreView& view, std::span<const ModelPoint> points, const Pose& pose,
                        const PoseScoreOptions& options) {
  T value_sum = 0, psi_sum = 0;
  int inside = 0, matched = 0;
  const TensorShape& s = view.tensor.shape;
  for (const ModelPoint& model : points) {
    const PosedPoint<T> posed = pose_point<T>(pose, model);
    if (!can_be_seen(posed.point)) continue;
    const ProjectedEdge<T> edge = project_edge(posed, view.tensor.intrinsics);
    if (!on_image(edge, s.width, s.height)) continue;
    const float value = tensor_lookup(view.tensor, float(edge.u), float(edge.v),
                                      float(orientation(edge.dx, edge.dy)), nullptr);
    ++inside;
    value_sum += value;
    matched += value < options.match_px;
    if (!view.gradient_x2.empty()) psi_sum += direction_agreement(view, edge, options.min_gradient);
  }
  if (inside == 0) return {options.cap_px, 0, 0, 0};
  return {float(value_sum / inside), float(psi_sum / inside), float(matched) / float(inside),
          float(inside)};
}

}  // namespace

void pose_score_reference(std::span<const ScoreView> views, std::span<const ModelPoint> points,
                          std::span<const PoseProblem> problems, const PoseScoreOptions& options,
                          std::span<PoseScore> out) {
  check(out.size() == problems.size(), "pose_score: as many scores as problems");
  for (std::size_t i = 0; i < problems.size(); ++i)
    out[i] = score_problem<double>(views[problems[i].view],
                                   points.subspan(problems[i].first_point, problems[i].point_count),
                                   problems[i].camera_from_object, options);
}

void pose_score_fast(std::span<const ScoreView> views, std::span<const ModelPoint> points,
                     std::span<const PoseProblem> problems, const PoseScoreOptions& options,
                     std::span<PoseScore> out, ThreadPool& pool) {
  check(out.size() == problems.size(), "pose_score: as many scores as problems");
  for_each_in_chunks(pool, problems.size(), 16, [&](std::size_t i) {
    out[i] = score_problem<float>(views[problems[i].view],
                                  points.subspan(problems[i].first_point, problems[i].point_count),
                                  problems[i].camera_from_object, options);
  });
}

}  // namespace edgescout
