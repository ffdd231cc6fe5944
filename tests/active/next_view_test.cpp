#include "host/active/next_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "host/active/candidate_scene.h"
#include "host/active/combinations.h"
#include "host/active/seen_points.h"
#include "host/active/views.h"
#include "tests/active/rendered_scene.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/register/linear_tensor.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

Camera test_camera() { return {480, 360, 600, 600, 239.5, 179.5, {}}; }

RegisterView looked_from(const Se3& camera_from_world) {
  RegisterView view;
  view.camera = test_camera();
  view.camera_from_world = camera_from_world;
  return view;
}

// Some parts about the origin as candidates and particles, cameras around them.
struct Plan {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  std::vector<EdgeModel> models;
  std::vector<TemplateTable> tables;
  std::vector<Se3> views;
  std::vector<RegisterView> real;
  std::vector<Detection> candidates;
  std::vector<Particle> particles;
  BitMatrix combinations;
  std::vector<char> closed;
  NextViewOptions options;

  explicit Plan(int count = 6) {
    options.free_sight = 0;
    for (const char* part : {"l_bracket", "bearing_block"})
      models.push_back(make_edge_model(make_part(part).mesh));
    for (const EdgeModel& model : models)
      tables.push_back(make_template_table(model, 0.5, *backend, {3, 300}));
    views = hemisphere_views({{0, 0, 0.02}, 0.5, {35, 70}, 10});
    real = {looked_from(views[0])};
    closed.assign(views.size(), 0);
    closed[0] = 1;
    Random random(7);
    for (int i = 0; i < count; ++i) {
      Detection c;
      c.object = i % 2;
      c.world_from_object = {random.rotation(), {0.07 * (i % 3) - 0.07, 0.08 * (i / 3) - 0.04, 0.03}};
      c.psi = 0.6 + 0.05 * i;
      c.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
      candidates.push_back(c);
    }
    particles = draw_particles(models, candidates, 24, {0.02, 0.1}, Random(3));
    draw_combinations();
  }
  void draw_combinations() {
    std::vector<Hypothesis> poses;
    std::vector<double> psi;
    for (const Detection& c : candidates)
      poses.push_back({c.object, c.world_from_object}), psi.push_back(c.psi);
    combinations =
        sample_combinations(psi, plausible_pairs(models, poses, 0.002, backend->threads()), {60, 1, 1});
  }
  Planning planning() const {
    return {models, tables, test_camera(), views, closed, real, candidates, &combinations, particles};
  }
  std::vector<ViewInformation> information() { return view_information(planning(), *backend, options); }
};

// The maps against brute force: every pixel's distance to the candidate's visible edge points, and the
// surface in a picture of the whole image.
TEST(CandidateScene, HoldsEdgesAndSurfacesOfEveryView) {
  Plan t(3);
  const Camera camera = scaled(test_camera(), 0.25);
  const CandidateScene scene =
      draw_candidates(t.models, t.candidates, camera, t.views, *t.backend, t.options.visibility);
  ASSERT_EQ(scene.maps.size(), t.views.size() * 3);
  for (std::size_t v = 0; v < t.views.size(); v += 3) {
    const ChamferView seen = scene.seen_from(v);
    for (std::size_t c = 0; c < 3; ++c) {
      const Se3 pose = t.views[v] * t.candidates[c].world_from_object;
      const EdgeModel& model = t.models[t.candidates[c].object];
      const std::vector<ModelPoint> points =
          visible_edges(model, std::span(&pose, 1), *t.backend, t.options.visibility)[0];
      const DepthJob whole{to_pose(pose), intrinsics_of(camera)};
      std::vector<float> depth(std::size_t(camera.width) * camera.height);
      t.backend->depth_raster(model.triangle_mesh(), std::span(&whole, 1), camera.width, camera.height,
                              depth);
      const CandidateMap& map = seen.candidates[c];
      int covered = 0, differing = 0;
      for (int y = 0; y < camera.height; ++y)
        for (int x = 0; x < camera.width; ++x) {
          double least = 1e9;
          for (const ModelPoint& p : points)
            least = std::min(
                least, (project(camera, pose * Eigen::Vector3d(p.x_m, p.y_m, p.z_m)) - Eigen::Vector2d(x, y))
                           .norm());
          const float here = depth[std::size_t(y) * camera.width + x];
          if (!map.window.contains(x, y)) {
            EXPECT_GT(least, 15);
            EXPECT_EQ(here, DEPTH_EMPTY);
            continue;
          }
          const std::size_t pixel = map.first_pixel + map.window.index(x, y);
          EXPECT_NEAR(chamfer_steps(seen.nearest[pixel]) / 16.0, std::min(least, 255 / 16.0), 0.16);
          covered += here != DEPTH_EMPTY;
          differing += (here == DEPTH_EMPTY) != (seen.surface_m[pixel] == DEPTH_EMPTY) ||
                       (here != DEPTH_EMPTY && std::abs(here - seen.surface_m[pixel]) > 1e-4f);
        }
      EXPECT_GT(covered, 100);
      EXPECT_LE(differing, covered / 50);  // pixel centres on an edge may fall on either side
    }
  }
}

TEST(SeenPoints, CountsWhatProjectsIntoTheImages) {
  Plan t(2);
  const Se3& world_from_object = t.candidates[0].world_from_object;
  const TemplateTable& table = t.tables[0];
  const SeenPoints none = seen_in(table, world_from_object, {}, 4);
  EXPECT_EQ(none.count, 0u);
  const std::vector<RegisterView> two{looked_from(t.views[0]), looked_from(t.views[4])};
  const SeenPoints seen =
      seen_in(table, world_from_object, two, 4);  // no edge index: inside the image is enough
  std::vector<char> expected(table.total, 0);
  for (const RegisterView& view : two)
    for (const TemplateTablePoint& p : table.seen_from(view.camera_from_world * world_from_object)) {
      const Eigen::Vector2d at =
          project(view.camera, view.camera_from_world * world_from_object *
                                   Eigen::Vector3d(p.point.x_m, p.point.y_m, p.point.z_m));
      if (at.x() > -0.5 && at.y() > -0.5 && at.x() < 479.5 && at.y() < 359.5) expected[p.id] = 1;
    }
  EXPECT_EQ(seen.by_id, expected);
  EXPECT_EQ(seen.count, std::uint32_t(std::ranges::count(expected, char(1))));
  EXPECT_GT(seen.count, 50u);
  // In a third view those are not fresh, the others are.
  const Se3 third = t.views[7] * world_from_object;
  for (const ParticlePoint& point : showing_points(table, third, test_camera(), none))
    EXPECT_EQ(point.fresh, 1u);
  std::size_t fresh = 0, new_ids = 0;
  for (const ParticlePoint& point : showing_points(table, third, test_camera(), seen)) fresh += point.fresh;
  for (const TemplateTablePoint& p : table.seen_from(third)) new_ids += !expected[p.id];
  EXPECT_EQ(fresh, new_ids);
  EXPECT_GT(fresh, 0u);
}

// An image without edges has shown nothing; one with edges everywhere along the template has.
TEST(SeenPoints, AsksTheImageWhetherAnEdgeIsThere) {
  Plan t(1);
  const Se3& world_from_object = t.candidates[0].world_from_object;
  RegisterView view = looked_from(t.views[0]);
  const Se3 camera_from_object = view.camera_from_world * world_from_object;
  std::vector<EdgePoint> edges;
  view.edges = std::make_shared<EdgeIndex>(edges, 480, 360);
  EXPECT_EQ(seen_in(t.tables[0], world_from_object, std::span(&view, 1), 4).count, 0u);
  const std::uint32_t all = seen_in(t.tables[0], world_from_object, std::span(&view, 1), 0).count;
  const double middle = project(test_camera(), camera_from_object * t.models[0].center_m).x();
  for (const TemplateTablePoint& p : t.tables[0].seen_from(camera_from_object)) {
    const Landing at = land({600, 600, 239.5, 179.5}, camera_from_object, p.point);
    if (at.u < middle) edges.push_back({float(at.u) + 1, float(at.v), float(at.theta), 1});
  }
  view.edges = std::make_shared<EdgeIndex>(edges, 480, 360);
  const std::uint32_t matched = seen_in(t.tables[0], world_from_object, std::span(&view, 1), 4).count;
  EXPECT_GE(matched, edges.size());
  EXPECT_LT(matched, all);
  for (EdgePoint& edge : edges) edge.theta_rad = float(std::fmod(edge.theta_rad + 1.5, std::numbers::pi));
  view.edges = std::make_shared<EdgeIndex>(edges, 480, 360);
  EXPECT_LT(seen_in(t.tables[0], world_from_object, std::span(&view, 1), 4).count, matched / 2);
}

TEST(ViewInformation, IsMutualInformationOfEveryOpenView) {
  Plan t;
  const std::vector<ViewInformation> views = t.information();
  ASSERT_EQ(views.size(), t.views.size());
  EXPECT_FALSE(views[0].open);
  EXPECT_EQ(views[0].information, 0);
  double least = 9, most = 0;
  for (std::size_t v = 1; v < views.size(); ++v) {
    EXPECT_TRUE(views[v].open);
    EXPECT_GT(views[v].information, 0);
    EXPECT_LE(views[v].information, std::log(24.0));
    least = std::min(least, views[v].information), most = std::max(most, views[v].information);
  }
  EXPECT_GT(most, 1.02 * least);
  EXPECT_EQ(views[*best_view(views)].information, most);
}

TEST(ViewInformation, IsTheSameOnEveryDevice) {
  Plan t;
  const std::vector<ViewInformation> fast = t.information(),
                                     reference =
                                         view_information(t.planning(), *make_reference_backend(), t.options);
  for (std::size_t v = 0; v < fast.size(); ++v)
    EXPECT_NEAR(fast[v].information, reference[v].information, 1e-3 * (1 + reference[v].information));
  if (vulkan_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  const std::vector<ViewInformation> device =
      view_information(t.planning(), *make_vulkan_backend(0), t.options);
  for (std::size_t v = 0; v < fast.size(); ++v)
    EXPECT_NEAR(fast[v].information, device[v].information, 5e-3 * (1 + fast[v].information));
}

// Nothing to tell apart: one particle, or all candidates in every combination.
TEST(ViewInformation, IsZeroWhereNothingIsOpen) {
  Plan t;
  t.particles.resize(1);
  for (const ViewInformation& v : t.information()) EXPECT_NEAR(v.information, 0, 1e-9);
  Plan sure;
  sure.combinations = BitMatrix(10, sure.candidates.size());
  for (std::size_t j = 0; j < 10; ++j)
    for (std::size_t c = 0; c < sure.candidates.size(); ++c) sure.combinations.set(j, c);
  for (const ViewInformation& v : sure.information()) EXPECT_NEAR(v.information, 0, 1e-9);
}

TEST(ViewInformation, OfViewsThatSeeNothingIsZero) {
  Plan t;
  t.views[3] = look_at({0, 0, 0.5}, {0, 0, 2});    // away
  t.views[4] = look_at({3, 0, 0.5}, {3, 3, 0.5});  // elsewhere
  const std::vector<ViewInformation> views = t.information();
  EXPECT_TRUE(views[3].open);
  EXPECT_EQ(views[3].information, 0);
  EXPECT_EQ(views[4].information, 0);
  EXPECT_GT(views[5].information, 0);
  // None sees anything: said aloud, and the first open one is as good as any.
  for (Se3& view : t.views) view = look_at({inverse(view).translation_m.x(), 0, 0.5}, {0, 0, 5});
  const CollectedLog log;
  const std::vector<ViewInformation> blind = t.information();
  for (const ViewInformation& v : blind) EXPECT_EQ(v.information, 0);
  ASSERT_EQ(log.messages.size(), 1u);
  EXPECT_NE(log.messages[0].second.find("no view promises"), std::string::npos);
  EXPECT_EQ(best_view(blind), 1);
}

TEST(ViewInformation, WithoutCandidatesOrParticlesIsZero) {
  for (const int missing : {0, 1, 2, 3}) {
    Plan t;
    if (missing == 0) t.candidates.clear(), t.combinations = {};
    if (missing == 1) t.particles.clear();
    if (missing == 2)
      for (Particle& p : t.particles) p.log_weight = -std::numeric_limits<double>::infinity();
    if (missing == 3) t.combinations = {};
    const CollectedLog log;
    for (const ViewInformation& v : t.information()) EXPECT_EQ(v.information, 0);
    EXPECT_EQ(log.messages.size(), 1u);
  }
}

// All candidates at one place: each combination is one of them or none, and there is still something to
// learn.
TEST(ViewInformation, WorksWhereAllPairsAreImplausible) {
  Plan t;
  for (Detection& c : t.candidates) c.world_from_object.translation_m = {0, 0, 0.03};
  t.particles = draw_particles(t.models, t.candidates, 24, {0.02, 0.1}, Random(3));
  t.draw_combinations();
  for (std::size_t j = 0; j < t.combinations.rows; ++j) {
    int members = 0;
    for (std::size_t c = 0; c < t.candidates.size(); ++c) members += t.combinations.has(j, c);
    ASSERT_LE(members, 1);
  }
  const std::vector<ViewInformation> views = t.information();
  for (std::size_t v = 1; v < views.size(); ++v) EXPECT_GT(views[v].information, 0);
}

TEST(ViewInformation, PrefersTheViewThatTellsHypothesesApart) {
  Plan t(1);
  t.candidates.clear();
  // Two brackets that differ by a shift along the line of sight of view `front`, hardly visible from there.
  const Se3 front = look_at({0.6, 0, 0.03}, {0, 0, 0.03}), side = look_at({0, 0.6, 0.03}, {0, 0, 0.03});
  for (const double x : {-0.012, 0.012}) {
    Detection c;
    c.world_from_object = {Eigen::Quaterniond(0.9, 0.3, 0.2, 0.1).normalized(), {x, 0, 0.03}};
    c.psi = 0.9;
    t.candidates.push_back(c);
  }
  t.particles = draw_particles(t.models, t.candidates, 2, {0, 0}, Random(3));
  t.draw_combinations();
  t.views = {front, side};
  t.closed = {0, 0};
  t.real = {};
  t.options.reduction = 1;
  t.options.cap_px = 15;
  const std::vector<ViewInformation> views = t.information();
  std::printf("front %.4f, side %.4f nats\n", views[0].information, views[1].information);
  EXPECT_GT(views[1].information, 2 * views[0].information);
}

// Cameras on rings of 35 and 70 degrees: what is unknown leaves a line of sight free with the sine's power,
// whatever the strategy knows besides.
TEST(ViewInformation, IsWorthLessWhereTheUnknownMayHideMore) {
  Plan t;
  const std::vector<ViewInformation> free = t.information();
  t.options.free_sight = 2;
  const std::vector<ViewInformation> views = t.information();
  std::set<double> shares;
  for (std::size_t v = 1; v < views.size(); ++v) {
    const Eigen::Vector3d eye =
        (inverse(t.views[v]).translation_m - Eigen::Vector3d(0, 0, 0.02)).normalized();
    ASSERT_GT(free[v].information, 0);
    EXPECT_NEAR(views[v].information, free[v].information * eye.z() * eye.z(), 1e-9) << v;
    shares.insert(std::round(1e6 * eye.z()));
  }
  EXPECT_EQ(shares.size(), 2u);
  // A turned world changes nothing: what is above follows from the views.
  const Se3 turned_from_world{Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7).normalized(), {1, -2, 3}};
  for (Se3& view : t.views) view = view * inverse(turned_from_world);
  for (RegisterView& view : t.real)
    view.camera_from_world = view.camera_from_world * inverse(turned_from_world);
  for (Detection& c : t.candidates) c.world_from_object = turned_from_world * c.world_from_object;
  for (Particle& p : t.particles) p.world_from_object = turned_from_world * p.world_from_object;
  const std::vector<ViewInformation> turned = t.information();
  for (std::size_t v = 1; v < views.size(); ++v)
    EXPECT_NEAR(turned[v].information, views[v].information, 0.02 * views[v].information) << v;
  // The paper's own formula stays what it is, and other strategies do not imagine what they would see.
  const auto does_not_matter = [&] {
    t.options.free_sight = 2;
    const std::vector<ViewInformation> some = t.information();
    t.options.free_sight = 0;
    const std::vector<ViewInformation> all = t.information();
    for (std::size_t v = 1; v < views.size(); ++v) EXPECT_EQ(some[v].information, all[v].information);
  };
  t.options.literal = true;
  does_not_matter();
  t.options.strategy = Strategy::Disocclusion;
  does_not_matter();
}

TEST(ViewInformation, OfNoViewsIsNone) {
  Plan t(2);
  t.options.free_sight = 1;
  t.views.clear();
  t.closed.clear();
  EXPECT_TRUE(t.information().empty());
}

TEST(ViewInformation, KnowsNoAboveWhereCamerasStandAllAround) {
  Plan t(2);
  const Se3 upside_down{Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX())),
                        {0, 0, 0.04}};
  for (std::size_t v = 0, n = t.views.size(); v < n; ++v) t.views.push_back(t.views[v] * upside_down);
  t.closed.resize(t.views.size(), 0);
  const std::vector<ViewInformation> free = t.information();
  t.options.free_sight = 1;
  const std::vector<ViewInformation> views = t.information();
  for (std::size_t v = 1; v < views.size(); ++v) EXPECT_EQ(views[v].information, free[v].information) << v;
}

TEST(ViewInformation, TakesMotionAndReachIntoAccount) {
  Plan t;
  t.options.motion_cost_per_m = 2;
  t.options.motion_cost_per_rad = 3;
  t.options.reachable = [](int view) { return view % 2 == 1; };
  const std::vector<ViewInformation> views = t.information();
  for (std::size_t v = 1; v < views.size(); ++v) {
    EXPECT_EQ(views[v].open, v % 2 == 1);
    if (!views[v].open) continue;
    const double way = (inverse(t.views[v]).translation_m - inverse(t.views[0]).translation_m).norm(),
                 turn = angle_between_rad(t.views[v], t.views[0]);
    EXPECT_NEAR(views[v].motion_cost, 2 * way + 3 * turn, 1e-9);
    EXPECT_NEAR(views[v].value(), views[v].information - views[v].motion_cost, 1e-12);
  }
  t.options.motion_cost_per_m = 1e6;  // then the nearest reachable one is best, whatever it shows
  const int best = *best_view(t.information());
  for (std::size_t v = 1; v < t.views.size(); v += 2)
    EXPECT_LE((inverse(t.views[best]).translation_m - inverse(t.views[0]).translation_m).norm(),
              (inverse(t.views[v]).translation_m - inverse(t.views[0]).translation_m).norm() + 1e-9);
  t.options.reachable = [](int) { return false; };
  EXPECT_FALSE(best_view(t.information()).has_value());
}

TEST(Disocclusion, SumsNewPointsByPsi) {
  Plan t;
  t.options.strategy = Strategy::Disocclusion;
  const std::vector<ViewInformation> views = t.information();
  for (std::size_t v = 1; v < views.size(); ++v) {
    double expected = 0;
    for (const Detection& c : t.candidates) {
      const TemplateTable& table = t.tables[c.object];
      std::vector<char> seen(table.total, 0);
      for (const TemplateTablePoint& p : table.seen_from(t.views[0] * c.world_from_object))
        seen[p.id] = 1;  // all project into the image
      for (const TemplateTablePoint& p : table.seen_from(t.views[v] * c.world_from_object))
        expected += seen[p.id] ? 0 : c.psi;
    }
    EXPECT_NEAR(views[v].information, expected, 1e-6);
  }
}

TEST(Random, DrawsEveryOpenViewAlike) {
  Plan t(1);
  t.options.strategy = Strategy::Random;
  t.closed[5] = 1;
  std::vector<int> chosen(t.views.size(), 0);
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    t.options.seed = seed;
    ++chosen[*best_view(t.information())];
  }
  EXPECT_EQ(chosen[0] + chosen[5], 0);
  for (std::size_t v = 1; v < chosen.size(); ++v) EXPECT_NEAR(chosen[v], v == 5 ? 0 : 250, 75);
  const std::optional<int> first = best_view(t.information());
  EXPECT_EQ(first, best_view(t.information()));
}

TEST(Fixed, FollowsItsSequence) {
  Plan t(1);
  t.options.strategy = Strategy::Fixed;
  EXPECT_EQ(best_view(t.information()), 1);
  t.options.sequence = {0, 7, 3};
  EXPECT_EQ(best_view(t.information()), 7);
  t.closed[7] = 1;
  EXPECT_EQ(best_view(t.information()), 3);
  t.closed[3] = 1;
  EXPECT_EQ(best_view(t.information()), 1);
}

TEST(Strategies, HaveNames) {
  for (const Strategy s : {Strategy::Information, Strategy::Disocclusion, Strategy::Random, Strategy::Fixed})
    EXPECT_EQ(strategy_from(to_string(s)), s);
  expect_input_error([] { strategy_from("best"); }, {"next_view.strategy", "best", "mi-max"});
  NextViewOptions options;
  options.cap_px = 100;
  expect_input_error([&] { options.validate(); }, {"next_view.cap"});
  options = {};
  options.reduction = 0.5;
  expect_input_error([&] { options.validate(); }, {"next_view.reduction"});
}

}  // namespace
}  // namespace edgescout::test
