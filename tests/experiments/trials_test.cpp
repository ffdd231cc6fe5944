// Starts around known poses, and what the methods make of them on a rendered image.
#include "host/experiments/trials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "host/core/pose_error.h"
#include "host/experiments/pose_candidates.h"
#include "host/experiments/rates.h"

namespace edgescout::test {
namespace {

ExperimentSettings small_settings() {
  ExperimentSettings settings;
  settings.image_scale = 0.5;
  settings.supersampling = 1;
  return settings;
}

// Two bearing blocks and a bracket as nobody rendered them: for what needs poses alone.
KnownScene empty_scene() {
  KnownScene scene;
  scene.set = "made";
  scene.name = "up";
  const std::vector<Object> types = rendered_types();
  scene.objects = {types[0], types[1]};
  scene.images = {
      {{}, {640, 480, 800, 800, 319.5, 239.5, {}}, {so3_exp({0.2, 0, 0}), {0, 0, 0.5}}}};
  scene.instances = {{"a", 0, {so3_exp({0, 0.3, 1}), {0.03, 0, 0}}, 1},
                     {"b", 0, {so3_exp({1, 0.3, 0}), {-0.05, 0.02, 0}}, 1},
                     {"c", 1, {Eigen::Quaterniond::Identity(), {0, -0.04, 0.01}}, 1}};
  return scene;
}

TEST(Starts, LieAsFarAsTheySay) {
  const KnownScene scene = empty_scene();
  const std::vector<Start> starts = starts_around(scene, 40, 1);
  ASSERT_EQ(starts.size(), 120u);
  std::map<int, int> by_level;
  for (const Start& start : starts) {
    const Se3 truth =
        scene.images[0].camera_from_world * scene.instances[start.instance].world_from_object;
    EXPECT_NEAR(angle_between_rad(start.camera_from_object, truth), start.distance_rad, 1e-6);
    EXPECT_NEAR(distance_between_m(start.camera_from_object, truth),
                METRES_PER_RADIAN * start.distance_rad, 1e-9);
    ++by_level[static_cast<int>(start.distance_rad / 0.1)];
  }
  EXPECT_EQ(by_level, (std::map<int, int>{{0, 30}, {1, 30}, {2, 30}, {3, 30}}))
      << "spread evenly over the distances";
}

TEST(Starts, ByDistanceLieTwoHundredthsOfItAway) {
  const KnownScene scene = empty_scene();
  const std::vector<Start> starts = starts_by_distance(scene, 5, 1);
  ASSERT_EQ(starts.size(), 15u);
  std::set<double> shifts_m;
  for (const Start& start : starts) {
    const Se3 truth =
        scene.images[0].camera_from_world * scene.instances[start.instance].world_from_object;
    EXPECT_EQ(start.distance_rad, 0.1);
    EXPECT_NEAR(angle_between_rad(start.camera_from_object, truth), 0.1, 1e-6);
    EXPECT_NEAR(distance_between_m(start.camera_from_object, truth),
                0.02 * truth.translation_m.norm(), 1e-9);
    shifts_m.insert(start.camera_from_object.translation_m.x() - truth.translation_m.x());
  }
  EXPECT_EQ(shifts_m.size(), 15u) << "each in a direction of its own";
}

// A shaft turned about its axis has not moved.
TEST(Starts, LieAsFarFromAllPosesThatLookAlike) {
  KnownScene scene = empty_scene();
  scene.objects = rendered_types();
  const auto shaft = std::ranges::max_element(
      scene.objects, {}, [](const Object& object) { return object.symmetries.discrete.size(); });
  ASSERT_GT(shaft->symmetries.discrete.size(), 30u);
  scene.instances.resize(1);
  scene.instances[0].object = static_cast<int>(shaft - scene.objects.begin());
  const Se3 truth = scene.images[0].camera_from_world * scene.instances[0].world_from_object;
  for (const Start& start : starts_around(scene, 200, 1)) {
    double nearest_rad = INFINITY;
    for (const Se3& symmetry : shaft->symmetries.discrete)
      nearest_rad =
          std::min(nearest_rad, angle_between_rad(start.camera_from_object, truth * symmetry));
    EXPECT_NEAR(nearest_rad, start.distance_rad, 1e-6);
    EXPECT_NEAR(distance_between_m(start.camera_from_object, truth),
                METRES_PER_RADIAN * start.distance_rad, 1e-9);
  }
}

TEST(Starts, DependOnTheSeedAlone) {
  const KnownScene scene = empty_scene();
  const auto at = [&](unsigned seed) {
    return starts_around(scene, 3, seed)[4].camera_from_object.translation_m;
  };
  EXPECT_EQ(at(1), at(1));
  EXPECT_NE(at(1), at(2));
}

TEST(Candidates, HaveAShareAroundEveryInstance) {
  const KnownScene scene = empty_scene();
  const std::vector<PoseCandidate> candidates = pose_candidates(scene, 0, 300, 1);
  ASSERT_EQ(candidates.size(), 300u);
  std::map<int, int> of_instance;
  for (const PoseCandidate& candidate : candidates) {
    ++of_instance[candidate.instance];
    int expected = -1;
    for (int i : {0, 1})
      if (const Se3 truth =
              scene.images[0].camera_from_world * scene.instances[i].world_from_object;
          pose_error(candidate.camera_from_object, truth, scene.objects[0].symmetries)
              .passes(0.2, 0.01))
        expected = i;
    EXPECT_EQ(candidate.instance, expected);
    const Eigen::Vector2d at =
        project(scene.images[0].camera, candidate.camera_from_object.translation_m);
    EXPECT_TRUE(candidate.camera_from_object.translation_m.z() > 0 && at.x() >= 0 && at.x() < 640 &&
                at.y() >= 0 && at.y() < 480);
  }
  EXPECT_EQ(of_instance[0], 20);
  EXPECT_EQ(of_instance[1], 20);
  EXPECT_EQ(of_instance[-1], 260);
}

TEST(Candidates, AreAsManyAsAskedForWhereThereIsRoomForFew) {
  EXPECT_EQ(pose_candidates(empty_scene(), 0, 5, 1).size(), 5u);
}

// From up to 0.1 rad and 5 mm on a bare board every registration is correct, and the rows show it.
TEST(Trials, RowsSayWhatThePosesAre) {
  const ExperimentSettings settings = small_settings();
  RenderOptions options = single_image_options(settings, 0);
  options.objects = 2;
  options.pile = 0;
  options.clutter = 0;
  const std::unique_ptr<Backend> backend = make_cpu_backend(1);
  const KnownScene scene = rendered_scene("bare", rendered_types(), options, backend->threads());
  ASSERT_EQ(scene.instances.size(), 2u);
  std::vector<Start> starts = starts_around(scene, 8, 3);
  std::erase_if(starts, [](const Start& start) { return start.distance_rad > 0.1; });
  ASSERT_EQ(starts.size(), 4u);
  const Table table = run_trials(
      scene, starts,
      {{"edgescout", 1}, {"d2co", 1}, {"d2co", 1, 30}, {"d2co", 1, 100, 0.5}, {"edgescout", 3}},
      settings, *backend);
  EXPECT_EQ(
      values_of(table, "method"),
      (std::vector<std::string>{"edgescout", "d2co", "d2co (lambda 30)", "d2co (smoothing 0.5)"}));
  EXPECT_EQ(table.rows.size(), 16u) << "three views are not there";
  EXPECT_EQ(values_of(table, "mspd_px").size(), 16u) << "each on a tensor of its own";
  int right = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const bool is_right =
        number_in(table, row, "angle_rad") < 0.1 && number_in(table, row, "distance_mm") < 5;
    EXPECT_EQ(text_in(table, row, "right"), is_right ? "1" : "0");
    EXPECT_GT(number_in(table, row, "ms"), 0);
    EXPECT_GT(number_in(table, row, "steps"), 0);
    if (text_in(table, row, "method") != "edgescout") {  // its edge ICP has its own limit
      EXPECT_EQ(number_in(table, row, "cut_off"), number_in(table, row, "steps") >= 100) << row;
    }
    right += is_right && text_in(table, row, "method") == "edgescout";
  }
  EXPECT_EQ(right, 4);
}

// The settings of methods, edges and tensors determine the run and the notes.
TEST(Trials, FollowTheSettings) {
  ExperimentSettings settings = small_settings();
  RenderOptions options = single_image_options(settings, 0);
  options.objects = 1;
  const std::unique_ptr<Backend> backend = make_cpu_backend(1);
  const KnownScene scene = rendered_scene("one", rendered_types(), options, backend->threads());
  const std::vector<Start> starts = starts_around(scene, 2, 1);
  const auto found_by = [&](const std::string& method, const auto& change) {
    ExperimentSettings changed = settings;
    change(changed);
    EXPECT_NE(trial_notes(changed), trial_notes(settings)) << method;
    return run_trials(scene, starts, {{method, 1}}, changed, *backend);
  };
  const auto expect_other = [&](const std::string& method, const auto& change) {
    const Table as_it_is = run_trials(scene, starts, {{method, 1}}, settings, *backend),
                changed = found_by(method, change);
    EXPECT_NE(values_of(as_it_is, "mspd_px"), values_of(changed, "mspd_px")) << method;
  };
  expect_other("d2co", [](ExperimentSettings& s) { s.tensor.smoothing_variance = 0.25f; });
  expect_other("d2co", [](ExperimentSettings& s) { s.tensor.cap_px = 5; });
  expect_other("dc-icp", [](ExperimentSettings& s) { s.edges = EdgeMethod::Lsd; });
  expect_other("lm-icp", [](ExperimentSettings& s) { s.methods.loss_scale_px = 10; });
  const Table one_step =
                  found_by("d2co", [](ExperimentSettings&s) { s.methods.inner_iterations = 1; }),
              two_rounds =
                  found_by("c-icp", [](ExperimentSettings&s) { s.methods.outer_iterations = 2; });
  EXPECT_EQ(values_of(one_step, "steps"), std::vector<std::string>{"1"});
  EXPECT_EQ(values_of(one_step, "cut_off"), std::vector<std::string>{"1"});
  EXPECT_EQ(values_of(two_rounds, "steps"), std::vector<std::string>{"2"});
}

TEST(Trials, LeaveTimesOutWhereNobodyWantsThem) {
  ExperimentSettings settings = small_settings();
  settings.times = false;
  RenderOptions options = single_image_options(settings, 0);
  options.objects = 1;
  const std::unique_ptr<Backend> backend = make_cpu_backend(1);
  const KnownScene scene = rendered_scene("one", rendered_types(), options, backend->threads());
  const Table table =
      run_trials(scene, starts_around(scene, 1, 1), {{"d2co", 1}}, settings, *backend);
  ASSERT_FALSE(table.rows.empty());
  EXPECT_EQ(text_in(table, 0, "ms"), "");
}

}  // namespace
}  // namespace edgescout::test
