#include "host/active/modes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/register/pose_classifier.h"
#include "kernels/thread_pool.h"
#include "tests/active/rendered_scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

// Features that make a pose probable or not, whatever it is.
PoseFeatures features_of(bool probable) {
  PoseFeatures f;
  f.psi = probable ? 0.95 : 0.3;
  f.mean_px = probable ? 1 : 9;
  f.matched = probable ? 1 : 0.2;
  f.points = f.visible = 200;
  f.length_px = 600;
  f.in_image = 1;
  f.shading = {1000, 1e6, probable ? 1e4 : 9e5};
  return f;
}

Particle particle(int object, const Se3& pose, double weight, bool probable) {
  Particle p;
  p.object = object;
  p.world_from_object = pose;
  p.log_weight = std::log(weight);
  p.features = {features_of(probable)};
  p.covariance.setIdentity();
  return p;
}

struct Nuts {
  std::vector<TemplateSet> sets{without_views(make_part("hex_nut")),
                                without_views(make_part("l_bracket"))};
  std::vector<EdgeModel> models{sets[0].model, sets[1].model};
  ParticleOptions options;
  mutable ThreadPool threads{1};
};

// With a small sigma one particle has all the weight that a double can hold. Another one that is as
// probable by its images stays a mode and keeps its particles.
TEST(FindModes, KeepsLightModes) {
  const Nuts t;
  std::vector<Particle> particles;
  for (const double x_m : {0.0, 0.3})
    particles.push_back(particle(1, {{1, 0, 0, 0}, {x_m, 0, 0.5}}, 1, true));
  particles[1].log_weight = -5000;
  particles.push_back(particles[1]);
  particles[2].log_weight = -5001;
  const std::vector<Mode> modes = find_modes(particles, t.sets, t.models, t.options, t.threads);
  ASSERT_EQ(modes.size(), 2u);
  EXPECT_EQ(modes[1].probability, modes[0].probability);
  const std::vector<Particle> next = resample(particles, modes, t.models, 40, t.options, Random(1));
  std::size_t light = 0;
  for (const Particle& p : next) {
    EXPECT_TRUE(std::isfinite(p.log_weight) && std::isfinite(p.resampled_px2));
    light += p.world_from_object.translation_m.x() > 0.15;
  }
  EXPECT_EQ(next.size(), 40u);
  EXPECT_EQ(light, std::size_t(t.options.min_per_mode));
}

TEST(FindModes, JoinsOnlySymmetricPoses) {
  Random random = test_random();
  const Nuts t;
  const Se3 here{random.rotation(), {0, 0, 0.5}}, there{random.rotation(), {0.2, 0, 0.5}};
  std::vector<Particle> particles;
  for (const Se3& symmetry : t.sets[0].symmetries.discrete)
    particles.push_back(particle(0, here * symmetry, 0.01, true));
  const std::size_t turns = particles.size();
  ASSERT_GT(turns, 5u);
  particles.push_back(particle(0, there, 0.5, true));
  particles.push_back(particle(1, here, 0.3, false));  // another object at the same place
  particles.push_back(particle(1, {{0, 1, 0, 0}, {-0.3, 0, 0}}, 0, false));  // no weight, no mode
  const std::vector<Mode> modes = find_modes(particles, t.sets, t.models, t.options, t.threads);
  ASSERT_EQ(modes.size(), 3u);
  EXPECT_EQ(modes[0].particles, std::vector<std::size_t>{turns});
  EXPECT_EQ(modes[1].object, 1);
  EXPECT_EQ(modes[2].particles.size(), turns);
  const double total = 0.8 + 0.01 * double(turns);
  EXPECT_NEAR(modes[0].weight, 0.5 / total, 1e-12);
  EXPECT_NEAR(modes[1].weight, 0.3 / total, 1e-12);
  EXPECT_NEAR(modes[2].weight, 0.01 * double(turns) / total, 1e-12);
  EXPECT_GT(modes[0].probability, 0.8);
  EXPECT_LT(modes[1].probability, 0.05);
}

TEST(FindModes, LowersTheProbabilityInsideAMoreProbableMode) {
  Random random = test_random();
  const Nuts t;
  const Se3 here{random.rotation(), {0, 0, 0.5}}, there{random.rotation(), {0.3, 0, 0.5}};
  std::vector<Particle> particles{particle(0, here, 0.4, true), particle(1, here, 0.3, true),
                                  particle(1, there, 0.2, true)};
  particles[1].features[0].psi -= 0.05;
  const double alone = find_modes(particles, t.sets, t.models, t.options, t.threads)[1].probability;
  EXPECT_EQ(alone, PoseClassifier::probability(particles[1].features))
      << "one view does not determine the distance";
  for (Particle& p : particles) p.features.push_back(p.features[0]);
  const std::vector<Mode> modes = find_modes(particles, t.sets, t.models, t.options, t.threads);
  ASSERT_EQ(modes.size(), 3u);
  const double first = PoseClassifier::probability(particles[0].features),
               second = PoseClassifier::probability(particles[1].features);
  ASSERT_GT(first, second);
  ASSERT_GT(second, 0.01);
  EXPECT_EQ(modes[0].probability, first);
  EXPECT_DOUBLE_EQ(modes[1].probability, second * (1 - first));
  EXPECT_EQ(modes[2].probability, first);
}

TEST(Resample, KeepsProbableModesAndLetsOthersDie) {
  const Nuts t;
  std::vector<Particle> particles;
  // A heavy mode, a light probable one, a light improbable one.
  for (int i = 0; i < 10; ++i)
    particles.push_back(particle(1, {{1, 0, 0, 0}, {0, 0, 0}}, 0.09995, true));
  for (int i = 0; i < 5; ++i)
    particles.push_back(particle(1, {{1, 0, 0, 0}, {1, 0, 0}}, 0.00004, true));
  for (int i = 0; i < 5; ++i)
    particles.push_back(particle(1, {{1, 0, 0, 0}, {2, 0, 0}}, 0.00006, false));
  for (Particle& p : particles) p.upsilon_px2 = 7;
  const std::vector<Particle> next =
      resample(particles, find_modes(particles, t.sets, t.models, t.options, t.threads), t.models,
               100, t.options, Random(5));
  ASSERT_EQ(next.size(), 100u);
  int count[3] = {0, 0, 0};
  double weight[3] = {0, 0, 0};
  for (const Particle& p : next) {
    const int mode = int(std::lround(p.world_from_object.translation_m.x()));
    ++count[mode];
    weight[mode] += std::exp(p.log_weight);
    // What weighing the same images again would make of it, up to a constant common to all.
    EXPECT_NEAR(
        (p.resampled_px2 - p.upsilon_px2) / t.options.scale_px2() - p.log_weight,
        (next[0].resampled_px2 - next[0].upsilon_px2) / t.options.scale_px2() - next[0].log_weight,
        1e-9);
  }
  EXPECT_GE(count[1], t.options.min_per_mode);
  EXPECT_LE(count[1], t.options.min_per_mode + 1);
  EXPECT_EQ(count[2], 0);
  EXPECT_NEAR(weight[0], 0.9995 / 0.9997, 1e-9);
  EXPECT_NEAR(weight[1], 0.0002 / 0.9997, 1e-9);
}

TEST(Resample, DrawsSystematicallyByWeight) {
  const Nuts t;
  std::vector<Particle> particles;
  const double weights[] = {0.05, 0.4, 0.15, 0.3, 0.1};
  for (int i = 0; i < 5; ++i) {
    particles.push_back(particle(1, {{1, 0, 0, 0}, {0.001 * i, 0, 0}}, weights[i], true));
    particles.back().covariance.setZero();
    particles.back().resampled_px2 = i;
  }
  ParticleOptions options;
  options.roughened = {0, 0};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<Particle> next =
        resample(particles, find_modes(particles, t.sets, t.models, options, t.threads), t.models,
                 33, options, Random(seed));
    ASSERT_EQ(next.size(), 33u);
    for (int i = 0; i < 5; ++i) {
      const auto copies = std::ranges::count_if(next, [&](const Particle& p) {
        return std::abs(p.world_from_object.translation_m.x() - 0.001 * i) < 1e-9;
      });
      EXPECT_LT(std::abs(double(copies) - 33 * weights[i]), 1) << i;
    }
  }
}

TEST(Resample, RoughensCopiesButKeepsOneOfEach) {
  const Nuts t;
  const std::vector<Particle> particles{particle(1, {{1, 0, 0, 0}, {0.3, 0, 0}}, 1, true)};
  const std::vector<Particle> next =
      resample(particles, find_modes(particles, t.sets, t.models, t.options, t.threads), t.models,
               50, t.options, Random(5));
  int exact = 0;
  for (const Particle& p : next) {
    const double off = distance_between_m(p.world_from_object, particles[0].world_from_object);
    exact += off == 0;
    EXPECT_LT(off, 5 * 2 * t.options.roughened.max * t.models[1].mesh.diameter_m);
  }
  EXPECT_EQ(exact, 1);
}

TEST(Resample, OfNothingIsNothing) {
  const Nuts t;
  EXPECT_TRUE(resample({}, {}, t.models, 10, t.options, Random(1)).empty());
  EXPECT_TRUE(find_modes({}, t.sets, t.models, t.options, t.threads).empty());
}

TEST(BeliefEntropy, IsZeroWhereAllIsCertain) {
  Mode sure, open;
  sure.probability = 1;
  open.probability = 0.5;
  Mode absent;
  absent.probability = 0;
  EXPECT_EQ(belief_entropy({}), 0);
  EXPECT_EQ(belief_entropy(std::vector<Mode>{sure, absent, sure}), 0);
  EXPECT_NEAR(belief_entropy(std::vector<Mode>{sure, open, open}), 2 * std::log(2.0), 1e-12);
}

}  // namespace
}  // namespace edgescout::test
