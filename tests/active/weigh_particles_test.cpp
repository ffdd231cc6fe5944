#include "host/active/weigh_particles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/active/modes.h"
#include "host/core/pose_error.h"
#include "host/register/pose_classifier.h"
#include "tests/active/rendered_scene.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

constexpr double NO_WEIGHT = -std::numeric_limits<double>::infinity();

Particle weighted(double weight) {
  Particle p;
  p.log_weight = std::log(weight);
  return p;
}

TEST(EffectiveSampleSize, CountsTheWeightsThatMatter) {
  EXPECT_EQ(effective_sample_size({}), 0);
  EXPECT_NEAR(effective_sample_size(std::vector<Particle>(7, weighted(0.2))), 7, 1e-9);
  EXPECT_NEAR(effective_sample_size(std::vector<Particle>{weighted(1), weighted(0), weighted(0)}),
              1, 1e-9);
  EXPECT_NEAR(effective_sample_size(std::vector<Particle>{weighted(3), weighted(1)}), 16.0 / 10,
              1e-9);
  Particle far = weighted(1);
  far.log_weight = -5000;  // exp underflows
  EXPECT_NEAR(effective_sample_size(std::vector<Particle>(3, far)), 3, 1e-9);
}

// Particles around one part, given as ideal edges seen from three sides.
struct IdealScene {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  PartScene part;
  std::vector<EdgeModel> models;
  ParticleOptions options;
  std::vector<double> unseen_px2;
  explicit IdealScene(Random& random)
      : part("l_bracket", 3, random, *backend), models{part.model} {}
  Particle off_by(double distance_m, Random& random) const {
    Vector6d off = Vector6d::Zero();
    off.head<3>() = distance_m * random.direction();
    Particle p;
    p.world_from_object = retract(part.truth, off);
    return p;
  }
  Weighing weigh(std::span<Particle> particles) {
    return weigh_particles({models, part.views, *backend}, particles, unseen_px2, options);
  }
};

// Resamples as a scout does, for a scene of l-brackets.
std::vector<Particle> resampled(const auto& scene, std::span<const Particle> particles, int count,
                                const Random& random) {
  const std::vector<TemplateSet> sets{without_views(make_part("l_bracket"))};
  const std::vector<Mode> modes =
      find_modes(particles, sets, scene.models, scene.options, scene.backend->threads());
  return resample(particles, modes, scene.models, count, scene.options, random);
}

TEST(WeighParticles, FollowsTheSquaredMeansOfAllViews) {
  Random random = test_random();
  IdealScene t(random);
  std::vector<Particle> particles;
  for (double d : {0.0, 0.001, 0.003, 0.006}) particles.push_back(t.off_by(d, random));
  ASSERT_EQ(t.weigh(particles).living, 4u);
  // Oracle: the registration's own mean residual in each view.
  D2coOptions still;
  still.rounds = {{LOSS_HUBER, 1000, 1, 0}};
  double log_weight[4], total = 0;
  for (int i = 0; i < 4; ++i) {
    double upsilon = 0;
    for (const ObjectView& view : t.part.views) {
      const Se3 pose = view.camera_from_world * particles[i].world_from_object;
      const std::vector<ModelPoint> points =
          visible_edges(t.part.model, std::span(&pose, 1), *t.backend, t.options.visibility)[0];
      const TensorShape shape = view.tensor->shape;
      const std::vector<std::uint16_t> tensor = view.tensor->tensor();
      double sum = 0;
      int inside = 0;
      for (const ModelPoint& point : points) {
        const Landing at = land(view.tensor->intrinsics, pose, point);
        if (at.u < -0.5 || at.v < -0.5 || at.u >= view.camera.width - 0.5 ||
            at.v >= view.camera.height - 0.5)
          continue;
        sum += tensor_lookup({tensor, shape, view.tensor->intrinsics}, float(at.u), float(at.v),
                             float(at.theta), nullptr);
        ++inside;
      }
      upsilon += (sum / inside) * (sum / inside);
    }
    EXPECT_NEAR(particles[i].upsilon_px2, upsilon, 0.01 * upsilon + 0.01);
    log_weight[i] = -upsilon / (2 * t.options.sigma_px * t.options.sigma_px);
    total += std::exp(log_weight[i]);
  }
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(std::exp(particles[i].log_weight), std::exp(log_weight[i]) / total, 0.02) << i;
  EXPECT_GT(particles[0].log_weight, particles[3].log_weight + 0.3);
}

TEST(WeighParticles, AViewThatSeesNothingOfAParticleLeavesItsShare) {
  Random random = test_random();
  IdealScene t(random);
  std::vector<Particle> particles;
  for (int i = 0; i < 6; ++i) particles.push_back(t.off_by(0.001 * i, random));
  std::vector<ObjectView> views(t.part.views.begin(), t.part.views.begin() + 1);
  weigh_particles({t.models, views, *t.backend}, particles, t.unseen_px2, t.options);
  std::vector<double> before;
  for (const Particle& p : particles) before.push_back(p.log_weight);
  // A camera that looks the other way sees none of them.
  views.push_back(t.part.views[1]);
  views[1].camera_from_world = Se3{so3_exp({0, 3, 0}), {0, 0, 0}} * views[1].camera_from_world;
  EXPECT_EQ(
      weigh_particles({t.models, views, *t.backend}, particles, t.unseen_px2, t.options).living,
      6u);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(particles[i].log_weight, before[i], 1e-9);
}

// Two views of a part. A distant one sees every particle; a near one sees only particles at the
// part, of which few fit and many do not.
struct HalfSeen {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  std::vector<EdgeModel> models{part_model("l_bracket")};
  std::vector<ObjectView> views;
  std::vector<Particle> particles;  // the first one outside the second view's image
  ParticleOptions options;
  std::vector<double> unseen_px2;

  explicit HalfSeen(Random& random) {
    const Se3 truth{random.rotation(), {1, 2, 0.5}};
    const EdgeModel dense = part_model("l_bracket", 2e-4);
    for (const double distance_m : {1.4, 0.35})
      views.push_back(
          view_of(dense, truth,
                  camera_looking_at(truth.translation_m + Eigen::Vector3d(0, 0, distance_m),
                                    truth.translation_m),
                  *backend));
    options.dead_px = 1000;
    options.sigma_px = 10;
    add(truth, {0.3, 0, 0});
    for (int i = 0; i < 3; ++i) add(truth, 0.001 * random.direction());
    for (int i = 0; i < 20; ++i) add(truth, 0.04 * random.direction());
  }
  void add(const Se3& truth, const Eigen::Vector3d& off_m) {
    particles.emplace_back().world_from_object = {truth.rotation, truth.translation_m + off_m};
  }
  Weighing weigh(std::size_t view_count) {
    return weigh_particles({models, {views.data(), view_count}, *backend}, particles, unseen_px2,
                           options);
  }
};

TEST(WeighParticles, AViewThatSeesOthersLeavesAParticleItsShare) {
  Random random = test_random();
  HalfSeen t(random);
  ASSERT_EQ(t.weigh(1).living, 24u);
  ASSERT_GE(t.particles[0].features[0].points, t.options.min_points);
  const std::vector<Particle> before = t.particles;
  ASSERT_EQ(t.weigh(2).living, 24u);
  ASSERT_LT(t.particles[0].features[1].points, t.options.min_points);
  EXPECT_NEAR(t.particles[0].log_weight, before[0].log_weight, 1e-9);
  EXPECT_GT(t.particles[1].log_weight, before[1].log_weight + 0.2);
  EXPECT_LT(t.particles[4].log_weight, before[4].log_weight - 0.2);
  // Particles that do not fit are removed, and a new one is drawn outside the image: the view
  // counts for it what was fixed before.
  const double ratio = t.particles[0].log_weight - t.particles[1].log_weight;
  t.particles.resize(4);
  t.particles.push_back(before[0]);
  t.weigh(2);
  EXPECT_NEAR(t.particles[0].log_weight - t.particles[1].log_weight, ratio, 1e-9);
  EXPECT_EQ(t.particles[4].log_weight, t.particles[0].log_weight);
}

// A particle that a view does not see keeps its share of the weight over resampling.
TEST(WeighParticles, AnUnseenOneKeepsItsShareOverResampling) {
  Random random = test_random();
  HalfSeen t(random);
  t.options.roughened = {0, 0};
  t.options.min_mode_probability = 0;
  t.options.sigma_px = 40;
  t.weigh(2);
  const Eigen::Vector3d outside_m = t.particles[0].world_from_object.translation_m;
  const auto share = [&] {
    double sum = 0;
    for (const Particle& p : t.particles)
      if ((p.world_from_object.translation_m - outside_m).norm() < 1e-6)
        sum += std::exp(p.log_weight);
    return sum;
  };
  const double before = share();
  EXPECT_GT(before, 0.01);
  for (int round = 0; round < 3; ++round) {
    t.particles = resampled(t, t.particles, 200, random.split(round));
    EXPECT_NEAR(share(), before, 1e-9);
    t.weigh(2);
    EXPECT_NEAR(share(), before, 0.02 * before);
  }
}

// A view that has seen no particle yet changes no weight. Its first particle fixes its mean.
TEST(WeighParticles, AViewFixesItsMeanWhenItSeesTheFirstParticle) {
  Random random = test_random();
  HalfSeen t(random);
  const std::vector<Particle> all = t.particles;
  t.particles = {all[0], all[0]};
  t.particles[1].world_from_object.translation_m.x() += 0.002;
  t.weigh(1);
  const double before = t.particles[0].log_weight;
  t.weigh(2);
  EXPECT_TRUE(std::isnan(t.unseen_px2[1]));
  EXPECT_NEAR(t.particles[0].log_weight, before, 1e-12);
  t.particles.push_back(all[1]);
  t.weigh(2);
  EXPECT_NEAR(t.unseen_px2[1],
              t.particles[2].features[1].mean_px * t.particles[2].features[1].mean_px, 1e-9);
}

// Particles that lose their weight by a view count in its information.
TEST(WeighParticles, GainsInformationFromParticlesThatLoseTheirWeight) {
  Random random = test_random();
  HalfSeen t(random);
  const double all_nats = t.weigh(2).gained_nats;
  const std::vector<Particle> all = t.particles;
  std::vector<double> means;
  for (const Particle& p : all) means.push_back(pool_over_views(p.features).mean_px);
  std::ranges::nth_element(means, means.begin() + 12);
  t.options.dead_px = means[12];  // half of them lose their weight
  t.unseen_px2.clear();
  const Weighing weighing = t.weigh(2);
  EXPECT_EQ(weighing.living, 13u);
  EXPECT_GT(all_nats, 0.05);
  EXPECT_NEAR(weighing.gained_nats, all_nats, 0.1 * all_nats);
  for (std::size_t i = 2; i < 4; ++i)
    EXPECT_NEAR(t.particles[i].log_weight - t.particles[1].log_weight,
                all[i].log_weight - all[1].log_weight, 1e-9);
}

TEST(WeighParticles, MeasuresTheInformationOfTheLastView) {
  Random random = test_random();
  HalfSeen t(random);
  double gained = 0;
  const double first = t.weigh(1).gained_nats;
  for (const Particle& p : t.particles)  // without any view all weigh the same
    gained += std::exp(p.log_weight) * (p.log_weight + std::log(24.0));
  EXPECT_GT(gained, 0.05);
  EXPECT_NEAR(first, gained, 1e-9);
  const std::vector<Particle> before = t.particles;
  const double second = t.weigh(2).gained_nats;
  gained = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    gained +=
        std::exp(t.particles[i].log_weight) * (t.particles[i].log_weight - before[i].log_weight);
  EXPECT_GT(gained, 0.05);
  EXPECT_NEAR(second, gained, 1e-9);
  // A camera that looks the other way gives none.
  t.views.push_back(t.views[1]);
  t.views[2].camera_from_world = Se3{so3_exp({0, 3, 0}), {0, 0, 0}} * t.views[1].camera_from_world;
  EXPECT_NEAR(t.weigh(3).gained_nats, 0, 1e-12);
}

TEST(WeighParticles, DeadParticlesHaveNoWeight) {
  Random random = test_random();
  IdealScene t(random);
  std::vector<Particle> particles{t.off_by(0.001, random), t.off_by(0.001, random),
                                  t.off_by(30, random)};
  particles[1].world_from_object.translation_m.x() = std::nan("");
  EXPECT_EQ(t.weigh(particles).living, 1u);
  EXPECT_NEAR(particles[0].log_weight, 0, 1e-12);
  EXPECT_EQ(particles[1].log_weight, NO_WEIGHT);
  EXPECT_EQ(particles[2].log_weight, NO_WEIGHT);
  particles.erase(particles.begin());
  EXPECT_EQ(t.weigh(particles).living, 0u);
  for (const Particle& p : particles) EXPECT_NEAR(p.log_weight, -std::log(2.0), 1e-12);
}

// Resampling turns weight into number; weighing the same images again must not count them again.
TEST(WeighParticles, CountsNoViewTwiceAfterResampling) {
  Random random = test_random();
  IdealScene t(random);
  t.options.roughened = {0, 0};
  t.options.min_per_mode = 2;
  t.options.sigma_px = 10;
  // Two places, one fitting worse.
  std::vector<Particle> particles;
  for (int i = 0; i < 30; ++i) particles.push_back(t.off_by(i % 3 ? 0.0005 : 0.012, random));
  for (Particle& p : particles)
    if (distance_between_m(p.world_from_object, t.part.truth) > 0.01)
      p.world_from_object = particles[0].world_from_object;
  t.weigh(particles);
  const auto weight_of_truth = [&] {
    double sum = 0;
    for (const Particle& p : particles)
      sum += distance_between_m(p.world_from_object, t.part.truth) < 0.005 ? std::exp(p.log_weight)
                                                                           : 0;
    return sum;
  };
  const double before = weight_of_truth();
  EXPECT_GT(before, 0.7);
  EXPECT_LT(before, 0.9999);
  for (int round = 0; round < 3; ++round) {
    particles = resampled(t, particles, 30, random.split(round));
    ASSERT_EQ(particles.size(), 30u);
    EXPECT_NEAR(weight_of_truth(), before, 1e-9);
    for (Particle& p : particles)
      if (distance_between_m(p.world_from_object, t.part.truth) > 0.005)
        p.world_from_object = particles.back().world_from_object;
    t.weigh(particles);
    EXPECT_NEAR(weight_of_truth(), before, 0.02);
  }
}

// A particle that is drawn after others were resampled gets the weight that it would have had from
// the start.
TEST(WeighParticles, LateParticlesGetTheirShare) {
  Random random = test_random();
  IdealScene t(random);
  t.options.roughened = {0, 0};
  t.options.sigma_px = 10;
  std::vector<Particle> early;
  for (int i = 0; i < 12; ++i) early.push_back(t.off_by(0.002, random));
  const Particle late = t.off_by(0.008, random);
  std::vector<Particle> from_the_start = early;
  from_the_start.push_back(late);
  t.weigh(from_the_start);
  for (int round = 0; round < 2; ++round) {
    t.weigh(early);
    early = resampled(t, early, 50, random.split(round));
  }
  early.push_back(late);
  t.weigh(early);
  EXPECT_GT(from_the_start.back().log_weight, -6);
  EXPECT_LT(from_the_start.back().log_weight, -2.8);
  EXPECT_NEAR(early.back().log_weight, from_the_start.back().log_weight, 0.05);
}

}  // namespace
}  // namespace edgescout::test
