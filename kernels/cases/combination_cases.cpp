#include "kernels/cases/combination_cases.h"

#include <numbers>

namespace edgescout::bench {

namespace {

using Vector = std::array<double, 3>;

constexpr double table_m[2] = {0.22, 0.17};  // half its sides
constexpr Vector half_m{0.05, 0.025, 0.015};

double uniform(std::mt19937& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

// Turned about z, then leant about its own x.
test::Box box_at(const Vector& centre, double turn, double lean) {
  const double c = std::cos(turn), s = std::sin(turn), cl = std::cos(lean), sl = std::sin(lean);
  return {{{{c, s, 0}, {-s * cl, c * cl, sl}, {s * sl, -c * sl, cl}}}, centre, half_m};
}

test::Box random_box(std::mt19937& rng) {
  return box_at({uniform(rng, -table_m[0], table_m[0]), uniform(rng, -table_m[1], table_m[1]),
                 uniform(rng, 0.015, 0.045)},
                uniform(rng, 0, 2 * std::numbers::pi), uniform(rng, -0.5, 0.5));
}

test::Box moved(std::mt19937& rng, test::Box box, double by_m) {
  for (double& v : box.centre) v += uniform(rng, -by_m, by_m);
  return box;
}

// camera_from_world of one of `count` cameras around the table, in two rings.
struct Camera {
  std::array<Vector, 3> rows;
  Vector position;
  Vector turned(const Vector& v) const {
    return {test::dot(rows[0], v), test::dot(rows[1], v), test::dot(rows[2], v)};
  }
  test::Box seen(const test::Box& box) const {
    test::Box out = box;
    for (int k = 0; k < 3; ++k) out.axis[k] = turned(box.axis[k]);
    out.centre = turned(
        {box.centre[0] - position[0], box.centre[1] - position[1], box.centre[2] - position[2]});
    return out;
  }
};

Camera camera_around(int index, int count) {
  constexpr double radius_m = 0.7, low_rad = 0.9, high_rad = 1.25;
  const double azimuth = 4 * std::numbers::pi * index / count,
               elevation = 2 * index < count ? low_rad : high_rad;
  const Vector out{std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                   std::sin(elevation)};
  const Vector right{-std::sin(azimuth), std::cos(azimuth), 0};
  const Vector up{-std::cos(azimuth) * std::sin(elevation),
                  -std::sin(azimuth) * std::sin(elevation), std::cos(elevation)};
  Camera camera;
  for (int k = 0; k < 3; ++k) {
    camera.rows[0][k] = right[k];
    camera.rows[1][k] = -up[k];
    camera.rows[2][k] = -out[k];
    camera.position[k] = radius_m * out[k];
  }
  return camera;
}

}  // namespace

NextViewInput::NextViewInput(const NextViewSize& size) : size_(size) {
  std::mt19937 rng(6);
  // A third of them are the same object once more, a little off.
  for (int c = 0; c < size.candidates; ++c)
    candidates_.push_back(c % 3 == 2 ? moved(rng, candidates_.back(), 0.004) : random_box(rng));
  for (int i = 0; i < size.particles; ++i) {
    particles_.push_back(moved(rng, candidates_[std::size_t(i % size.candidates)], 0.006));
    beliefs_.push_back({uniform(rng, -2, 0), std::uint32_t(uniform(rng, 0, size.points)),
                        std::uint32_t(2 * size.points), 0});
  }
  test::ChamferInput bits;
  bits.maps.resize(std::size_t(size.candidates));
  bits.draw_combinations(rng, size.combinations, 0.5);
  combinations_ = bits.words;
}

test::ChamferInput NextViewInput::view(int index) const {
  const Camera camera = camera_around(index, size_.views);
  const test::Pinhole pinhole{0.98 * size_.width, 0.5 * size_.width, 0.5 * size_.height};
  constexpr int edges_of_a_box = 9;  // that show, nearly always
  const int points_per_edge = size_.points / edges_of_a_box;
  test::ChamferInput input;
  input.width = size_.width;
  input.height = size_.height;
  for (const test::Box& box : candidates_)
    test::add_box(input, camera.seen(box), pinhole, points_per_edge, 0.01f);
  for (const test::Box& box : particles_) {
    std::vector<ParticlePoint> points;
    for (const MapEdge& edge : test::box_edges(camera.seen(box), pinhole, points_per_edge))
      points.push_back({edge.x_px, edge.y_px, edge.z_m, std::uint32_t(points.size() % 4 == 0)});
    input.add_particle(points);
  }
  input.nearest.resize(input.surface_m.size());
  input.combination_count = size_.combinations;
  input.words = combinations_;
  return input;
}

}  // namespace edgescout::bench
