// Where results cannot be written, and options out of range: exit code 2, one line, nothing half
// written.
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace edgescout::test {
namespace {

std::vector<std::string> render_to(const std::string& folder,
                                   const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"render", "--part",  "hex_nut", "--objects", "1",  "--clutter",
                                     "0",      "--width", "96",      "--height",  "64", "--out"};
  arguments.push_back(folder);
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

void expect_refused_in_one_line(const Outcome& outcome, std::initializer_list<std::string> words) {
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_TRUE(is_one_line_error(outcome.err)) << outcome.err;
  for (const std::string& word : words)
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " not in " << outcome.err;
}

TEST(Output, IntoAFolderThatCannotBeWritten) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  expect_refused_in_one_line(run_program(render_to("/proc")), {"/proc", "output folder"});
  expect_refused_in_one_line(run_program(render_to(file)), {file, "output folder"});
  expect_refused_in_one_line(run_program(render_to(file + "/below")), {file, "output folder"});
}

TEST(Output, OntoAFullDiskLeavesNoPieces) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_program(render_to(folder.path() / "good")).exit_code, 0);
  // Files of more than 1 KiB cannot be written then; the shell counts in blocks of 512 bytes.
  const Outcome outcome = run_program(render_to(folder.path() / "full"), "ulimit -f 2;");
  expect_refused_in_one_line(outcome, {(folder.path() / "full").string(), "File too large"});
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path() / "full")) {
    const auto twin =
        folder.path() / "good" / std::filesystem::relative(entry.path(), folder.path() / "full");
    EXPECT_TRUE(std::filesystem::exists(twin)) << "left behind: " << entry.path();
    if (entry.is_regular_file()) {
      EXPECT_EQ(content_of(entry.path()), content_of(twin));
    }
  }
}

TEST(Output, MixesNoScenesOfTwoRuns) {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  ASSERT_EQ(run_program(render_to(out, {"--scenes", "2", "--views", "2"})).exit_code, 0);
  EXPECT_EQ(run_program(render_to(out, {"--scenes", "2", "--views", "2"})).exit_code, 0)
      << "the same again";
  const std::string before = content_of(out / "000000/scene_gt.json");
  expect_refused_in_one_line(run_program(render_to(out, {"--views", "2", "--seed", "9"})),
                             {out.string(), "scene 000001", "another --out"});
  expect_refused_in_one_line(run_program(render_to(out, {"--scenes", "2", "--seed", "9"})),
                             {out.string(), "of 2 images", "another --out"});
  EXPECT_EQ(content_of(out / "000000/scene_gt.json"), before);
}

TEST(Output, IsNotTouchedWhereAnOptionIsOutOfRange) {
  const TemporaryFolder folder;
  const auto out = folder.path() / "out";
  expect_refused_in_one_line(run_program(render_to(out, {"--noise", "51"})),
                             {"--noise", "found 51", "0 to 50"});
  expect_refused_in_one_line(run_program(render_to(out, {"--blur", "nan"})),
                             {"--blur", "found nan", "0 to 10"});
  expect_refused_in_one_line(run_program(render_to(out, {"--views", "0"})),
                             {"--views", "found 0", "1 to 50"});
  expect_refused_in_one_line(
      run_program(render_to(out, {"--config", folder.write("c.yaml", "noise: -1\n")})),
      {"--noise", "found -1", "0 to 50"});
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace edgescout::test
