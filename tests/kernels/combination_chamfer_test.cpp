// combination_chamfer: its reference against combinations that are really drawn, z-buffer, edge map
// and distance transform.
//
// They may differ where and because
//   - the drawn edge map has its edges at pixel centres, at most half a pixel's diagonal from where
//   they are; the kernel rounds
//     positions and distances to 1/16 px: both together `resolution_px`;
//   - a member's nearest edge point may be hidden and a farther one show: the kernel then knows no
//   edge of that member, the drawn
//     map does. The kernel's distance is the larger one.
#include "kernels/combination_chamfer.h"

#include "kernels/cases/chamfer_cases.h"
#include "kernels/error.h"
#include "tests/kernels/paths.h"

namespace edgescout {
namespace {

constexpr double resolution_px = 0.5 * std::numbers::sqrt2 + std::numbers::sqrt2 / 32 + 1.0 / 32;
constexpr test::Pinhole camera{190, 39.5, 29.5};
constexpr int width = 80, height = 60;
constexpr ChamferOptions chamfer_options{255.0f / 16};

struct Boxes {
  test::ChamferInput input;
  std::vector<test::Box> boxes;
};

// Particles are other boxes, every one near a candidate; each point by itself, or all together.
Boxes box_scene(std::mt19937& rng, int count, bool single_points) {
  Boxes made;
  made.input.width = width;
  made.input.height = height;
  std::uniform_real_distribution<double> shift(-0.004, 0.004);
  for (int c = 0; c < count; ++c) {
    made.boxes.push_back(test::random_box(rng));
    // As of objects of several sizes.
    test::add_box(made.input, made.boxes.back(), camera, 60, 0.004f * float(c % 4));
    test::Box near = made.boxes.back();
    for (double& v : near.centre) v += shift(rng);
    std::vector<ParticlePoint> points;
    for (const MapEdge& edge : test::box_edges(near, camera, 9))
      points.push_back({edge.x_px, edge.y_px, edge.z_m, std::uint32_t(points.size() % 3 == 0)});
    if (!single_points) made.input.add_particle(points);
    for (const ParticlePoint& point : points)
      if (single_points) made.input.add_particle({point});
  }
  made.input.draw_maps();
  made.input.draw_combinations(rng, 24, 0.5);
  return made;
}

// A combination as a renderer would show it.
class Drawn {
 public:
  Drawn(const Boxes& from, std::size_t combination) : depth_(width * height, 1e9) {
    const CombinationBits combinations = from.input.combinations();
    for (std::size_t c = 0; c < from.boxes.size(); ++c)
      if (combinations.has(combination, c))
        members_.push_back({from.boxes[c], double(from.input.tolerance_m[c])});
    for (const Member& member : members_) draw_surface(depth_, member);
    for (std::size_t m = 0; m < members_.size(); ++m) draw_edges(m);
  }
  bool shows(double u, double v, double z_m) const {
    const int x = int(std::lround(u)), y = int(std::lround(v));
    return x >= 0 && x < width && y >= 0 && y < height && depth_[y * width + x] >= z_m;
  }
  // The exact transform, looked up at the pixel.
  double distance_px(double u, double v) const {
    const int x = int(std::lround(u)), y = int(std::lround(v));
    double least_px2 = chamfer_options.cap_px * chamfer_options.cap_px;
    for (const auto& [edge_x, edge_y] : edges_)
      least_px2 =
          std::min(least_px2, double((edge_x - x) * (edge_x - x) + (edge_y - y) * (edge_y - y)));
    return std::sqrt(least_px2);
  }

 private:
  struct Member {
    test::Box box;
    double tolerance_m;
  };

  // The depth from which on it hides.
  static void draw_surface(std::vector<double>& depth, const Member& member) {
    for (int i = 0; i < width * height; ++i) {
      const int x = i % width, y = i / width;
      if (const auto z = test::box_depth(member.box, camera, x, y))
        depth[i] = std::min(depth[i], *z + member.tolerance_m);
    }
  }
  // Its own faces decide a convex body's edges exactly (box_edges), the z-buffer what the others
  // hide.
  void draw_edges(std::size_t member) {
    std::vector<double> others(width * height, 1e9);
    for (std::size_t m = 0; m < members_.size(); ++m)
      if (m != member) draw_surface(others, members_[m]);
    for (const MapEdge& edge : test::box_edges(members_[member].box, camera, 60)) {
      const int x = int(std::lround(edge.x_px)), y = int(std::lround(edge.y_px));
      if (x < 0 || x >= width || y < 0 || y >= height) continue;
      if (others[y * width + x] >= edge.z_m) edges_.push_back({x, y});
    }
  }

  std::vector<Member> members_;
  std::vector<double> depth_;
  std::vector<std::array<int, 2>> edges_;  // pixels; some more than once
};

// Whether a member's nearest edge point at the place is hidden by another: where the kernel may
// know less than a drawn map.
bool nearest_is_hidden(const Boxes& from, std::size_t combination, double u, double v) {
  const test::ChamferInput& input = from.input;
  const CombinationBits combinations = input.combinations();
  const int x = int(std::lround(u)), y = int(std::lround(v));
  for (std::size_t c = 0; c < from.boxes.size(); ++c) {
    const CandidateMap& map = input.maps[c];
    if (!combinations.has(combination, c) || !map.window.contains(x, y)) continue;
    const std::uint32_t word = input.nearest[map.first_pixel + map.window.index(x, y)];
    if (word == CANDIDATE_MAP_EMPTY) continue;
    const MapEdge& edge = input.edges[map.first_edge + (word & 0xffffu)];
    for (std::size_t o = 0; o < from.boxes.size(); ++o) {
      if (o == c || !combinations.has(combination, o)) continue;
      const auto z =
          test::box_depth(from.boxes[o], camera, std::lround(edge.x_px), std::lround(edge.y_px));
      if (z && *z + input.tolerance_m[o] < edge.z_m) return true;
    }
  }
  return false;
}

TEST(CombinationChamfer, EveryPointAgreesWithTheDrawnRealization) {
  std::mt19937 rng = test::test_rng();
  int compared = 0, hidden = 0, knows_less = 0, hidden_nearest = 0;
  for (int round = 0; round < 5; ++round) {
    const Boxes made = box_scene(rng, 7, true);
    const auto cells = combination_chamfer_reference(made.input.view(), made.input.combinations(),
                                                     chamfer_options);
    for (std::uint32_t j = 0; j < made.input.combination_count; ++j) {
      const Drawn drawn(made, j);
      for (std::size_t i = 0; i < made.input.points.size(); ++i) {
        const ParticlePoint& point = made.input.points[i];
        const ChamferCell& cell = cells[i * made.input.combination_count + j];
        ASSERT_EQ(cell.seen, drawn.shows(point.x_px, point.y_px, point.z_m));
        EXPECT_EQ(cell.unseen, cell.seen * point.unseen);
        if (cell.seen == 0) {
          ++hidden;
          continue;
        }
        ++compared;
        const double found = mean_px(cell, chamfer_options.cap_px),
                     expected = drawn.distance_px(point.x_px, point.y_px);
        EXPECT_GE(found, expected - resolution_px);
        if (nearest_is_hidden(made, j, point.x_px, point.y_px)) {
          ++hidden_nearest;
          knows_less += found > expected + resolution_px;
        } else {
          EXPECT_NEAR(found, expected, resolution_px);
        }
      }
    }
  }
  std::printf("%d points compared, %d hidden, %d with a hidden nearest edge, %d of those too far\n",
              compared, hidden, hidden_nearest, knows_less);
  EXPECT_GT(compared, 20000);
  EXPECT_GT(hidden, 1000);
  EXPECT_GT(hidden_nearest, 500);
  EXPECT_LT(knows_less, compared / 20);
}

// What next-view planning reads: whole particles. Rounding nearly averages out.
TEST(CombinationChamfer, MeansAgreeWithTheDrawnRealization) {
  std::mt19937 rng = test::test_rng();
  double worst = 0, total = 0;
  int count = 0;
  for (int round = 0; round < 4; ++round) {
    const Boxes made = box_scene(rng, 6, false);
    const auto cells = combination_chamfer_reference(made.input.view(), made.input.combinations(),
                                                     chamfer_options);
    for (std::uint32_t j = 0; j < made.input.combination_count; ++j) {
      const Drawn drawn(made, j);
      for (std::size_t i = 0; i < made.boxes.size(); ++i) {
        double sum = 0;
        std::uint32_t seen = 0, unseen = 0;
        for (std::uint32_t p = made.input.first_point[i]; p < made.input.first_point[i + 1]; ++p) {
          const ParticlePoint& point = made.input.points[p];
          if (!drawn.shows(point.x_px, point.y_px, point.z_m)) continue;
          sum += drawn.distance_px(point.x_px, point.y_px);
          ++seen;
          unseen += point.unseen;
        }
        const ChamferCell& cell = cells[i * made.input.combination_count + j];
        EXPECT_EQ(cell.seen, seen);
        EXPECT_EQ(cell.unseen, unseen);
        const double error = std::abs(mean_px(cell, chamfer_options.cap_px) -
                                      (seen ? sum / seen : chamfer_options.cap_px));
        worst = std::max(worst, error);
        total += error;
        ++count;
      }
    }
  }
  std::printf("means differ by %.3f px, at most %.2f px\n", total / count, worst);
  EXPECT_LT(total / count, 0.25);
  EXPECT_LT(worst, 1.5);
}

TEST(CombinationChamfer, NothingSeenOrNoMemberGivesTheCap) {
  std::mt19937 rng = test::test_rng();
  Boxes made = box_scene(rng, 3, false);
  made.input.add_particle({{-50, 10, 0.4f, 1}, {10, 500, 0.4f, 1}, {NAN, 5, 0.4f, 1}});
  made.input.add_particle({});
  const ChamferOptions short_cap{4};
  const auto cells =
      combination_chamfer_reference(made.input.view(), made.input.combinations(), short_cap);
  const std::uint32_t m = made.input.combination_count;
  for (std::uint32_t j = 0; j < m; ++j)
    for (const std::size_t i : {std::size_t{3}, std::size_t{4}}) {
      EXPECT_EQ(cells[i * m + j].seen, 0);
      EXPECT_EQ(cells[i * m + j].unseen, 0);
      EXPECT_EQ(mean_px(cells[i * m + j], short_cap.cap_px), 4);
    }
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(mean_px(cells[i * m], short_cap.cap_px), 4);  // the empty combination
  for (const ChamferCell& cell : cells) EXPECT_LE(mean_px(cell, short_cap.cap_px), 4);
}

}  // namespace
}  // namespace edgescout
