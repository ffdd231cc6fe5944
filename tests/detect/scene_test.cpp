// Rendered scenes of known pose through the whole pipeline: parts are found, more exactly by two
// views than by one, and the same on every device.
#include <gtest/gtest.h>

#include "host/detect/detect.h"
#include "host/detect/distinct_poses.h"
#include "host/register_objects.h"
#include "tests/detect/rendered_part.h"

namespace edgescout::test {
namespace {

class DetectParts : public ::testing::TestWithParam<std::string> {};

// The detection nearest to the truth.
const Detection& nearest(const Detections& found, const Se3& truth) {
  return *std::ranges::min_element(found.detections, {}, [&](const Detection& d) {
    return distance_between_m(d.world_from_object, truth);
  });
}

// The parts are 60 to 100 px long: their position is certain to a millimetre across the line of
// sight, and only to 2 % of the distance along it.
TEST_P(DetectParts, AreFoundOnTheBoard) {
  const RenderedPart t(GetParam());
  const auto backend = make_cpu_backend(2);
  const Detections found = t.detect(0, *backend);
  ASSERT_FALSE(found.detections.empty());
  const Se3 truth = t.truth_in(0);
  const Detection& part = nearest(found, truth);
  const Se3 best = part.world_from_object;
  const Eigen::Vector3d off = best.translation_m - truth.translation_m,
                        ray = truth.translation_m.normalized();
  const double along_m = std::abs(off.dot(ray)), across_m = (off - off.dot(ray) * ray).norm(),
               angle_rad = t.error(best, truth).angle_rad;
  std::printf("%.4f rad, %.2f mm across, %.2f mm along, probability %.2f\n", angle_rad,
              1000 * across_m, 1000 * along_m, part.probability);
  // The block's image hardly shows how it is tilted: a pose 0.08 rad and 10 mm off is as probable
  // as its own.
  const bool is_block = GetParam() == "bearing_block";
  EXPECT_LT(across_m, is_block ? 0.002 : 0.001);
  EXPECT_LT(along_m, is_block ? 0.007 : 0.006);
  EXPECT_LT(angle_rad, is_block ? 0.09 : 0.07);
  EXPECT_GT(part.probability, 0.6);
  // The image of the bracket shows a second pose as well, which reaches over its shadow.
  const auto more_probable = std::ranges::count_if(
      found.detections, [&](const Detection& d) { return d.probability > part.probability; });
  EXPECT_LE(more_probable, GetParam() == "l_bracket" ? 1 : 0);
}

INSTANTIATE_TEST_SUITE_P(Parts, DetectParts,
                         ::testing::Values("l_bracket", "bearing_block", "u_channel"),
                         [](const auto& parameter) { return parameter.param; });

// At distances of two scales.
TEST(DetectObjects, FindsNearAndFarPartsWithoutARange) {
  const auto backend = make_cpu_backend(2);
  TemplateOptions few;
  few.frequency = 3;
  few.in_plane_steps = 12;
  for (const double distance_m : {0.15, 0.5}) {
    RenderedPart t("u_channel", 1, 1, distance_m);
    t.sets = {build_templates(
        t.part, with_default_distances(few, t.part.mesh.diameter_m, t.scene.views[0].camera),
        *backend)};
    const Detections found = t.detect(0, *backend);
    ASSERT_FALSE(found.detections.empty()) << distance_m;
    const Se3 truth = t.truth_in(0), best = nearest(found, truth).world_from_object;
    EXPECT_LT(t.error(best, truth).angle_rad, 0.1) << distance_m;
    EXPECT_LT(distance_between_m(best, truth), 0.03 * distance_m) << distance_m;
  }
}

// Registration shrinks some poses onto one edge of the image, which they then match well.
TEST(DetectObjects, LeavesOutPosesFarBeyondTheSearchedDistances) {
  const RenderedPart t("bearing_block");
  const std::unique_ptr<Backend> backend = make_cpu_backend(2);
  const TemplateSet& set = t.sets[0];
  const auto is_searched = [&](const ObjectPose& pose) {
    const double distance_m = (pose.world_from_object * set.model.center_m).norm();
    return 1.25 * distance_m > set.options.distance_min_m &&
           distance_m < 1.25 * set.options.distance_max_m;
  };
  DetectTrace trace;
  detect_objects(t.prepared(0, Se3{}, *backend), t.sets, *backend, t.options(), &trace);
  const SearchTrace& search = trace.searches[0];
  ASSERT_FALSE(std::ranges::all_of(search.coarse, is_searched));
  for (const std::size_t i : search.medium_starts) EXPECT_TRUE(is_searched(search.coarse[i]));
  EXPECT_FALSE(search.candidates.empty());
  EXPECT_TRUE(std::ranges::all_of(search.candidates, is_searched));
  EXPECT_TRUE(std::ranges::all_of(trace.selection.competing, is_searched));
}

TEST(DetectObjects, FindsNothingOnABareBoard) {
  RenderedPart t("l_bracket");
  ThreadPool pool(2);
  t.scene.placed.clear();
  t.renderings = render(t.scene, pool);
  const auto backend = make_cpu_backend(2);
  PipelineOptions options = t.options();
  options.detect.min_probability = DetectOptions{}.min_probability;
  EXPECT_TRUE(t.detect(0, *backend, options).detections.empty());
}

TEST(DetectJointly, IsMoreExactThanOneView) {
  const RenderedPart t("l_bracket", 2);
  const auto backend = make_cpu_backend(2);
  double single_m = 0;
  for (std::size_t view : {0, 1}) {
    const Detections found = t.detect(view, *backend);
    ASSERT_FALSE(found.detections.empty());
    single_m += t.error(found.detections[0].world_from_object, t.truth_in(view)).distance_m / 2;
  }
  const Detections joint = t.detect_in_all(*backend);
  ASSERT_FALSE(joint.detections.empty());
  const PoseError error = t.error(joint.detections[0].world_from_object, t.world_truth());
  std::printf("one view %.2f mm on average, both %.2f mm, %.4f rad\n", 1000 * single_m,
              1000 * error.distance_m, error.angle_rad);
  EXPECT_LT(error.distance_m, 0.001);
  EXPECT_LT(error.angle_rad, 0.03);
  EXPECT_LT(error.distance_m, single_m);
}

TEST(RegisterObjects, GivesPosesTheProbabilityOfJointDetection) {
  const RenderedPart t("l_bracket", 2);
  const auto backend = make_cpu_backend(2);
  const Detections joint = t.detect_in_all(*backend);
  ASSERT_FALSE(joint.detections.empty());
  std::vector<ObjectView> views;
  for (std::size_t v : {0, 1})
    views.push_back(t.prepared(v, t.scene.views[v].camera_from_world, *backend));
  const ObjectPose start = joint.detections[0];
  const Detections again =
      register_objects(views, std::span(&t.sets[0].model, 1), std::span(&start, 1), *backend, {});
  EXPECT_NEAR(again.detections[0].probability, joint.detections[0].probability, 0.003);
}

TEST(DetectObjects, IsTheSameOnADevice) {
  if (vulkan_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  const RenderedPart t("l_bracket");
  const Detections cpu = t.detect(0, *make_cpu_backend(2)),
                   device = t.detect(0, *make_vulkan_backend(0));
  ASSERT_EQ(cpu.detections.size(), device.detections.size());
  ASSERT_FALSE(cpu.detections.empty());
  // Compares the right pose. Those below it are wrong, and a wrong pose may end in either of two
  // optima whose costs are equal to a thousandth.
  const Detection &a = nearest(cpu, t.truth_in(0)), &b = nearest(device, t.truth_in(0));
  EXPECT_LT(distance_between_m(a.world_from_object, b.world_from_object), 0.0005);
  EXPECT_LT(angle_between_rad(a.world_from_object, b.world_from_object), 0.005);
  EXPECT_NEAR(a.probability, b.probability, 0.01);
}

// One view determines the distance least; the others see it. Candidates are as exact as after
// registration in all views.
TEST(FindCandidates, WithSupportViewsAreRightInAllOfThem) {
  const RenderedPart t("bearing_block", 3);
  const auto backend = make_cpu_backend(2);
  std::vector<ObjectView> views;
  for (std::size_t v = 0; v < 3; ++v) views.push_back(t.with_tensors(v, *backend));
  const DetectOptions options = t.options().detect;
  const std::span<const ObjectView> others = std::span(views).subspan(1);
  const std::vector<PoseEstimate> alone = find_candidates({t.sets[0], views[0], {}, *backend}, {},
                                                          options),
                                  supported = find_candidates(
                                      {t.sets[0], views[0], others, *backend}, {}, options);
  ASSERT_FALSE(alone.empty());
  ASSERT_FALSE(supported.empty());
  EXPECT_EQ(alone[0].features.size(), 1u);
  EXPECT_EQ(supported[0].features.size(), 3u);
  const PoseError single = t.error(alone[0].world_from_object, t.truth_in(0)),
                  joint = t.error(supported[0].world_from_object, t.truth_in(0));
  std::printf("alone %.2f mm, supported %.3f mm\n", 1000 * single.distance_m,
              1000 * joint.distance_m);
  EXPECT_LT(joint.distance_m, 0.0005);
  EXPECT_LT(joint.angle_rad, 0.01);
  EXPECT_LT(joint.distance_m, single.distance_m);
}

TEST(FindCandidates, LeavesOutKnownInstances) {
  const RenderedPart t("bearing_block", 2);
  const auto backend = make_cpu_backend(2);
  // The world of the scene is not the camera frame.
  const ObjectView view = t.with_tensors(1, *backend);
  const std::vector<Se3> known{t.scene.placed[0].world_from_object};
  const Mesh& mesh = t.sets[0].model.mesh;
  const auto nearest = [&](std::span<const Se3> known_in_world) {
    double least = 1;
    for (const PoseEstimate& r :
         find_candidates({t.sets[0], view, {}, *backend}, known_in_world, t.options().detect))
      least = std::min(
          least, pose_distance_m(r.world_from_object, t.truth_in(1), mesh, t.sets[0].symmetries) /
                     mesh.diameter_m);
    return least;
  };
  EXPECT_LT(nearest({}), 0.02);
  EXPECT_GT(nearest(known), 0.1);
  EXPECT_LT(nearest(known), 1) << "others are still found";
}

// With one candidate only the better of two parts is found. Where that one is known, the other is
// found.
TEST(FindCandidates, KnownInstancesLeaveTheirPlaceToOthers) {
  const RenderedPart t("bearing_block", 3, 2);
  const auto backend = make_cpu_backend(2);
  std::vector<ObjectView> views;
  for (std::size_t v = 0; v < 3; ++v) views.push_back(t.with_tensors(v, *backend));
  DetectOptions options = t.options().detect;
  options.candidates = 1;
  const auto found = [&](std::span<const Se3> known) {
    for (const PoseEstimate& r : find_candidates(
             {t.sets[0], views[0], std::span(views).subspan(1), *backend}, known, options))
      for (int i = 0; i < 2; ++i) {
        const Se3 truth =
            t.scene.views[0].camera_from_world * t.scene.placed[std::size_t(i)].world_from_object;
        if (t.error(r.world_from_object, truth).passes()) return i;
      }
    return -1;
  };
  const int first = found({});
  ASSERT_GE(first, 0);
  EXPECT_EQ(found(std::vector<Se3>{t.scene.placed[std::size_t(first)].world_from_object}),
            1 - first);
}

}  // namespace
}  // namespace edgescout::test
