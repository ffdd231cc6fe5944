#include "host/active/particles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/active/modes.h"
#include "host/core/matrix6.h"
#include "host/core/pose_error.h"
#include "tests/active/rendered_scene.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();

TEST(CandidateInWorld, TurnsPoseAndCovariance) {
  Random random = test_random();
  const Se3 camera_from_world{random.rotation(), random.direction()};
  Detection in_camera;
  in_camera.world_from_object = {random.rotation(), {0.1, 0.2, 0.7}};
  Matrix6d half;
  for (int i = 0; i < 36; ++i) half(i / 6, i % 6) = random.normal();
  in_camera.covariance = half * half.transpose();
  const Detection in_world = candidate_in_world(in_camera, camera_from_world);
  // A small step, made in the camera's tangent or in the world's: its Mahalanobis length is the
  // same.
  for (int i = 0; i < 5; ++i) {
    Vector6d step;
    for (int k = 0; k < 6; ++k) step[k] = 1e-6 * random.normal();
    const Se3 moved = inverse(camera_from_world) * retract(in_camera.world_from_object, step);
    const Vector6d in_tangent = local_coordinates(in_world.world_from_object, moved);
    const double before = step.dot(solve(in_camera.covariance, step)),
                 after = in_tangent.dot(solve(in_world.covariance, in_tangent));
    EXPECT_NEAR(after / before, 1, 1e-4);
  }
}

TEST(CandidateInWorld, TakesItsAlternativesAlong) {
  const Se3 camera_from_world{so3_exp({0.1, 0.7, -0.2}), {0.3, -0.1, 0.8}},
      camera_from_object{so3_exp({0.4, 0, 0}), {0.05, 0, 0.6}};
  Detection in_camera;
  in_camera.alternatives = {{camera_from_object, 0.4}};
  const Detection in_world = candidate_in_world(in_camera, camera_from_world);
  ASSERT_EQ(in_world.alternatives.size(), 1u);
  const Se3 back = camera_from_world * in_world.alternatives[0].world_from_object;
  EXPECT_LT(distance_between_m(back, camera_from_object), 1e-12);
  EXPECT_LT(angle_between_rad(back, camera_from_object), 1e-7);
}

TEST(Perturbed, HasTheCovarianceWithinItsBounds) {
  Random random = test_random();
  EdgeModel model;
  model.mesh.diameter_m = 0.1;
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal() << 1e-4, 4e-6, 1e-12, 1e-3, 4e-4,
      1.0;          // deviations: 10, 2, 0 mm; 1.6, 1, 50 mm at half the diameter
  covariance *= 4;  // twice these deviations, of which the spread takes half
  const Spread spread{0.005, 0.06, 0.5};
  const double expected[] = {6e-3, 2e-3, 0.5e-3, std::sqrt(1e-3), 0.02, 6e-3 / 0.05};
  Matrix6d sum = Matrix6d::Zero();
  const int count = 20000;
  const Se3 pose{random.rotation(), {1, 2, 3}};
  for (int i = 0; i < count; ++i) {
    const Vector6d off =
        local_coordinates(pose, perturbed(pose, covariance, model, spread, random));
    sum += off * off.transpose() / count;
  }
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(std::sqrt(sum(i, i)), expected[i], 0.03 * expected[i]) << i;
  covariance.diagonal().setConstant(INFINITE);
  double unknown = 0;
  for (int i = 0; i < 2000; ++i)
    unknown += local_coordinates(pose, perturbed(pose, covariance, model, spread, random))
                   .head<3>()
                   .squaredNorm() /
               2000;
  EXPECT_NEAR(std::sqrt(unknown / 3), 6e-3, 3e-4);
}

// CAD files have their origin anywhere: the same part with another origin moves in the same way.
TEST(Perturbed, MovesAPartTheSameWayWhereverItsOriginLies) {
  Random random = test_random();
  EdgeModel model, elsewhere;
  model.mesh.diameter_m = elsewhere.mesh.diameter_m = 0.1;
  elsewhere.center_m = {0.2, -0.1, 0.3};
  const Se3 pose{random.rotation(), {1, 2, 3}};
  const Se3 pose_elsewhere = pose * Se3{Eigen::Quaterniond::Identity(), -elsewhere.center_m};
  Matrix6d root;
  for (double& x : root.reshaped()) x = 0.003 * random.normal();
  root.bottomRows<3>() *= 10;
  const Matrix6d covariance = root * root.transpose();
  const Matrix6d covariance_elsewhere =
      covariance_about(pose_elsewhere, -elsewhere.center_m, covariance);
  EXPECT_GT((covariance - covariance_elsewhere).norm(), 0.2 * covariance.norm())
      << "the origin swings";
  for (const Matrix6d& unknown :
       {Matrix6d(Matrix6d::Constant(INFINITE)), Matrix6d(Matrix6d::Zero())}) {
    Random a = random.split("draws"), b = a;
    for (int i = 0; i < 20; ++i) {
      const Se3 here = perturbed(pose, unknown, model, {0.02, 0.1}, a);
      const Se3 there = perturbed(pose_elsewhere, unknown, elsewhere, {0.02, 0.1}, b);
      EXPECT_LT((here * Eigen::Vector3d::Zero() - there * elsewhere.center_m).norm(), 1e-12);
      EXPECT_LT(angle_between_rad(here, there), 1e-7);
    }
  }
  // Known ones: eigenvectors may have either sign, so the scatter is compared.
  Matrix6d scatter = Matrix6d::Zero(), scatter_elsewhere = Matrix6d::Zero();
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Vector6d off =
        local_coordinates(pose, perturbed(pose, covariance, model, {0.0, 10}, random));
    const Se3 back{Eigen::Quaterniond::Identity(), elsewhere.center_m};
    const Vector6d off_elsewhere = local_coordinates(
        pose, perturbed(pose_elsewhere, covariance_elsewhere, elsewhere, {0.0, 10}, random) * back);
    scatter += off * off.transpose() / count;
    scatter_elsewhere += off_elsewhere * off_elsewhere.transpose() / count;
  }
  EXPECT_LT((scatter - covariance).norm(), 0.05 * covariance.norm());
  EXPECT_LT((scatter_elsewhere - covariance).norm(), 0.05 * covariance.norm());
}

TEST(DrawParticles, SharesThemAmongTheCandidates) {
  Random random = test_random();
  const std::vector<EdgeModel> models{part_model("l_bracket"), part_model("hex_nut")};
  std::vector<Detection> candidates(3);
  for (int i = 0; i < 3; ++i)
    candidates[i].object = i % 2, candidates[i].psi = 0.5 + 0.1 * i,
    candidates[i].world_from_object = {random.rotation(), {0.3 * i, 0, 0}};
  const std::vector<Particle> particles =
      draw_particles(models, candidates, 31, {0.02, 0.1}, random);
  ASSERT_EQ(particles.size(), 31u);
  int around[3] = {0, 0, 0}, exactly[3] = {0, 0, 0};
  double total = 0;
  for (const Particle& p : particles) {
    const int i = int(std::lround(p.world_from_object.translation_m.x() / 0.3));
    EXPECT_EQ(p.object, candidates[i].object);
    ++around[i];
    exactly[i] += distance_between_m(p.world_from_object, candidates[i].world_from_object) == 0;
    total += std::exp(p.log_weight);
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(exactly[i], 1);
    EXPECT_GE(around[i], 10);
  }
  EXPECT_NEAR(total, 1, 1e-12);
  // Fewer than candidates: those of the highest psi. No candidate: none.
  const std::vector<Particle> few = draw_particles(models, candidates, 2, {0.02, 0.1}, random);
  ASSERT_EQ(few.size(), 2u);
  EXPECT_EQ(few[0].world_from_object.translation_m.x(), 0.6);
  EXPECT_EQ(few[1].world_from_object.translation_m.x(), 0.3);
  EXPECT_TRUE(draw_particles(models, {}, 5, {0.02, 0.1}, random).empty());
}

// Updates and resamples, as a scout does.
ParticleUpdate updated(std::vector<Particle>& particles, std::vector<double>& unseen_px2,
                       const RenderedScene& t, std::span<const Detection> candidates,
                       std::span<const ObjectView> views, Backend& backend,
                       const ParticleOptions& options) {
  const ParticleUpdate update =
      update_particles({t.models, views, backend}, particles, unseen_px2, candidates, options);
  resample_where_poor(particles,
                      find_modes(particles, t.sets, t.models, options, backend.threads()), t.models,
                      views.size(), options);
  return update;
}

// Three parts of two kinds: candidates some millimetres off, and two where there is no part.
TEST(UpdateParticles, FindsTheInstancesAndDropsTheRest) {
  Random random = test_random();
  const RenderedScene t({"l_bracket", "bearing_block"}, 3, 3);
  const auto backend = make_cpu_backend(2);
  std::vector<Detection> candidates;
  for (std::size_t i = 0; i < 3; ++i) candidates.push_back(t.candidate(i, 0.003, 0.05, random));
  candidates.push_back(t.false_candidate(0, {0.0, 0.0, 0.06}, random));
  candidates.push_back(t.false_candidate(1, {0.05, 0.03, 0.07}, random));
  ParticleOptions options;
  options.count = 40;
  std::vector<double> unseen_px2;
  std::vector<Particle> particles =
      draw_particles(t.models, candidates, options.count, options.drawn, random);
  const std::vector<ObjectView> all = t.views(*backend);
  for (std::size_t seen = 1; seen <= 3; ++seen) {
    const std::span<const ObjectView> views(all.data(), seen);
    const ParticleUpdate update =
        updated(particles, unseen_px2, t, candidates, views, *backend, options);
    std::printf("%zu views: effective %.1f of %zu\n", seen, update.effective, particles.size());
    EXPECT_FALSE(update.reseeded);
    EXPECT_EQ(particles.size(), 40u);
  }
  const std::vector<Mode> modes =
      find_modes(particles, t.sets, t.models, options, backend->threads());
  for (const Mode& m : modes)
    std::printf("mode of object %d: %zu particles, weight %.3f, probability %.3f\n", m.object,
                m.particles.size(), m.weight, m.probability);
  const std::vector<ModeDetection> found =
      mode_detections({t.models, all, *backend}, t.sets, particles, modes);
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const PlacedObject& truth = t.scene.placed[i];
    double distance = 1, angle = 9;
    for (const ModeDetection& d : found) {
      if (d.detection.object != truth.object) continue;
      const PoseError error = pose_error(d.detection.world_from_object, truth.world_from_object,
                                         t.parts[truth.object].symmetries);
      if (error.distance_m < distance) distance = error.distance_m, angle = error.angle_rad;
    }
    std::printf("part %zu: %.2f mm, %.3f rad\n", i, 1000 * distance, angle);
    EXPECT_LT(distance, 0.0015);
    EXPECT_LT(angle, 0.03);
  }
  for (const ModeDetection& d : found) {
    EXPECT_GT(d.detection.probability, 0.5);
    EXPECT_GE(d.supporting_images.size(), 2u);
    EXPECT_TRUE(d.detection.covariance.allFinite());
    EXPECT_GT(eigenvectors(d.detection.covariance).values.minCoeff(), 0);
  }
}

TEST(UpdateParticles, DrawsAnewWhereAllDied) {
  Random random = test_random();
  const RenderedScene t({"l_bracket"}, 1, 1);
  const auto backend = make_cpu_backend(2);
  const std::vector<Detection> candidates{t.candidate(0, 0.003, 0.05, random)};
  ParticleOptions options;
  options.count = 10;
  std::vector<Particle> particles =
      draw_particles(t.models, candidates, options.count, options.drawn, random);
  for (Particle& p : particles) p.world_from_object.translation_m.z() += 5;  // behind the camera
  std::vector<double> unseen_px2;
  const CollectedLog log;
  const ParticleUpdate update =
      updated(particles, unseen_px2, t, candidates, t.views(*backend), *backend, options);
  EXPECT_TRUE(update.reseeded);
  ASSERT_EQ(log.messages.size(), 1u);
  EXPECT_NE(log.messages[0].second.find("all particles died"), std::string::npos);
  const std::vector<Mode> modes =
      find_modes(particles, t.sets, t.models, options, backend->threads());
  ASSERT_FALSE(modes.empty());
  EXPECT_LT(distance_between_m(particles[modes[0].particles[0]].world_from_object,
                               t.scene.placed[0].world_from_object),
            0.006);
}

TEST(UpdateParticles, WarnsWhereNothingCanBeDrawnAnew) {
  Random random = test_random();
  const RenderedScene t({"l_bracket"}, 1, 1);
  const auto backend = make_cpu_backend(2);
  std::vector<Detection> candidates{t.candidate(0, 0.003, 0.05, random)};
  candidates[0].world_from_object.translation_m.z() += 5;  // behind the camera, and all around it
  ParticleOptions options;
  options.count = 10;
  const auto messages = [&](std::span<const Detection> around) {
    std::vector<Particle> particles =
        draw_particles(t.models, candidates, options.count, options.drawn, random);
    std::vector<double> unseen_px2;
    const CollectedLog log;
    const std::vector<ObjectView> views = t.views(*backend);
    update_particles({t.models, views, *backend}, particles, unseen_px2, around, options);
    EXPECT_EQ(particles.size(), 10u);
    for (const Particle& p : particles) EXPECT_NEAR(p.log_weight, -std::log(10.0), 1e-12);
    std::string all;
    for (const auto& message : log.messages) all += message.second + "\n";
    return all;
  };
  EXPECT_NE(messages(candidates).find("those drawn anew too"), std::string::npos);
  EXPECT_NE(messages({}).find("no candidate to draw others around"), std::string::npos);
}

TEST(UpdateParticles, IsTheSameAgain) {
  Random random = test_random();
  const RenderedScene t({"l_bracket"}, 1, 2);
  const auto backend = make_cpu_backend(2);
  const std::vector<Detection> candidates{t.candidate(0, 0.003, 0.05, random)};
  ParticleOptions options;
  options.count = 12;
  options.min_effective = 1;
  options.sigma_px = 0.1;  // one fits better than the others, and is copied
  const auto run = [&](std::uint64_t seed) {
    options.seed = seed;
    std::vector<Particle> particles =
        draw_particles(t.models, candidates, options.count, options.drawn, Random(3));
    std::vector<double> unseen_px2;
    updated(particles, unseen_px2, t, candidates, t.views(*backend), *backend, options);
    std::vector<double> numbers;
    for (const Particle& p : particles) numbers.push_back(p.world_from_object.translation_m.x());
    return numbers;
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

TEST(ParticleOptions, NamesWhatIsOutOfBounds) {
  const auto with = [](auto change) {
    return [change] {
      ParticleOptions options;
      change(options);
      options.validate();
    };
  };
  expect_input_error(with([](ParticleOptions& o) { o.count = 0; }), {"scout.particles"});
  expect_input_error(with([](ParticleOptions& o) { o.sigma_px = 0; }), {"particles.sigma"});
  expect_input_error(with([](ParticleOptions& o) {
                       o.drawn = {0.2, 0.1};
                     }),
                     {"particles.drawn_min"});
  EXPECT_NO_THROW(with([](ParticleOptions&) {})());
}

}  // namespace
}  // namespace edgescout::test
