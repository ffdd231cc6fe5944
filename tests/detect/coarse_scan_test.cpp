#include "host/detect/coarse_scan.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/detect/part_image.h"
#include "tests/io/expect_input_error.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

using std::numbers::pi;

TEST(PlaceTemplate, PutsTheCentreWhereItIsAskedFor) {
  const auto backend = make_cpu_backend(1);
  const TemplateSet set = part_templates("l_bracket", 1, 0.3, 0.3, *backend);
  Random random = test_random();
  for (int i = 0; i < 200; ++i) {
    const TemplateView& view = set.views[random.below(int(set.views.size()))];
    const Eigen::Vector2d pixel(random.uniform(0, 320), random.uniform(0, 240));
    const double distance = random.uniform(0.2, 2);
    const Se3 pose =
        place_template(set, view, random.uniform(0, 2 * pi), distance, pixel, small_camera());
    const Eigen::Vector3d centre = pose * set.model.center_m;
    EXPECT_NEAR(centre.norm(), distance, 1e-9);
    EXPECT_LT((project(small_camera(), centre) - pixel).norm(), 1e-6);
    EXPECT_NEAR(pose.rotation.norm(), 1, 1e-12);
  }
}

// At any place of the image, the object turns the same side to the camera: its visible points stay.
TEST(PlaceTemplate, ShowsTheViewpointsSideEverywhere) {
  const auto backend = make_cpu_backend(1);
  const TemplateSet set = part_templates("l_bracket", 1, 0.3, 0.3, *backend);
  Random random = test_random();
  for (int i = 0; i < 200; ++i) {
    const TemplateView& view = set.views[random.below(int(set.views.size()))];
    const Se3 pose =
        place_template(set, view, random.uniform(0, 2 * pi), 0.3,
                       {random.uniform(0, 320), random.uniform(0, 240)}, small_camera());
    const Eigen::Vector3d to_camera = inverse(pose) * Eigen::Vector3d::Zero() - set.model.center_m;
    const Eigen::Vector3d of_view = view.camera_from_object.inverse() * -Eigen::Vector3d::UnitZ();
    EXPECT_LT((to_camera.normalized() - of_view).norm(), 1e-9);
  }
}

TEST(PlaceTemplate, TurnsAboutTheLineOfSight) {
  const auto backend = make_cpu_backend(1);
  const TemplateSet set = part_templates("l_bracket", 1, 0.3, 0.3, *backend);
  const Eigen::Vector2d middle(159.5, 119.5);
  const Se3 plain = place_template(set, set.views[0], 0, 0.3, middle, small_camera());
  EXPECT_LT(plain.rotation.angularDistance(set.views[0].camera_from_object), 1e-7);
  // x of the image towards y: clockwise as seen, since y points down.
  const Se3 turned = place_template(set, set.views[0], pi / 2, 0.3, middle, small_camera());
  const Eigen::Vector3d before = plain.rotation * Eigen::Vector3d(0.3, 0.5, 0.7),
                        after = turned.rotation * Eigen::Vector3d(0.3, 0.5, 0.7);
  EXPECT_LT((after - Eigen::Vector3d(-before.y(), before.x(), before.z())).norm(), 1e-9);
}

const ScanHit& best_of(const std::vector<ScanHit>& hits) {
  return *std::ranges::min_element(hits, {}, &ScanHit::mean_px);
}

// Edges drawn from a template's own pose: the scan names the template and the place.
TEST(CoarseScan, FindsTheTemplateThatMadeTheEdges) {
  const auto backend = make_cpu_backend(2);
  const TemplateSet set = part_templates("l_bracket", 2, 0.27, 0.33, *backend);
  const std::vector<double> distances = template_distances_m(set.options);
  const EdgeModel dense =
      part_model("l_bracket", 7.5e-4);  // an edge point a pixel, as a detector finds
  Random random = test_random();
  for (double reduction : {1.0, 2.0}) {
    const Camera coarse = scaled(small_camera(), 1 / reduction);
    for (int i = 0; i < 3; ++i) {
      const int view = random.below(int(set.views.size()));
      const double turn = 2 * pi / 12 * random.below(12),
                   distance = distances[random.below(int(distances.size()))];
      // An anchor of the grid, the whole part in the image.
      const Eigen::Vector2d place(2 * random.below(coarse.width / 4) + coarse.width / 4 / 2 * 2,
                                  2 * random.below(coarse.height / 4) + coarse.height / 4 / 2 * 2);
      const Se3 truth = place_template(set, set.views[view], turn, distance, place, coarse);
      const ObjectView image = view_of_edges(ideal_edges(dense, small_camera(), truth, *backend),
                                             small_camera(), reduction, *backend);
      const ScanHit best = best_of(coarse_scan(set, image, *backend, {}));
      EXPECT_LT(best.mean_px, 1.6);  // smoothing over orientation alone makes it 1.25
      EXPECT_EQ(best.viewpoint, view);
      EXPECT_LT(angle_between_rad(best.pose.world_from_object, truth), 1e-3);
      EXPECT_NEAR((best.pose.world_from_object * set.model.center_m).norm(), distance, 1e-9);
      EXPECT_LT((project(coarse, best.pose.world_from_object * set.model.center_m) - place).norm(),
                1e-6);
    }
  }
}

const Eigen::Vector2d FIRST_PLACE_PX(80, 120), SECOND_PLACE_PX(240, 120);

Se3 part_at(const Eigen::Vector2d& place_px, const TemplateSet& set, double distance_m) {
  return place_template(set, set.views[7], 0, distance_m, place_px, small_camera());
}

// The edges of a part at either place.
std::vector<EdgePoint> edges_of_two_brackets(const TemplateSet& set, double distance_m,
                                             Backend& backend) {
  const EdgeModel dense = part_model("l_bracket", 7.5e-4);
  std::vector<EdgePoint> edges;
  for (const Eigen::Vector2d& place_px : {FIRST_PLACE_PX, SECOND_PLACE_PX})
    for (const EdgePoint& edge :
         ideal_edges(dense, small_camera(), part_at(place_px, set, distance_m), backend))
      edges.push_back(edge);
  return edges;
}

// Two parts of one kind: the scan looks only where one of them is.
TEST(CoarseScan, LooksWhereItIsToldTo) {
  const auto backend = make_cpu_backend(2);
  const TemplateSet set = part_templates("l_bracket", 2, 0.27, 0.33, *backend);
  const std::vector<EdgePoint> edges =
      edges_of_two_brackets(set, template_distances_m(set.options)[0], *backend);
  for (const double reduction : {1.0, 3.0}) {
    const ObjectView image = view_of_edges(edges, small_camera(), reduction, *backend);
    ScanOptions options;
    options.within = {200, 90, 90, 0};  // down to the border
    const std::vector<ScanHit> hits = coarse_scan(set, image, *backend, options);
    double least_x = 1e9, most_x = 0, least_y = 1e9, most_y = 0;
    for (const ScanHit& hit : hits) {
      const Eigen::Vector2d at =
          project(small_camera(), hit.pose.world_from_object * set.model.center_m);
      least_x = std::min(least_x, at.x()), most_x = std::max(most_x, at.x());
      least_y = std::min(least_y, at.y()), most_y = std::max(most_y, at.y());
    }
    EXPECT_GE(least_x, 200);
    EXPECT_LT(most_x, 290);
    EXPECT_GE(least_y, 90);
    EXPECT_LT(least_x, 200 + 2 * reduction + 1);
    EXPECT_GT(most_x, 290 - 2 * reduction - 1);
    EXPECT_GT(most_y, 235);
    const Eigen::Vector2d best =
        project(small_camera(), best_of(hits).pose.world_from_object * set.model.center_m);
    EXPECT_LT((best - SECOND_PLACE_PX).norm(), 3 * reduction);
    options.within = {101.2, 70.2, 0.1, 0.1};  // between two anchors: the next one
    for (const ScanHit& hit : coarse_scan(set, image, *backend, options))
      EXPECT_LT((project(small_camera(), hit.pose.world_from_object * set.model.center_m) -
                 Eigen::Vector2d(101.2, 70.2))
                    .norm(),
                2.9 * reduction);
    options.within = {319, 239, 0, 0};  // behind the last one: that
    for (const ScanHit& hit : coarse_scan(set, image, *backend, options))
      EXPECT_LT((project(small_camera(), hit.pose.world_from_object * set.model.center_m) -
                 Eigen::Vector2d(319, 239))
                    .norm(),
                3.5 * reduction);
    options.within = {0, 240, 0, 0};
    expect_input_error([&] { coarse_scan(set, image, *backend, options); },
                       {"detect.region", "320x240"});
  }
}

// Two parts of one kind: the scan looks only where the prior holds one of them.
TEST(CoarseScan, LooksWhereThePriorMayHoldTheObject) {
  const auto backend = make_cpu_backend(2);
  const TemplateSet set = part_templates("l_bracket", 2, 0.27, 0.33, *backend);
  const double distance = template_distances_m(set.options)[1];
  const std::vector<EdgePoint> edges = edges_of_two_brackets(set, distance, *backend);
  const Se3 truth = part_at(SECOND_PLACE_PX, set, distance);
  Random random = test_random();
  ObjectView image = view_of_edges(edges, small_camera(), 1, *backend);
  image.camera_from_world = inverse({random.rotation(), {1, 2, 0.5}});
  const Eigen::Vector3d center = inverse(image.camera_from_world) * (truth * set.model.center_m);
  ScanOptions options;
  const auto hits_within = [&](double half_m) {
    const Eigen::Vector3d least = center.array() - half_m, most = center.array() + half_m;
    options.world.box_m = {least.x(), least.y(), least.z(), most.x(), most.y(), most.z()};
    return coarse_scan(set, image, *backend, options);
  };
  const std::vector<ScanHit> all = coarse_scan(set, image, *backend, {}), far = hits_within(9),
                             near = hits_within(0.01);
  ASSERT_EQ(far.size(), all.size()) << "a box that holds everything";
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(far[i].pose.world_from_object.translation_m,
              all[i].pose.world_from_object.translation_m);
    EXPECT_EQ(far[i].rank, all[i].rank);
  }
  EXPECT_LT(near.size(), all.size() / 4);
  EXPECT_LT(angle_between_rad(best_of(near).pose.world_from_object, truth), 1e-3);
  EXPECT_LT(distance_between_m(best_of(near).pose.world_from_object, truth), 1e-6);
  for (const ScanHit& hit : near) {
    const Eigen::Vector3d off =
        hit.pose.world_from_object * set.model.center_m - truth * set.model.center_m;
    // To the box's corners, the slack, half of a step of the distance.
    EXPECT_LT(off.norm(), 0.03 + 0.1 * set.model.mesh.diameter_m + 0.05 * distance);
  }
  options.world.box_m = {5, 5, 5, 6, 6, 6};
  EXPECT_TRUE(coarse_scan(set, image, *backend, options).empty());
}

// Part of the object lies outside the image: another template elsewhere must not win.
TEST(CoarseScan, FindsAnObjectThatReachesOverTheBorder) {
  const auto backend = make_cpu_backend(2);
  const TemplateSet set = part_templates("l_bracket", 2, 0.27, 0.33, *backend);
  const EdgeModel dense = part_model("l_bracket", 7.5e-4);
  const double distance = template_distances_m(set.options)[0];
  for (int view : {3, 11, 29}) {
    const Eigen::Vector2d place(22, 120);
    const Se3 truth = place_template(set, set.views[std::size_t(view)], 2 * pi / 12 * 5, distance,
                                     place, small_camera());
    const std::vector<EdgePoint> edges = ideal_edges(dense, small_camera(), truth, *backend);
    std::vector<EdgePoint> seen;
    for (const EdgePoint& edge : edges)
      if (edge.x_px >= 0 && edge.x_px < float(small_camera().width)) seen.push_back(edge);
    const ObjectView image = view_of_edges(seen, small_camera(), 1, *backend);
    const ScanHit best = best_of(coarse_scan(set, image, *backend, {}));
    const double outside = 1 - double(seen.size()) / double(edges.size());
    EXPECT_GT(outside, 0.1);
    EXPECT_LT(best.mean_px, 1.6 + 6.5 * outside);  // 1.6: as above
    EXPECT_EQ(best.viewpoint, view);
    EXPECT_LT(angle_between_rad(best.pose.world_from_object, truth), 1e-3);
    EXPECT_LT(
        (project(small_camera(), best.pose.world_from_object * set.model.center_m) - place).norm(),
        1e-6);
  }
}

// The scan as its header describes it, in double and one value at a time.
struct BruteForce {
  const TemplateSet& set;
  const ObjectView& image;
  const ScanOptions& options;
  std::vector<std::uint16_t> tensor = image.reduced[0].coarse->tensor();

  double value(int x, int y, int bin) const {
    const TensorShape& shape = image.reduced[0].coarse->shape;
    if (x < 0 || y < 0 || x >= shape.width || y >= shape.height) return 3.25;
    return std::min(16, (tensor[shape.index(x, y, bin)] + 32) / 64) / 4.0;
  }
  // Mean of a template drawn at `middle` and shifted to an anchor.
  double mean(const TemplateView& view, const Se3& at_middle, const Eigen::Vector2d& shift) const {
    const int count = std::min<int>(options.points, int(view.points.size()));
    const int bins = image.reduced[0].coarse->shape.bins;
    double sum = 0;
    for (int i = 0; i < count; ++i) {
      const ModelPoint& p = view.points[std::size_t(i) * view.points.size() / count];
      const Eigen::Vector3d point = at_middle * Eigen::Vector3d(p.x_m, p.y_m, p.z_m);
      const Eigen::Vector3d ahead =
          point + 1e-6 * (at_middle.rotation * Eigen::Vector3d(p.tx, p.ty, p.tz));
      const Eigen::Vector2d pixel = project(image.reduced[0].camera, point),
                            along = project(image.reduced[0].camera, ahead) - pixel;
      const double theta = std::fmod(std::atan2(along.y(), along.x()) + 2 * pi, pi);
      sum += value(int(std::lround(pixel.x()) + shift.x()), int(std::lround(pixel.y()) + shift.y()),
                   int(std::lround(theta * bins / pi)) % bins);
    }
    return sum / count;
  }
  // The best mean over the anchors of one region.
  double best(const TemplateView& view, double turn, double distance, int x0, int y0, int columns,
              int rows) const {
    const int step = options.anchor_step;
    const Eigen::Vector2d middle(std::round(x0 + 0.5 * step * (columns - 1)),
                                 std::round(y0 + 0.5 * step * (rows - 1)));
    const Se3 pose = place_template(set, view, turn, distance, middle, image.reduced[0].camera);
    double lowest = 1e9;
    for (int r = 0; r < rows; ++r)
      for (int c = 0; c < columns; ++c)
        lowest = std::min(lowest,
                          mean(view, pose, Eigen::Vector2d(x0 + step * c, y0 + step * r) - middle));
    return lowest;
  }
};

TEST(CoarseScan, SearchesEveryScaleAsASetOfThatScaleAlone) {
  const auto backend = make_cpu_backend(2);
  const TemplateSet set = part_templates("l_bracket", 1, 0.12, 0.6, *backend);
  const std::vector<DistanceRange> scales = distance_scales(set.options);
  ASSERT_EQ(scales.size(), 2u);
  Random random = test_random();
  std::vector<EdgePoint> edges;
  for (int i = 0; i < 2000; ++i)
    edges.push_back({float(random.uniform(0, 319)), float(random.uniform(0, 239)),
                     float(random.uniform(0, pi)), 1});
  ObjectView image = view_of_edges(edges, small_camera(), 1, *backend);
  add_tensors(image, {&set, 1}, *backend, {});
  ASSERT_EQ(image.reduced.size(), 2u);
  EXPECT_EQ(level_of_scale(set, 0, image), 1u);  // the near scale on the smaller tensor
  EXPECT_EQ(level_of_scale(set, 1, image), 0u);
  ScanOptions options;
  options.num_kept = 300;
  std::span<const ScanHit> hits;
  const std::vector<ScanHit> all = coarse_scan(set, image, *backend, options);
  hits = all;
  ScanOptions of_one = options;
  of_one.num_kept = int(share_of_scale(300, set));
  for (int scale = 0; scale < 2; ++scale) {
    TemplateSet alone = set;
    alone.options.distance_min_m = scales[std::size_t(scale)].min_m;
    alone.options.distance_max_m = scales[std::size_t(scale)].max_m;
    ObjectView level = image;
    level.reduced = {image.reduced[level_of_scale(set, scale, image)]};
    const std::vector<ScanHit> expected = coarse_scan(alone, level, *backend, of_one);
    ASSERT_GE(hits.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(hits[i].scale, scale);
      EXPECT_EQ(hits[i].rank, expected[i].rank);
      EXPECT_EQ(hits[i].pose.world_from_object.translation_m,
                expected[i].pose.world_from_object.translation_m);
    }
    hits = hits.subspan(expected.size());
  }
  EXPECT_TRUE(hits.empty());
}

TEST(CoarseScan, EqualsBruteForceOverAllPlaces) {
  const auto backend = make_cpu_backend(2);
  TemplateSet set = part_templates("bearing_block", 1, 0.3, 0.33, *backend);
  set.options.in_plane_steps = 5;
  set.views.resize(4);
  const Camera camera{61, 45, 150, 150, 30, 22, {}};
  Random random = test_random();
  std::vector<EdgePoint> edges;
  for (int i = 0; i < 150; ++i)
    edges.push_back({float(random.uniform(0, 60)), float(random.uniform(0, 44)),
                     float(random.uniform(0, pi)), 1});
  const ObjectView image = view_of_edges(edges, camera, 1, *backend);
  ScanOptions options;  // 21 x 15 anchors: two regions by two, of different sizes
  options.points = options.quick_points = 20;  // so the first pass judges as the second
  options.anchor_step = 3;
  options.region_columns = 12;
  options.region_rows = 9;
  options.num_kept = 4 * 7;
  const BruteForce brute{set, image, options};
  const std::vector<ScanHit> hits = coarse_scan(set, image, *backend, options);
  ASSERT_EQ(hits.size(), 4u * 7u);
  std::size_t hit = 0;
  for (const auto& [y0, rows] : {std::pair{0, 9}, {27, 6}})
    for (const auto& [x0, columns] : {std::pair{0, 12}, {36, 9}}) {
      std::vector<double> ranks;
      for (const TemplateView& view : set.views)
        for (int turn = 0; turn < 5; ++turn)
          for (double distance : template_distances_m(set.options))
            ranks.push_back(brute.best(view, 2 * pi / 5 * turn, distance, x0, y0, columns, rows) *
                            std::pow(distance, 0.25));
      std::ranges::sort(ranks);
      for (int kept = 0; kept < 7; ++kept, ++hit) {
        EXPECT_NEAR(hits[hit].rank, ranks[kept], 0.026)
            << "one point that rounds the other way is 0.25 / 20";
        const Eigen::Vector2d at =
            project(camera, hits[hit].pose.world_from_object * set.model.center_m);
        EXPECT_GE(at.x(), x0 - 1e-6);
        EXPECT_LE(at.x(), x0 + 3 * (columns - 1) + 1e-6);
        EXPECT_GE(at.y(), y0 - 1e-6);
        EXPECT_LE(at.y(), y0 + 3 * (rows - 1) + 1e-6);
        EXPECT_LT(
            std::abs(std::remainder(at.x() - x0, 3)) + std::abs(std::remainder(at.y() - y0, 3)),
            1e-6);
      }
    }
}

// Where the template of a hit was drawn for the very anchor, the hit's pose has the hit's value.
TEST(ScanMeanPx, IsThatOfAHit) {
  const auto backend = make_cpu_backend(2);
  const TemplateSet set = part_templates("l_bracket", 3, 0.34, 0.36, *backend);
  const Se3 truth{so3_exp({0.6, 0.3, 0.2}), {0, 0, 0.35}};
  const ObjectView view =
      view_of_edges(ideal_edges(part_model("l_bracket", 2e-4), small_camera(), truth, *backend),
                    small_camera(), 2, *backend);
  ScanOptions options;
  options.region_columns = options.region_rows = 1;
  options.anchor_step = 4;
  options.num_kept = 1;
  double worst = 0;
  for (const ScanHit& hit : coarse_scan(set, view, *backend, options))
    worst =
        std::max(worst, std::abs(hit.mean_px - scan_mean_px(set, view, hit.pose.world_from_object,
                                                            *backend, options)));
  // The points of a template are those visible from its viewpoint far away.
  EXPECT_LT(worst, 0.2);
  EXPECT_LT(scan_mean_px(set, view, truth, *backend, options), 0.7);
  EXPECT_GT(scan_mean_px(set, view, {truth.rotation, {0, 0.04, 0.35}}, *backend, options), 1);
  EXPECT_EQ(scan_mean_px(set, view, {truth.rotation, {0, 0, -1}}, *backend, options), 4);
}

}  // namespace
}  // namespace edgescout::test
