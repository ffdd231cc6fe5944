// Poses and views for the tests of pose_normal_equations and pose_score.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "kernels/pose_score.h"
#include "tests/kernels/paths.h"

namespace edgescout::test {

// Where the object's frame is the camera's.
inline constexpr Pose camera_frame{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};

inline Pose random_pose(std::mt19937& rng, float z_m) {
  std::uniform_real_distribution<float> unit(-1, 1);
  float q[4], norm = 0;
  for (float& v : q) v = unit(rng), norm += v * v;
  for (float& v : q) v /= std::sqrt(norm);
  const auto [w, x, y, z] = std::tie(q[0], q[1], q[2], q[3]);
  return {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 0.02f * unit(rng),
           2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 0.02f * unit(rng),
           2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
           z_m + 0.03f * unit(rng)}};
}

inline std::vector<ModelPoint> random_points(std::mt19937& rng, int count) {
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<ModelPoint> points;
  for (int i = 0; i < count; ++i) {
    const float tx = unit(rng), ty = unit(rng), tz = unit(rng),
                norm = std::sqrt(tx * tx + ty * ty + tz * tz) + 1e-6f;
    points.push_back(
        {0.05f * unit(rng), 0.05f * unit(rng), 0.05f * unit(rng), tx / norm, ty / norm, tz / norm});
  }
  return points;
}

// Where a diverging registration may end.
inline std::vector<Pose> poses_nowhere(std::mt19937& rng) {
  std::vector<Pose> poses;
  for (const float lost : {NAN, INFINITY, -INFINITY, 1e38f, 1e20f, 1.1e4f})
    for (const int entry : {3, 7, 11}) {
      Pose pose = random_pose(rng, 0.3f);
      pose.m[entry] = lost;
      poses.push_back(pose);
    }
  for (int entry = 0; entry < 12; ++entry) {
    Pose pose = random_pose(rng, 0.3f);
    pose.m[entry] = NAN;
    poses.push_back(pose);
  }
  return poses;
}

struct PoseCase {
  std::vector<ModelPoint> points;
  std::vector<PoseProblem> problems;
};

struct TwoViews {
  std::vector<ViewHandle> tested, reference;
  std::vector<TensorShape> shapes;
  std::vector<Intrinsics> cameras;
};

// Views of different size and camera, one of them one pixel wide.
inline TwoViews make_views(Backend& tested, Backend& reference, std::mt19937& rng,
                           bool with_image) {
  struct Size {
    int width, height;
  };
  TwoViews views;
  for (const Size& s : std::vector<Size>{{70, 100}, {33, 17}, {1, 5}}) {
    const std::vector<EdgePoint> edges =
        random_edges(rng, s.width, s.height, s.width * s.height / 20);
    std::vector<std::uint8_t> pixels;
    for (int i = 0; i < s.width * s.height; ++i)
      pixels.push_back(static_cast<std::uint8_t>(rng() & 255));
    const ImageView image = with_image ? ImageView{s.width, s.height, pixels.data()} : ImageView{};
    const Intrinsics camera{260, 250, 0.5f * float(s.width), 0.45f * float(s.height)};
    views.shapes.push_back({s.width, s.height, TensorOptions{}.bins});
    views.cameras.push_back(camera);
    views.tested.push_back(tested.make_view(edges, s.width, s.height, image, camera, {}));
    views.reference.push_back(reference.make_view(edges, s.width, s.height, image, camera, {}));
  }
  return views;
}

}  // namespace edgescout::test
