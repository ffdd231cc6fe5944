// edgescout explain: the stage table, the summary, the files, and requests that cannot be met.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/small_scene.h"

namespace edgescout::test {
namespace {

std::vector<std::string> explain(const fs::path& input, const std::vector<std::string>& more) {
  return joined({{"explain", input, "--device", "cpu", "--coarse-poses", "200"}, bracket(), more});
}

// R by row and t of the true pose in an image, as --pose takes them.
std::vector<std::string> true_pose(const SmallScene& small, int image = 0) {
  const Se3 pose = load_bop_scene(small.scene).truth.at(image)[0].camera_from_object;
  const Eigen::Matrix3d r = pose.rotation.toRotationMatrix();
  std::vector<std::string> numbers;
  for (int i = 0; i < 9; ++i) numbers.push_back(std::to_string(r(i / 3, i % 3)));
  for (int i = 0; i < 3; ++i) numbers.push_back(std::to_string(pose.translation_m[i]));
  return numbers;
}

void expect_words(const std::string& text, std::initializer_list<std::string> words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << word << " not in " << text;
}

TEST(Explain, WritesATableOfStagesForOnePose) {
  const SmallScene small;
  const std::vector<std::string> pose = true_pose(small);
  const auto of_image = [&](const std::vector<std::string>& more) {
    return run_program(
        joined({explain(small.image(), {"--camera", small.camera(), "--pose"}), pose, more}));
  };
  const Outcome found = of_image({});
  ASSERT_EQ(found.exit_code, 0) << found.err;
  expect_words(found.out, {"object 1: reported", "range", "edges", "scan", "alignment", "ranking",
                           "refinement", "probability", "selection    passed"});
  EXPECT_EQ(found.out.find("LOST"), std::string::npos) << found.out;
  const Outcome lost = of_image({"--min-probability", "0.9999"});
  ASSERT_EQ(lost.exit_code, 0) << lost.err;
  expect_words(lost.out, {"object 1: lost at probability", "probability  LOST", "selection    -"});
}

TEST(Explain, SumsUpTheTruePosesOfAScene) {
  const SmallScene small(2);
  const Outcome outcome = run_program(explain(small.scene, {"--truth", "--out", small.out}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_words(outcome.out, {"000000.png, object 1: reported", "000001.png, object 1: ",
                             "object  given reported", "     1      2 ", "   all      2 "});
  const nlohmann::json result = nlohmann::json::parse(content_of(small.out / "explain.json"));
  EXPECT_EQ(result["edgescout_explain"], 1);
  EXPECT_EQ(result["same_pose"]["max_angle_rad"], 0.1);
  EXPECT_EQ(result["summary"]["all"]["given"], 2);
  ASSERT_EQ(result["poses"].size(), 2u);
  std::map<std::string, int> lost_at;
  for (int image : {0, 1}) {
    const nlohmann::json& pose = result["poses"][std::size_t(image)];
    EXPECT_EQ(pose["scene_id"], 3);
    EXPECT_EQ(pose["image_id"], image);
    EXPECT_EQ(pose["camera_from_object"]["R"].size(), 9u);
    EXPECT_GE(pose["scan"]["rank"], 1);
    ++lost_at[pose["lost_at"]];
  }
  for (const char* object : {"1", "all"})
    for (const auto& [stage, count] : result["summary"][object].items())
      EXPECT_EQ(count, stage == "given" ? 2 : lost_at[stage]) << object << " " << stage;
  const nlohmann::json& reported = result["poses"][0];
  EXPECT_EQ(reported["lost_at"], "reported");
  EXPECT_LT(reported["refinement"]["same"]["angle_rad"], 0.1);
  EXPECT_LE(reported["selection"]["rank"], 2) << "a pose on the shadow may be as probable";
  EXPECT_TRUE(reported["rival"].is_null());
  EXPECT_GT(load_image(small.out / reported["picture"].get<std::string>()).width, 100);
}

TEST(Explain, DrawsThePoseThatTookThePlace) {
  const SmallScene small;
  const auto names_rival = [&](const std::vector<std::string>& more) {
    const Outcome outcome =
        run_program(explain(small.scene, joined({{"--truth", "--out", small.out}, more})));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out.find("its place took") != std::string::npos;
  };
  EXPECT_FALSE(names_rival({}));
  const std::string plain = content_of(small.out / "000003_000000_0.png");
  EXPECT_TRUE(names_rival({"--max-angle", "1e-5", "--max-distance", "1e-6"}));
  EXPECT_NE(content_of(small.out / "000003_000000_0.png"), plain);
  const nlohmann::json pose =
      nlohmann::json::parse(content_of(small.out / "explain.json"))["poses"][0];
  EXPECT_EQ(pose["lost_at"], "alignment");
  EXPECT_GT(pose["rival"]["distance_m"], 1e-6);
}

TEST(Explain, GoesOnWithoutPosesThatNoImageShows) {
  const SmallScene small;
  std::vector<BopResult> poses = true_results(load_bop_scene(small.scene), 0);
  poses.push_back(poses[0]);
  poses[1].camera_from_object.translation_m.x() += 2;
  const fs::path file = small.folder.path() / "poses.csv";
  save_bop_results(poses, file);
  const Outcome outcome = run_program(explain(small.scene, {"--poses", file}));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  expect_words(outcome.out, {"object 1: reported"});
  expect_words(outcome.err, {"the image shows no edge"});
  save_bop_results({poses[1]}, file);
  EXPECT_EQ(run_program(explain(small.scene, {"--poses", file})).exit_code, 2);
}

TEST(Explain, RefusesWhatIsNoPose) {
  const SmallScene small;
  const std::vector<std::string> pose = true_pose(small);
  const auto refused = [&](const std::vector<std::string>& more,
                           std::initializer_list<std::string> words) {
    expect_refused(explain(small.scene, joined({more, {"--log-level", "error"}})), words);
  };
  const auto with = [&](std::size_t index, const std::string& number) {
    std::vector<std::string> changed = pose;
    changed[index] = number;
    return joined({{"--pose"}, changed});
  };
  refused({}, {"--pose, --poses, --truth", "none"});
  refused(joined({{"--truth", "--pose"}, pose}), {"more than one"});
  refused({"--pose", "1", "2"}, {"--pose"});
  refused(with(0, "3"), {"no rotation"});
  refused(with(3, "nan"), {"--pose: found nan, expected -100 to 100 m"});
  refused(with(11, "-0.3"), {"behind the camera"});
  refused({"--truth", "--min-visible", "1.5"}, {"--min-visible"});
  refused({"--truth", "--max-angle", "0"}, {"--max-angle"});
  expect_refused(
      explain(small.image(), {"--camera", small.camera(), "--truth", "--log-level", "error"}),
      {"ground truth", "scene_gt.json"});
  const SmallScene two(2);
  expect_refused(explain(two.scene, joined({{"--log-level", "error", "--pose"}, true_pose(two)})),
                 {"2 images and 1 models", "--poses"});
}

}  // namespace
}  // namespace edgescout::test
