// What the program keeps of templates for its next runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/small_scene.h"

namespace edgescout::test {
namespace {

struct TwoRuns {
  SmallScene scene;
  fs::path cache = scene.folder.path() / "cache";

  std::vector<std::string> arguments(const std::vector<std::string>& more = {}) const {
    return scene.detect(scene.scene, joined({bracket(), {"--template-cache", cache}, more}));
  }
  Outcome detect(const std::vector<std::string>& more = {}) const {
    return run_program(arguments(more));
  }
  std::string source() const {
    const auto summary = nlohmann::json::parse(content_of(scene.out / "summary.json"));
    EXPECT_EQ(summary.at("templates").size(), 1u);
    const nlohmann::json& templates = summary["templates"].at(0);
    EXPECT_EQ(templates.at("object_id"), 1);
    EXPECT_GT(templates.at("seconds"), 0);
    return templates.at("source");
  }
  // Poses without times.
  std::string poses() const {
    auto result = nlohmann::json::parse(content_of(scene.out / "000003_000000.json"));
    return result.at("detections").dump();
  }
};

bool says(const Outcome& outcome, const std::string& words) {
  return outcome.err.find(words) != std::string::npos;
}

int entries(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), {}));
}

TEST(ProgramTemplateCache, GivesTheNextRunTheSamePoses) {
  const TwoRuns t;
  const Outcome first = t.detect();
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_TRUE(says(first, "templates built in ")) << first.err;
  EXPECT_TRUE(says(first, "templates of obj_000001: 100/100")) << first.err;
  EXPECT_EQ(t.source(), "built");
  const std::string poses = t.poses();
  EXPECT_EQ(entries(t.cache), 1);

  const Outcome second = t.detect();
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_TRUE(says(second, "templates read from the cache in ")) << second.err;
  EXPECT_FALSE(says(second, "templates of obj_000001")) << second.err;
  EXPECT_EQ(t.source(), "cache");
  EXPECT_EQ(t.poses(), poses);

  EXPECT_TRUE(says(t.detect({"--crease-angle", "30"}), "templates built in "));
  EXPECT_EQ(entries(t.cache), 2);
}

TEST(ProgramTemplateCache, IsInTheUsersCacheFolderUnlessSwitchedOff) {
  const TwoRuns t;
  const std::string environment = "XDG_CACHE_HOME='" + t.cache.string() + "'";
  const auto detect = [&](const std::vector<std::string>& more) {
    return run_program(t.scene.detect(t.scene.scene, joined({bracket(), more})), environment);
  };
  EXPECT_EQ(detect({"--no-template-cache"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(t.cache));
  EXPECT_EQ(detect({}).exit_code, 0);
  EXPECT_EQ(entries(t.cache / "edgescout/templates"), 1);
  EXPECT_EQ(t.source(), "built");
  EXPECT_EQ(detect({}).exit_code, 0);
  EXPECT_EQ(t.source(), "cache");
  EXPECT_EQ(detect({"--no-template-cache"}).exit_code, 0);
  EXPECT_EQ(t.source(), "built");
}

TEST(ProgramTemplateCache, NamesTemplateFilesAsTheSource) {
  const TwoRuns t;
  const std::string set = t.scene.folder.path() / "part.est";
  ASSERT_EQ(run_program(joined({{"model", "build", part_file(1), "--unit", "mm", "--device", "cpu",
                                 "--out", set},
                                few_templates()}))
                .exit_code,
            0);
  ASSERT_EQ(run_program(t.scene.detect(t.scene.scene, {"--templates", set})).exit_code, 0);
  EXPECT_EQ(t.source(), "file");
}

TEST(ProgramTemplateCache, GoesOnWithOneWarningWhereNothingCanBeKept) {
  const TwoRuns t;
  // Nobody, root included, creates files in /proc.
  const Outcome outcome = run_program(
      t.scene.detect(t.scene.scene, joined({few_templates(),
                                            {"--template-cache", "/proc/none", "--unit", "mm",
                                             "--model", part_file(1), part_file(2)}})));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::size_t first = outcome.err.find("warning: /proc/none");
  EXPECT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("warning: /proc/none", first + 1), std::string::npos) << outcome.err;
}

TEST(ProgramTemplateCache, ADamagedEntryIsBuiltAnew) {
  const TwoRuns t;
  ASSERT_EQ(t.detect().exit_code, 0);
  const std::string poses = t.poses();
  const fs::path entry = *fs::directory_iterator(t.cache);
  fs::resize_file(entry, fs::file_size(entry) / 2);
  const Outcome outcome = t.detect();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(says(outcome, "warning: " + entry.string())) << outcome.err;
  EXPECT_EQ(t.source(), "built");
  EXPECT_EQ(t.poses(), poses);
  ASSERT_EQ(t.detect().exit_code, 0);
  EXPECT_EQ(t.source(), "cache");
}

TEST(ProgramTemplateCache, ServesTwoProgramsAtOnce) {
  const TwoRuns t;
  const auto start = [&](const std::string& out) {
    std::vector<std::string> arguments = t.arguments();
    *std::ranges::find(arguments, t.scene.out.string()) = t.scene.folder.path() / out;
    return start_program(arguments);
  };
  const pid_t one = start("one"), two = start("two");
  for (const pid_t child : {one, two}) {
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  EXPECT_EQ(entries(t.cache), 1);
  EXPECT_EQ(t.detect().exit_code, 0);
  EXPECT_EQ(t.source(), "cache");
}

TEST(ProgramTemplateCache, RemovesWhatExceedsItsSize) {
  const TwoRuns t;
  ASSERT_EQ(t.detect({"--template-cache-size", "1e-6"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(t.cache));
  expect_refused(t.arguments({"--template-cache-size", "-1"}), {"--template-cache-size"});
}

TEST(ProgramTemplateCache, IsThatOfEveryVerbThatBuildsTemplates) {
  const TwoRuns t;
  const std::vector<std::string> explain =
      joined({{"explain", t.scene.scene, "--truth", "--device", "cpu", "--coarse-poses", "50",
               "--template-cache", t.cache},
              bracket()});
  EXPECT_TRUE(says(run_program(explain), "templates built in "));
  EXPECT_TRUE(says(run_program(explain), "templates read from the cache in "));
  for (const char* verb : {"scout", "explain", "detect"})
    EXPECT_NE(run_program({verb, "--help-all"}).out.find("--no-template-cache"), std::string::npos);
}

}  // namespace
}  // namespace edgescout::test
