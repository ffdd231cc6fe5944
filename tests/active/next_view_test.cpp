// The information that is expected of a view.
#include "host/active/next_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "tests/active/plan.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

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
                                     reference = view_information(
                                         t.problem(*make_reference_backend()), t.options);
  for (std::size_t v = 0; v < fast.size(); ++v)
    EXPECT_NEAR(fast[v].information, reference[v].information,
                1e-3 * (1 + reference[v].information));
  if (vulkan_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  const std::vector<ViewInformation> device =
      view_information(t.problem(*make_vulkan_backend(0)), t.options);
  for (std::size_t v = 0; v < fast.size(); ++v)
    EXPECT_NEAR(fast[v].information, device[v].information, 5e-3 * (1 + fast[v].information));
}

// A limit is asked between two blocks of views.
TEST(ViewInformation, EndsEarlyAtALimit) {
  Plan t;
  const std::vector<ViewInformation> whole = t.information();
  int asked = 0, most = 1000;
  const TimeLimit limit{{}, [&] { return ++asked > most; }};
  NextViewProblem problem = t.problem(*t.backend);
  problem.scene.limit = &limit;
  const std::vector<ViewInformation> unhurried = view_information(problem, t.options);
  for (std::size_t v = 0; v < whole.size(); ++v)
    EXPECT_EQ(unhurried[v].information, whole[v].information);
  asked = 0, most = 1;  // the first block has a view for each of two threads
  const std::vector<ViewInformation> cut = view_information(problem, t.options);
  EXPECT_EQ(cut[1].information, whole[1].information);
  EXPECT_EQ(cut[2].information, whole[2].information);
  for (std::size_t v = 3; v < whole.size(); ++v) EXPECT_EQ(cut[v].information, 0);
}

// So many candidates that the maps of all views do not fit at once: the result of the blocks is the
// same as that of each view alone.
TEST(ViewInformation, OfManyViewsIsThatOfEachAlone) {
  Plan t;
  const std::vector<Detection> few = t.candidates;
  for (std::size_t i = 0; t.candidates.size() < 300; ++i) {
    t.candidates.push_back(few[i % few.size()]);
    t.candidates.back().world_from_object.translation_m.x() += 1e-4 * static_cast<double>(i);
  }
  t.draw_combinations();
  const std::vector<ViewInformation> all = t.information();
  for (const int alone : {1, 9}) {
    t.closed.assign(t.views.size(), 1);
    t.closed[static_cast<std::size_t>(alone)] = 0;
    EXPECT_GT(all[static_cast<std::size_t>(alone)].information, 0);
    EXPECT_EQ(t.information()[static_cast<std::size_t>(alone)].information,
              all[static_cast<std::size_t>(alone)].information)
        << alone;
  }
}

// A large object without candidates changes nothing: what the small ones hide depends on their own
// size.
TEST(ViewInformation, DoesNotDependOnObjectsWithoutCandidates) {
  Plan t;
  const std::vector<ViewInformation> before = t.information();
  Mesh large = make_part("l_bracket").mesh;
  for (Eigen::Vector3d& vertex : large.vertices_m) vertex *= 20;
  large.diameter_m *= 20;
  t.models.push_back(make_edge_model(large));
  t.tables.push_back(make_template_table(t.models.back(), 5, *t.backend, {3, 300}));
  const std::vector<ViewInformation> after = t.information();
  for (std::size_t v = 1; v < t.views.size(); ++v) {
    EXPECT_GT(before[v].information, 0);
    EXPECT_EQ(after[v].information, before[v].information) << v;
  }
  t.options.tolerance = 2;
  std::size_t differing = 0;
  const std::vector<ViewInformation> transparent = t.information();
  for (std::size_t v = 1; v < t.views.size(); ++v)
    differing += transparent[v].information != before[v].information;
  EXPECT_GT(differing, 0u) << "nothing was hidden in the first place";
}

// Nothing to distinguish: one particle, or all candidates in every combination.
TEST(ViewInformation, IsZeroWhereNothingIsUncertain) {
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
  // None sees anything: a warning is logged, and the first open view is chosen.
  for (Se3& view : t.views) view = look_at({inverse(view).translation_m.x(), 0, 0.5}, {0, 0, 5});
  const CollectedLog log;
  const std::vector<ViewInformation> unseeing = t.information();
  for (const ViewInformation& v : unseeing) EXPECT_EQ(v.information, 0);
  ASSERT_EQ(log.messages.size(), 1u);
  EXPECT_NE(log.messages[0].second.find("no view promises"), std::string::npos);
  EXPECT_EQ(best_view(unseeing), 1);
  // Of equals the one of most share.
  std::vector<ViewInformation> equal(4, {true, 0, 0.5});
  equal[2].share = 0.9, equal[3] = {false, 0, 1};
  EXPECT_EQ(best_view(equal), 2);
  equal[1].information = 1e-6;
  EXPECT_EQ(best_view(equal), 1);
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

// All candidates at one place: each combination has one of them or none, and there is still some
// information.
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

TEST(ViewInformation, PrefersTheViewThatDistinguishesPoses) {
  Plan t(1);
  t.candidates.clear();
  // Two brackets that differ by a shift along the line of sight of view `front`, hardly visible
  // from there.
  const Se3 front = look_at({0.6, 0, 0.03}, {0, 0, 0.03}),
            side = look_at({0, 0.6, 0.03}, {0, 0, 0.03});
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

// Cameras on rings of 35 and 70 degrees: a line of sight is free with a power of the elevation's
// sine.
TEST(ViewInformation, FallsWhereTheUnknownMayHideMore) {
  Plan t;
  const std::vector<ViewInformation> free = t.information();
  t.options.visibility_exponent = 2;
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
  // A turned world changes nothing: the direction above follows from the views.
  const Se3 turned_from_world{Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7).normalized(), {1, -2, 3}};
  for (Se3& view : t.views) view = view * inverse(turned_from_world);
  for (ObjectView& view : t.real)
    view.camera_from_world = view.camera_from_world * inverse(turned_from_world);
  for (Detection& c : t.candidates) c.world_from_object = turned_from_world * c.world_from_object;
  for (Particle& p : t.particles) p.world_from_object = turned_from_world * p.world_from_object;
  const std::vector<ViewInformation> turned = t.information();
  for (std::size_t v = 1; v < views.size(); ++v)
    EXPECT_NEAR(turned[v].information, views[v].information, 0.02 * views[v].information) << v;
  // The paper's own formula and the other strategies do not use it.
  const auto does_not_matter = [&] {
    t.options.visibility_exponent = 2;
    const std::vector<ViewInformation> some = t.information();
    t.options.visibility_exponent = 0;
    const std::vector<ViewInformation> all = t.information();
    for (std::size_t v = 1; v < views.size(); ++v)
      EXPECT_EQ(some[v].information, all[v].information);
  };
  t.options.use_paper_formula = true;
  does_not_matter();
  t.options.strategy = Strategy::Disocclusion;
  does_not_matter();
}

// Real views count in Upsilon alone there: weights that follow from them would count them twice.
TEST(ViewInformation, OfThePapersFormulaWeighsAllParticlesAlike) {
  Plan t;
  t.options.use_paper_formula = true;
  for (std::size_t i = 0; i < t.particles.size(); ++i) t.particles[i].upsilon_px2 = 0.5 * double(i);
  const std::vector<ViewInformation> alike = t.information();
  for (std::size_t i = 0; i < t.particles.size(); ++i) t.particles[i].log_weight = -0.1 * double(i);
  const std::vector<ViewInformation> weighed = t.information();
  for (std::size_t v = 1; v < alike.size(); ++v) {
    EXPECT_GT(alike[v].information, 0);
    EXPECT_EQ(weighed[v].information, alike[v].information);
  }
}

// By default an image without edges has shown no point. In the paper's formula every point that
// projects into it was seen.
TEST(ViewInformation, UsesTheImagesEdgesUnlikeThePaper) {
  const auto views_with = [](const auto& change, bool edgeless) {
    Plan t;
    change(t.options);
    if (edgeless) t.real[0].edges = std::make_shared<EdgeIndex>(std::vector<EdgePoint>{}, 480, 360);
    std::vector<double> information;
    for (const ViewInformation& view : t.information()) information.push_back(view.information);
    return information;
  };
  const auto by_default = [](NextViewOptions&) {};
  const auto use_paper_formula = [](NextViewOptions& o) { o.use_paper_formula = true; };
  const auto dis = [](NextViewOptions& o) { o.strategy = Strategy::Disocclusion; };
  EXPECT_NE(views_with(by_default, false), views_with(by_default, true));
  EXPECT_EQ(views_with(use_paper_formula, false), views_with(use_paper_formula, true));
  EXPECT_EQ(views_with(dis, false), views_with(dis, true));
}

// The nearest real view, by the angle at the common point, has given a part of the information.
TEST(ViewInformation, FallsNearARealView) {
  Plan t;
  t.real = {looked_from(t.views[0]), looked_from(t.views[3])};
  t.closed[3] = 1;
  const auto direction = [&](std::size_t v) {
    return Eigen::Vector3d(
        (inverse(t.views[v]).translation_m - Eigen::Vector3d(0, 0, 0.02)).normalized());
  };
  const std::vector<ViewInformation> all_new = t.information();
  t.options.view_correlation_angle_rad = 0.8;
  const std::vector<ViewInformation> views = t.information();
  double least = 1, most = 0;
  for (std::size_t v = 1; v < views.size(); ++v) {
    if (v == 3) continue;
    const double cosine = std::max(direction(v).dot(direction(0)), direction(v).dot(direction(3)));
    const double share = 1 - std::exp(-std::pow(std::acos(cosine) / 0.8, 2));
    EXPECT_NEAR(views[v].information, all_new[v].information * share, 1e-6) << v;
    EXPECT_NEAR(views[v].share, share, 1e-9) << v;
    EXPECT_EQ(all_new[v].share, 1);
    least = std::min(least, share), most = std::max(most, share);
  }
  EXPECT_LT(least, 0.8);
  EXPECT_GT(most, 0.9);
  t.options.strategy = Strategy::Disocclusion;
  const std::vector<ViewInformation> some = t.information();
  t.options.view_correlation_angle_rad = 0;
  const std::vector<ViewInformation> all = t.information();
  for (std::size_t v = 1; v < views.size(); ++v) EXPECT_EQ(some[v].information, all[v].information);
}

// The exploration bonus is paid where no view has looked yet, independent of the candidates.
TEST(ViewInformation, HasAnExplorationBonusFarFromRealViews) {
  Plan t;
  t.options.visibility_exponent = 0.5;
  const std::vector<ViewInformation> known = t.information();
  t.options.exploration_bonus_nats = 0.7;
  t.options.exploration_correlation_angle_rad = 1.2;
  const std::vector<ViewInformation> views = t.information();
  const auto direction = [&](const Se3& view) {
    return Eigen::Vector3d(
        (inverse(view).translation_m - Eigen::Vector3d(0, 0, 0.02)).normalized());
  };
  for (std::size_t v = 1; v < views.size(); ++v) {
    const Eigen::Vector3d here = direction(t.views[v]);
    const double angle = std::acos(std::min(1.0, here.dot(direction(t.views[0]))));
    EXPECT_EQ(known[v].discovery, 0);
    EXPECT_EQ(views[v].information, known[v].information);
    EXPECT_NEAR(views[v].discovery,
                0.7 * std::sqrt(here.z()) * (1 - std::exp(-std::pow(angle / 1.2, 2))), 1e-6);
    EXPECT_DOUBLE_EQ(views[v].value(), views[v].information + views[v].discovery);
  }
  EXPECT_EQ(views[0].discovery, 0) << "taken";
  // Ranks, draws and the paper's own formula have no nats to add.
  for (const Strategy strategy : {Strategy::Disocclusion, Strategy::Random, Strategy::Fixed}) {
    t.options.strategy = strategy;
    for (const ViewInformation& view : t.information()) EXPECT_EQ(view.discovery, 0);
  }
  t.options.strategy = Strategy::Information;
  t.options.use_paper_formula = true;
  for (const ViewInformation& view : t.information()) EXPECT_EQ(view.discovery, 0);
}

TEST(ViewInformation, OfNoViewsIsNone) {
  Plan t(2);
  t.options.visibility_exponent = 1;
  t.views.clear();
  t.closed.clear();
  EXPECT_TRUE(t.information().empty());
}

TEST(ViewInformation, HasNoDirectionAboveWhereCamerasStandAllAround) {
  Plan t(2);
  const Se3 upside_down{
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX())),
      {0, 0, 0.04}};
  for (std::size_t v = 0, n = t.views.size(); v < n; ++v)
    t.views.push_back(t.views[v] * upside_down);
  t.closed.resize(t.views.size(), 0);
  const std::vector<ViewInformation> free = t.information();
  t.options.visibility_exponent = 1;
  const std::vector<ViewInformation> views = t.information();
  for (std::size_t v = 1; v < views.size(); ++v)
    EXPECT_EQ(views[v].information, free[v].information) << v;
}

TEST(NextViewOptions, AllowsNoMotionCostWhereInformationIsNotInNats) {
  NextViewOptions options;
  options.motion_cost_per_rad = 1;
  EXPECT_NO_THROW(options.validate());
  options.strategy = Strategy::Disocclusion;
  expect_input_error([&] { options.validate(); }, {"next_view.radian_cost"});
}

TEST(ViewInformation, CountsMotionAndSkipsUnreachableViews) {
  Plan t;
  t.options.motion_cost_per_m = 2;
  t.options.motion_cost_per_rad = 3;
  t.options.reachable = [](int view) { return view % 2 == 1; };
  const std::vector<ViewInformation> views = t.information();
  for (std::size_t v = 1; v < views.size(); ++v) {
    EXPECT_EQ(views[v].open, v % 2 == 1);
    if (!views[v].open) continue;
    const double way =
                     (inverse(t.views[v]).translation_m - inverse(t.views[0]).translation_m).norm(),
                 turn = angle_between_rad(t.views[v], t.views[0]);
    EXPECT_NEAR(views[v].motion_cost, 2 * way + 3 * turn, 1e-9);
    EXPECT_NEAR(views[v].value(), views[v].information - views[v].motion_cost, 1e-12);
  }
  t.options.motion_cost_per_m = 1e6;  // then the nearest reachable one is best, whatever it shows
  const int best = *best_view(t.information());
  for (std::size_t v = 1; v < t.views.size(); v += 2)
    EXPECT_LE(
        (inverse(t.views[best]).translation_m - inverse(t.views[0]).translation_m).norm(),
        (inverse(t.views[v]).translation_m - inverse(t.views[0]).translation_m).norm() + 1e-9);
  t.options.reachable = [](int) { return false; };
  EXPECT_FALSE(best_view(t.information()).has_value());
}

}  // namespace
}  // namespace edgescout::test
