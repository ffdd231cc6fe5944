// Problems for the tests of template_project, and where their points land exactly: written from the
// prose of template_project.h in long double.
#pragma once

#include <algorithm>

#include "tests/kernels/pose_oracle.h"

namespace edgescout::test {

struct ProjectionCase {
  std::vector<ModelPoint> points;
  std::vector<TemplateProjectJob> jobs;
  TemplateProjectOptions options;
  std::size_t places = 0;
};

// Jobs of 0 to `most` points of a list of `offered`. Their poses reach from behind the camera to
// far before it, and from the middle of the view to far outside. There are gaps between their
// places.
inline ProjectionCase projection_case(std::mt19937& rng, int jobs, int most, int offered,
                                      int bins) {
  const auto in = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(rng);
  };
  std::uniform_real_distribution<float> unit(-1, 1);
  ProjectionCase c{random_points(rng, offered), {}, {{260, 250, 35, 45}, bins, 0.01f}};
  for (int j = 0; j < jobs; ++j) {
    Pose pose = random_pose(rng, j % 5 == 4 ? 0.02f : 0.3f);
    if (j % 7 == 6) pose.m[3] += unit(rng) * 2;
    const int count = j == 0 ? std::min(most, offered) : in(0, std::min(most, offered));
    c.places += std::size_t(in(0, 3));
    c.jobs.push_back({pose, std::uint32_t(in(0, offered - count)), std::uint32_t(count),
                      std::uint32_t(c.places), std::round(unit(rng) * 100), unit(rng) * 100});
    c.places += std::size_t(count);
  }
  c.places += 2;
  return c;
}

// Before anything is rounded, and how far float may be off.
struct ExactPoint {
  Real dx, dy, bin, depth_m;
  Real off_px, off_bins, off_m;
};

inline ExactPoint exact_point(const TemplateProjectJob& job, const TemplateProjectOptions& options,
                              const ModelPoint& model) {
  const Real pi = std::numbers::pi_v<Real>, nearest_m = options.nearest_m;
  const Intrinsics& k = options.intrinsics;
  const float* m = job.camera_from_object.m;
  CameraPoint p = in_camera(job.camera_from_object, model);
  ExactPoint exact{};
  exact.depth_m = p.position[2];
  p.position[2] = std::max(p.position[2], nearest_m);
  const auto [x, y, z] = p.position;
  const ImagePoint at = project(k, p);
  const Real far_px = TEMPLATE_PROJECT_FAR_PX;
  exact.dx = std::clamp(at.x - job.anchor_x_px, -far_px, far_px);
  exact.dy = std::clamp(at.y - job.anchor_y_px, -far_px, far_px);
  exact.bin = at.theta * options.bins / pi;
  const Real reach_m = std::hypot(model.x_m, model.y_m, model.z_m) + std::hypot(m[3], m[7], m[11]);
  const Real focal = std::max(k.fx, k.fy), s = std::max(std::abs(x), std::abs(y)) / z;
  const auto [qx, qy, qz] = p.tangent;
  const Real d = std::hypot(k.fx * (z * qx - x * qz), k.fy * (z * qy - y * qz));
  exact.off_m = 1e-6L * reach_m;
  exact.off_px = 1e-6L * (focal * reach_m / z * (1 + s) + std::hypot(k.cx, k.cy) +
                          std::hypot(job.anchor_x_px, job.anchor_y_px));
  exact.off_bins = 2e-6L * (1 + focal * reach_m / d) * options.bins / pi;
  return exact;
}

// Circularly, of `bins`.
inline Real bins_apart(Real a, Real b, int bins) {
  return std::abs(std::remainder(a - b, Real(bins)));
}

}  // namespace edgescout::test
