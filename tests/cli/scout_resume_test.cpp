// edgescout scout taken up again, and what it does with the results of a run before.
#include <gtest/gtest.h>

#include "tests/cli/small_scout.h"

namespace edgescout::test {
namespace {

TEST(Scout, KilledItGoesOnToTheSameEnd) {
  const SmallScout whole, t;
  ASSERT_EQ(run_program(whole.arguments()).exit_code, 0);
  ASSERT_TRUE(run_program_until(t.arguments({"--watch"}),
                                [&] { return fs::exists(t.out / "scout.html"); }));
  expect_self_contained(t.page());
  EXPECT_NE(t.page().find("<meta http-equiv=refresh"), std::string::npos);
  const std::size_t steps = t.log().at("steps").size();
  EXPECT_EQ(steps, 1u);

  ASSERT_EQ(run_program(t.arguments({"--resume"})).exit_code, 0);
  const nlohmann::json a = whole.log(), b = t.log();
  ASSERT_EQ(a.at("steps").size(), b.at("steps").size());
  for (std::size_t i = 0; i < a["steps"].size(); ++i)
    for (const char* field : {"view", "information", "entropy_nats", "modes", "extrinsics_checks"})
      EXPECT_EQ(a["steps"][i].at(field), b["steps"][i].at(field)) << i << field;
  EXPECT_EQ(a.at("detections"), b.at("detections"));
}

// Other parts may lie under the same views: their images give no information about these.
TEST(Scout, DoesNotGoOnInAnotherCell) {
  const SmallScout t;
  ASSERT_EQ(run_program(t.arguments()).exit_code, 0);
  const std::string before = content_of(t.out / "scout.json");
  expect_refused(t.arguments({"--resume", "--seed", "2"}),
                 {"scout.json", "seed", "found 1", "expected 2"});
  expect_refused(t.arguments({"--resume", "--arm-tells"}), {"scout.json", "arm-tells"});
  expect_refused(t.arguments({"--resume", "--sigma", "3"}),
                 {"scout.json", "sigma", "found 4", "expected 3"});
  expect_refused(t.arguments({"--resume", "--lambda", "50"}), {"scout.json", "lambda"});
  std::vector<std::string> farther = t.arguments({"--resume"});
  *(std::ranges::find(farther, "--radius") + 1) = "0.31";
  expect_refused(farther, {"scout.json", "radius", "0.31"});
  EXPECT_EQ(content_of(t.out / "scout.json"), before);
  // Budget and the way to choose are free.
  std::vector<std::string> longer = t.arguments({"--resume", "--strategy", "random"});
  *(std::ranges::find(longer, "--max-views") + 1) = "3";
  *(std::ranges::find(longer, "--combinations") + 1) = "100";
  EXPECT_EQ(run_program(longer).exit_code, 0);
  EXPECT_EQ(t.log().at("steps").size(), 3u);
}

TEST(Scout, DoesNotGoOnFromALogOfTheFormerVersion) {
  const SmallScout t;
  ASSERT_EQ(run_program(t.arguments()).exit_code, 0);
  nlohmann::json log = t.log();
  EXPECT_EQ(log.at("edgescout_scout"), 2);
  log["edgescout_scout"] = 1;
  std::ofstream(t.out / "scout.json") << log.dump();
  expect_refused(t.arguments({"--resume"}), {"scout.json", "found version 1, expected 2"});
}

// Nor with what was built to look for another way: what was not found then might be now.
TEST(Scout, DoesNotGoOnWithOtherTemplates) {
  const TemporaryFolder folder;
  const auto build = [&](const char* name, const char* viewpoints) {
    std::string file = folder.path() / name;
    EXPECT_EQ(run_program({"model", "build", part_file(1), "--unit", "mm", "--out", file,
                           "--device", "cpu", "--viewpoints", viewpoints, "--in-plane-steps", "8",
                           "--distance-min", "0.27", "--distance-max", "0.33"})
                  .exit_code,
              0);
    return file;
  };
  const auto arguments = [&](const std::string& templates, const std::vector<std::string>& more) {
    return joined({{"scout",          "cell", "--out",        folder.path() / "out",
                    "--device",       "cpu",  "--templates",  templates,
                    "--width",        "320",  "--height",     "240",
                    "--focal",        "400",  "--objects",    "1",
                    "--clutter",      "0",    "--radius",     "0.3",
                    "--view-count",   "4",    "--max-views",  "1",
                    "--coarse-poses", "100",  "--candidates", "4",
                    "--particles",    "20"},
                   more});
  };
  const std::string coarse = build("coarse.est", "1"), fine = build("fine.est", "2");
  ASSERT_EQ(run_program(arguments(coarse, {})).exit_code, 0);
  expect_refused(arguments(fine, {"--resume"}),
                 {"scout.json", "templates of object 1", "frequency 1"});
  EXPECT_EQ(run_program(arguments(coarse, {"--resume"})).exit_code, 0);
}

// What a run before left would pass for this one's.
TEST(Scout, RemovesTheResultsOfARunBefore) {
  const SmallScout t;
  const auto follow = [&](const char* second) {
    ASSERT_EQ(
        run_program(t.arguments({"--strategy", "fixed", "--sequence", "0", second})).exit_code, 0);
  };
  follow("5");
  EXPECT_TRUE(fs::exists(t.out / "view_005.json"));
  std::ofstream(t.out / "notes.txt") << "mine";
  follow("3");
  EXPECT_FALSE(fs::exists(t.out / "view_005.json"));
  EXPECT_TRUE(fs::exists(t.out / "view_003.json"));
  EXPECT_TRUE(fs::exists(t.out / "notes.txt"));
}

TEST(Scout, DoesNotGoOnInAnotherFolder) {
  const SmallScene scene(2);
  const fs::path other = scene.folder.path() / "other" / scene.scene.filename();
  fs::create_directories(other.parent_path());
  fs::copy(scene.scene, other, fs::copy_options::recursive);
  const auto arguments = [&](const fs::path& folder, const std::vector<std::string>& more) {
    return joined({{"scout", folder, "--out", scene.out, "--device", "cpu", "--coarse-poses", "200",
                    "--max-views", "1", "--min-probability", "0.1"},
                   bracket(),
                   more});
  };
  ASSERT_EQ(run_program(arguments(scene.scene, {})).exit_code, 0);
  expect_refused(arguments(other, {"--resume"}), {"scout.json", "source", scene.scene, other});
  expect_refused(arguments(scene.scene, {"--resume", "--camera", scene.camera("500")}),
                 {"scout.json", "camera", "found its own"});
  EXPECT_EQ(run_program(arguments(scene.scene / "", {"--resume"})).exit_code, 0)
      << "the same folder";
}

}  // namespace
}  // namespace edgescout::test
