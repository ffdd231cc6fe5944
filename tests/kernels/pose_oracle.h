// One model point in one view, written from the prose of pose_normal_equations.h and pose_score.h
// alone, in long double: an error that all paths of the kernels share would show against it. Of the
// kernels' code it takes the storage order (TensorShape) and the published constants.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/kernels/pose_cases.h"

namespace edgescout::test {

using Real = long double;
using Real3 = std::array<Real, 3>;

// What a view holds: the tensor as its own path made it, and the image.
struct OracleView {
  TensorShape shape;
  Intrinsics camera;
  std::vector<std::uint16_t> tensor;
  std::vector<std::uint8_t> pixels;
};

struct CameraPoint {
  Real3 position, tangent;
  Real3 arm;  // from the object's origin, about which a pose turns, to the point
};

struct ImagePoint {
  Real x, y, theta;
  Real foreshortening;  // length of the projected tangent over that of one across the line of sight
};

inline Real3 plus(const Real3& a, const Real3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Real3 times(Real s, const Real3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline Real3 cross(const Real3& a, const Real3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Real3 unit(const Real3& a) { return times(1 / std::hypot(a[0], a[1], a[2]), a); }

inline Real3 rotated(const Pose& pose, const Real3& v) {
  Real3 r{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) r[row] += pose.m[4 * row + column] * v[column];
  return r;
}

inline Real3 rotated_back(const Pose& pose, const Real3& v) {
  Real3 r{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) r[column] += pose.m[4 * row + column] * v[row];
  return r;
}

inline CameraPoint in_camera(const Pose& pose, const ModelPoint& p) {
  const Real3 arm = rotated(pose, {p.x_m, p.y_m, p.z_m});
  return {plus(arm, {pose.m[3], pose.m[7], pose.m[11]}), rotated(pose, {p.tx, p.ty, p.tz}), arm};
}

// The pose moved by a little along one of its six directions: translation (m), then rotation (rad).
inline CameraPoint moved(const CameraPoint& p, int direction, Real by) {
  Real3 along{};
  along[direction % 3] = by;
  if (direction < 3) return {plus(p.position, along), p.tangent, p.arm};
  return {plus(p.position, cross(along, p.arm)), plus(p.tangent, cross(along, p.tangent)), p.arm};
}

inline bool in_front(const CameraPoint& p) {
  return p.position[2] > POSE_MIN_DEPTH_M &&
         std::ranges::all_of(p.position, [](Real v) { return std::abs(v) < POSE_MAX_RANGE_M; });
}

inline ImagePoint project(const Intrinsics& camera, const CameraPoint& p) {
  const auto [x, y, z] = p.position;
  const auto [tx, ty, tz] = p.tangent;
  const Real dx = camera.fx * (tx * z - x * tz) / (z * z),
             dy = camera.fy * (ty * z - y * tz) / (z * z);
  const Real theta = std::atan2(dy, dx), pi = std::numbers::pi_v<Real>;
  return {camera.fx * x / z + camera.cx, camera.fy * y / z + camera.cy,
          theta - pi * std::floor(theta / pi), std::hypot(dx, dy) * z / camera.fx};
}

// Inside is what has its nearest pixel in the image.
inline bool inside(const TensorShape& shape, const ImagePoint& p) {
  return p.x >= -0.5L && p.y >= -0.5L && p.x < shape.width - 0.5L && p.y < shape.height - 0.5L;
}

// Trilinear in x, y and, circularly, in orientation; outside the image the border's value and the
// way to it.
inline Real tensor_px(const OracleView& view, const ImagePoint& p) {
  const TensorShape& shape = view.shape;
  const Real x = std::clamp<Real>(p.x, 0, shape.width - 1),
             y = std::clamp<Real>(p.y, 0, shape.height - 1);
  const Real bin = p.theta * shape.bins / std::numbers::pi_v<Real>;
  Real value = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int at_x = static_cast<int>(x) + (corner & 1),
              at_y = static_cast<int>(y) + (corner >> 1 & 1),
              at_bin = static_cast<int>(bin) + (corner >> 2);
    const Real weight =
        (1 - std::abs(x - at_x)) * (1 - std::abs(y - at_y)) * (1 - std::abs(bin - at_bin));
    if (weight > 0) value += weight * view.tensor[shape.index(at_x, at_y, at_bin % shape.bins)];
  }
  return value / DCD_UNITS_PER_PX + std::hypot(p.x - x, p.y - y);
}

inline Real to_integer(Real value) { return std::abs(value - std::round(value)); }

// Float may put a point next to a seam on the seam's other side: the depth where points begin to
// count, borders, rows and columns, the borders between nearest pixels, and bins.
inline bool clear_of_seams(const TensorShape& shape, const Intrinsics& camera,
                           const CameraPoint& p) {
  if (std::abs(p.position[2] - POSE_MIN_DEPTH_M) < 1e-5L) return false;
  if (!in_front(p)) return true;
  const ImagePoint at = project(camera, p);
  return to_integer(2 * at.x) > 4e-3L && to_integer(2 * at.y) > 4e-3L &&
         to_integer(at.theta * shape.bins / std::numbers::pi_v<Real>) > 2e-3L;
}

// Nor is it seen so much end on that its orientation is rounding's.
inline bool kept_by_float(const TensorShape& shape, const Intrinsics& camera,
                          const CameraPoint& p) {
  return clear_of_seams(shape, camera, p) &&
         (!in_front(p) || project(camera, p).foreshortening > 1.2 * POSE_MIN_FORESHORTENING);
}

// The problem, with as many points of `offer` as it says, of those that `keep` takes.
template <class Keep, class Offer>
void add_problem(PoseCase& c, const PoseProblem& problem, const Keep& keep, const Offer& offer) {
  while (c.points.size() < problem.first_point + problem.point_count)
    if (const ModelPoint point = offer(); keep(point)) c.points.push_back(point);
  c.problems.push_back(problem);
}

// Problems of all lengths on all views, some of them behind the camera or out of the image. 40 of
// up to 1,500 points have more than the path in bands binds at once.
inline PoseCase pose_case(std::mt19937& rng, const TwoViews& views, int problems, int max_points) {
  std::uniform_real_distribution<float> unit(0, 1);
  PoseCase c;
  for (int i = 0; i < problems; ++i) {
    const int count = i == 0 ? max_points : static_cast<int>(unit(rng) * float(max_points + 1));
    const std::size_t view = static_cast<std::size_t>(i) % views.cameras.size();
    const PoseProblem problem{random_pose(rng, i % 7 == 6 ? 0.02f : 0.3f),
                              static_cast<std::uint32_t>(c.points.size()),
                              static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(view)};
    add_problem(
        c, problem,
        [&](const ModelPoint& point) {
          return kept_by_float(views.shapes[view], views.cameras[view],
                               in_camera(problem.camera_from_object, point));
        },
        [&] { return random_points(rng, 1)[0]; });
  }
  return c;
}

struct OracleScene {
  std::vector<ViewHandle> handles;
  std::vector<OracleView> views;
};

// A third of the image has gradients about the threshold of Psi, the rest is noise.
inline std::vector<std::uint8_t> random_pixels(std::mt19937& rng, int width, int height) {
  std::vector<std::uint8_t> pixels;
  for (int i = 0; i < width * height; ++i)
    pixels.push_back(static_cast<std::uint8_t>(rng() & (i % width < width / 3 ? 7 : 255)));
  return pixels;
}

// Images of several sizes, cameras and numbers of bins; one is a pixel wide.
inline OracleScene make_scene(Backend& backend, std::mt19937& rng) {
  OracleScene scene;
  for (const TensorShape& s : std::vector<TensorShape>{{70, 100, 60}, {33, 17, 6}, {1, 5, 60}}) {
    TensorOptions options;
    options.bins = s.bins;
    OracleView view{s, {260, 250, 0.5f * float(s.width), 0.45f * float(s.height)}, {}, {}};
    view.pixels = random_pixels(rng, s.width, s.height);
    const std::vector<EdgePoint> edges =
        random_edges(rng, s.width, s.height, 1 + s.width * s.height / 20);
    scene.handles.push_back(backend.make_view(
        edges, s.width, s.height, {s.width, s.height, view.pixels.data()}, view.camera, options));
    view.tensor = scene.handles.back()->tensor();
    scene.views.push_back(std::move(view));
  }
  return scene;
}

// The same point with a tangent nearly along the line of sight.
inline ModelPoint seen_end_on(const Pose& pose, const ModelPoint& p) {
  const CameraPoint q = in_camera(pose, p);
  const Real3 sight = unit(q.position);
  const Real3 tangent =
      rotated_back(pose, unit(plus(sight, times(0.03L, unit(cross(sight, q.tangent))))));
  return {p.x_m, p.y_m, p.z_m, float(tangent[0]), float(tangent[1]), float(tangent[2])};
}

// Problems of all lengths on all views, of points that `keep` takes; one in eight points is offered
// end on.
inline PoseCase kept_pose_case(std::mt19937& rng, const OracleScene& scene,
                               bool (*keep)(const TensorShape&, const Intrinsics&,
                                            const CameraPoint&)) {
  PoseCase c;
  for (std::uint32_t i = 0; i < 30; ++i) {
    const PoseProblem problem{random_pose(rng, i % 7 == 6 ? 0.02f : 0.3f),
                              static_cast<std::uint32_t>(c.points.size()), 1 + i * i / 2,
                              static_cast<std::uint32_t>(i % scene.views.size())};
    const OracleView& view = scene.views[problem.view];
    add_problem(
        c, problem,
        [&](const ModelPoint& point) {
          return keep(view.shape, view.camera, in_camera(problem.camera_from_object, point));
        },
        [&] {
          const ModelPoint any = random_points(rng, 1)[0];
          return rng() % 8 == 0 ? seen_end_on(problem.camera_from_object, any) : any;
        });
  }
  return c;
}

inline std::span<const ModelPoint> points_of(const PoseCase& c, const PoseProblem& problem) {
  return std::span(c.points).subspan(problem.first_point, problem.point_count);
}

// Camera and object share their axes; the object lies a metre ahead.
inline constexpr Pose ahead{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1}};

// A straight edge through the middle of a wide-angle view of 33 x 33 px, one point a pixel, and 60
// bins without smoothing: a bin is 3 degrees and turns cost round(256 * 30 * pi / 60) = 402 units a
// bin.
inline ViewHandle straight_edge(Backend& backend, bool vertical, const ImageView& image) {
  std::vector<EdgePoint> edges;
  for (int i = 0; i < 33; ++i)
    edges.push_back(vertical ? EdgePoint{16, float(i), std::numbers::pi_v<float> / 2, 10}
                             : EdgePoint{float(i), 16, 0, 10});
  TensorOptions options;
  options.smoothing_variance = 0;
  return backend.make_view(edges, 33, 33, image, {10, 10, 16, 16}, options);
}

inline constexpr Real bin_px = 402 / 256.0L;

}  // namespace edgescout::test
