// One surface point on one depth image, written from the prose of pose_depth.h alone, in long
// double: brute force where the kernels calculate. Of the kernels' code it takes the published
// constants.
#pragma once

#include <optional>

#include "tests/kernels/pose_oracle.h"

namespace edgescout::test {

inline Real dot(const Real3& a, const Real3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline CameraPoint in_camera(const Pose& pose, const SurfacePoint& s) {  // its tangent: the normal
  return in_camera(pose, ModelPoint{s.x_m, s.y_m, s.z_m, s.nx, s.ny, s.nz});
}

enum class DepthVerdict { uncounted, missing, hidden, contradicting, agreeing };

struct DepthLook {
  DepthVerdict verdict = DepthVerdict::uncounted;
  bool sure = true;  // float cannot come to another verdict, nor look at another pixel
  Real3 measured{};  // the point q
  Real offset = 0, scale = 1;
};

inline Real cosine(const CameraPoint& p) { return dot(p.tangent, unit(p.position)); }

// The pixel whose square, closed on the left and above, holds the point.
inline std::optional<std::array<int, 2>> pixel_under(const DepthView& view, const ImagePoint& at) {
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      if (x - 0.5L <= at.x && at.x < x + 0.5L && y - 0.5L <= at.y && at.y < y + 0.5L)
        return std::array{x, y};
  return std::nullopt;
}

inline bool on_a_border(Real px) { return to_integer(px - 0.5L) < 1e-3L; }

// The verdict on a point whose pixel measured `depth`.
inline void judge(DepthLook& look, const CameraPoint& p, Real depth, Real along_ray,
                  const PoseDepthOptions& options) {
  const Real sigma = std::max<Real>(options.noise_floor_m, options.noise_per_m * depth * depth);
  const Real band = std::max<Real>(options.band_m, BAND_SIGMAS * sigma);
  look.offset =
      dot(p.tangent, plus(look.measured, times(-1, p.position))) / along_ray;  // along the ray
  look.scale = std::hypot(sigma * along_ray, Real(options.surface_m));
  look.verdict = look.offset > band    ? DepthVerdict::contradicting
                 : look.offset < -band ? DepthVerdict::hidden
                                       : DepthVerdict::agreeing;
  const Real room = std::abs(std::abs(look.offset) - band);
  look.sure &= room > 1e-3L * band && room > 2e-6L * p.position[2];
}

inline DepthLook look_at(const DepthView& view, const CameraPoint& p,
                         const PoseDepthOptions& options) {
  DepthLook look;
  look.sure = std::abs(p.position[2] - POSE_MIN_DEPTH_M) > 1e-5L;
  if (!in_front(p)) return look;
  look.sure &= std::abs(cosine(p) + MIN_FACING) > 1e-4L;
  if (cosine(p) > -MIN_FACING) return look;
  const ImagePoint at = project(view.intrinsics, p);
  look.sure &= !on_a_border(at.x) && !on_a_border(at.y);
  look.verdict = DepthVerdict::missing;
  const auto pixel = pixel_under(view, at);
  if (!pixel) return look;
  const auto [x, y] = *pixel;
  const Real depth = view.z_m[static_cast<std::size_t>(y) * view.width + x];
  if (depth <= 0 || depth >= POSE_MAX_RANGE_M) return look;
  const Intrinsics& k = view.intrinsics;
  const Real3 ray{(x - Real(k.cx)) / k.fx, (y - Real(k.cy)) / k.fy, 1};
  const Real along_ray = dot(p.tangent, ray);
  look.sure &= std::abs(along_ray) > 1e-4L;
  if (along_ray >= 0) return look;
  look.measured = times(depth, ray);
  judge(look, p, depth, along_ray, options);
  return look;
}

// Depth images of several sizes and cameras, one of them one pixel wide: some pixels without a
// measurement, some with what cannot be one.
struct DepthScene {
  std::vector<std::vector<float>> values;
  std::vector<DepthView> views;
  std::vector<DepthHandle> in(Backend& backend) const {
    std::vector<DepthHandle> handles;
    for (const DepthView& view : views) handles.push_back(backend.make_depth(view));
    return handles;
  }
};

inline DepthScene make_depth_scene(std::mt19937& rng) {
  std::uniform_real_distribution<float> depth(0.24f, 0.36f);
  struct Size {
    int width, height;
  };
  DepthScene scene;
  for (const Size& s : std::vector<Size>{{70, 100}, {33, 17}, {1, 5}}) {
    std::vector<float>& values = scene.values.emplace_back();
    for (int i = 0; i < s.width * s.height; ++i) {
      const auto kind = rng() % 20;
      values.push_back(kind > 2 ? depth(rng) : std::array{0.0f, -0.3f, 2e4f}[kind]);
    }
    scene.views.push_back({values, s.width, s.height,
                           Intrinsics{260, 250, 0.5f * float(s.width), 0.45f * float(s.height)}});
  }
  return scene;
}

struct DepthCase {
  std::vector<SurfacePoint> points;
  std::vector<PoseProblem> problems;
  std::span<const SurfacePoint> points_of(const PoseProblem& problem) const {
    return std::span(points).subspan(problem.first_point, problem.point_count);
  }
};

// Problems of all lengths on all views, some of them too near or out of the image, of points with a
// sure verdict. 40 of up to 1,500 points have more than the path in bands binds at once.
inline DepthCase depth_case(std::mt19937& rng, const DepthScene& scene,
                            const PoseDepthOptions& options, int problems, int max_points) {
  std::uniform_real_distribution<float> unit(0, 1);
  DepthCase c;
  for (int i = 0; i < problems; ++i) {
    const int count = i == 0 ? max_points : static_cast<int>(unit(rng) * float(max_points + 1));
    const auto view =
        static_cast<std::uint32_t>(i) % static_cast<std::uint32_t>(scene.views.size());
    const PoseProblem problem{random_pose(rng, i % 7 == 6 ? 0.02f : 0.3f),
                              static_cast<std::uint32_t>(c.points.size()),
                              static_cast<std::uint32_t>(count), view};
    while (c.points.size() < problem.first_point + problem.point_count) {
      const ModelPoint m = random_points(rng, 1)[0];
      const SurfacePoint point{m.x_m, m.y_m, m.z_m, m.tx, m.ty, m.tz};
      const CameraPoint seen = in_camera(problem.camera_from_object, point);
      if (look_at(scene.views[view], seen, options).sure) c.points.push_back(point);
    }
    c.problems.push_back(problem);
  }
  return c;
}

}  // namespace edgescout::test
