#include "kernels/cases/synthetic.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace edgescout::bench {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

float uniform(std::mt19937& rng, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(rng);
}

// Turned by random angles about y, then x.
Pose random_pose(std::mt19937& rng, float z_m) {
  const float a = uniform(rng, -pi, pi), b = uniform(rng, -pi, pi);
  const float ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b);
  return {{ca, 0, sa, uniform(rng, -0.05f, 0.05f), sb * sa, cb, -sb * ca,
           uniform(rng, -0.04f, 0.04f), -cb * sa, sb, cb * ca, z_m}};
}

}  // namespace

std::vector<EdgePoint> random_segments(std::mt19937& rng, int width, int height, int points) {
  std::vector<EdgePoint> edges;
  while (static_cast<int>(edges.size()) < points) {
    const float x = uniform(rng, 0, float(width)), y = uniform(rng, 0, float(height)),
                theta = uniform(rng, 0, pi);
    const int length = static_cast<int>(uniform(rng, 15, 90));
    for (int s = 0; s < length && static_cast<int>(edges.size()) < points; ++s)
      edges.push_back({x + float(s) * std::cos(theta), y + float(s) * std::sin(theta), theta, 10});
  }
  return edges;
}

std::vector<std::uint8_t> disc_image(std::mt19937& rng, int width, int height) {
  std::vector<float> grey(std::size_t(width) * height, 110);
  for (int k = 0; k < 120; ++k) {
    const float cx = uniform(rng, 0, float(width)), cy = uniform(rng, 0, float(height)),
                r = uniform(rng, 5, 90);
    const float level = uniform(rng, 0, 255);
    for (int y = std::max(0, int(cy - r - 1)); y < std::min(height, int(cy + r + 2)); ++y)
      for (int x = std::max(0, int(cx - r - 1)); x < std::min(width, int(cx + r + 2)); ++x) {
        float& pixel = grey[std::size_t(y) * width + x];
        pixel += std::clamp(r - std::hypot(float(x) - cx, float(y) - cy) + 0.5f, 0.0f, 1.0f) *
                 (level - pixel);
      }
  }
  std::vector<std::uint8_t> image;
  for (const float g : grey)
    image.push_back(static_cast<std::uint8_t>(std::clamp(g + uniform(rng, -2, 2), 0.0f, 255.0f)));
  return image;
}

Templates random_templates(std::mt19937& rng, int width, int height, int bins, int count,
                           std::uint32_t columns, std::uint32_t rows) {
  Templates templates;
  for (int t = 0; t < count; ++t) {
    const auto points = static_cast<std::uint32_t>(uniform(rng, 60, 200));
    const float a = uniform(rng, 0.08f, 0.2f) * float(height), b = a * uniform(rng, 0.4f, 1),
                tilt = uniform(rng, 0, pi);
    templates.jobs.push_back({static_cast<std::uint32_t>(templates.points.size()), points,
                              static_cast<std::int32_t>(uniform(rng, 0.1f, 0.8f) * float(width)),
                              static_cast<std::int32_t>(uniform(rng, 0.1f, 0.8f) * float(height)),
                              columns, rows});
    for (std::uint32_t p = 0; p < points; ++p) {
      const float turn = 2 * pi * float(p) / float(points), u = a * std::cos(turn),
                  v = b * std::sin(turn);
      const float direction = std::atan2(b * std::cos(turn), -a * std::sin(turn)) + tilt + 2 * pi;
      templates.points.push_back(
          {static_cast<std::int16_t>(u * std::cos(tilt) - v * std::sin(tilt)),
           static_cast<std::int16_t>(u * std::sin(tilt) + v * std::cos(tilt)),
           static_cast<std::uint16_t>(int(direction / pi * float(bins)) % bins)});
    }
  }
  return templates;
}

Poses random_poses(std::mt19937& rng, int problems, int points) {
  Poses poses;
  for (int i = 0; i < points; ++i) {
    const float turn = uniform(rng, -pi, pi);
    poses.points.push_back({uniform(rng, -0.06f, 0.06f), uniform(rng, -0.06f, 0.06f),
                            uniform(rng, -0.06f, 0.06f), std::cos(turn), std::sin(turn), 0});
  }
  for (int i = 0; i < problems; ++i)
    poses.problems.push_back(
        {random_pose(rng, uniform(rng, 0.35f, 0.45f)), 0, static_cast<std::uint32_t>(points), 0});
  return poses;
}

Mesh bumpy_ball(int rings, int segments) {
  Mesh mesh;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s < segments; ++s) {
      const float polar = pi * float(r) / float(rings), turn = 2 * pi * float(s) / float(segments);
      const float radius = 0.05f * (1 + 0.2f * std::sin(5 * turn) * std::sin(4 * polar));
      for (const float c :
           {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)})
        mesh.vertices_m.push_back(radius * c);
    }
  const auto index = [&](int r, int s) {
    return static_cast<std::uint32_t>(r * segments + s % segments);
  };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < segments; ++s)
      for (const std::uint32_t i : {index(r, s), index(r + 1, s), index(r, s + 1), index(r, s + 1),
                                    index(r + 1, s), index(r + 1, s + 1)})
        mesh.triangles.push_back(i);
  return mesh;
}

std::vector<DepthJob> views_around(int count, int width, int height) {
  std::mt19937 rng(4);
  std::vector<DepthJob> jobs;
  const float focal = 1.2f * float(width);
  for (int i = 0; i < count; ++i)
    jobs.push_back(
        {random_pose(rng, 0.25f), {focal, focal, 0.5f * float(width), 0.5f * float(height)}});
  return jobs;
}

}  // namespace edgescout::bench
