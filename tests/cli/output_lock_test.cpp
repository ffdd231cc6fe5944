// Every verb that writes a folder leaves one alone that another program writes.
#include <gtest/gtest.h>

#include "host/io/folder_lock.h"
#include "tests/cli/small_scene.h"

namespace edgescout::test {
namespace {

TEST(OutputLock, IsRespectedByEveryVerb) {
  const SmallScene t;
  fs::create_directories(t.out);
  const FolderLock held(t.out);
  const std::string poses = t.folder.write(
      "poses.json", R"([{"image": 0, "scene": 3, "object": 1, "R": [1, 0, 0, 0, 1, 0, 0, 0, 1],
                         "t": [0, 0, 0.3]}])");
  const std::vector<std::string> model{"--model", part_file(1), "--unit", "mm"},
      out{"--out", t.out};
  const std::vector<std::vector<std::string>> calls{
      t.detect(t.scene, bracket()),
      joined({{"register", t.scene, "--poses", poses, "--device", "cpu"}, model, out}),
      joined({{"explain", t.scene, "--truth", "--device", "cpu"}, bracket(), out}),
      joined({{"scout", "cell", "--device", "cpu", "--objects", "1"}, bracket(), out}),
      joined({{"render", "--part", "l_bracket"}, out}),
      joined({{"merge", t.folder.path() / "shard"}, out}),
      joined({{"bench", "experiments", "detection"}, out}),
      joined({{"bench", "devices", "--device", "cpu-reference"}, out})};
  const std::string holder =
      "output folder: found it in use by process " + std::to_string(::getpid()) + " on host ";
  for (const std::vector<std::string>& call : calls) {
    SCOPED_TRACE(call[0] + " " + call[1]);
    expect_refused(call, {t.out, holder, "another --out"});
  }
  EXPECT_TRUE(fs::exists(t.out / ".edgescout.lock")) << "the holder's";
  EXPECT_EQ(std::distance(fs::directory_iterator(t.out), fs::directory_iterator()), 1);
}

TEST(OutputLock, IsFreedWhenItsHolderIsKilled) {
  const SmallScene t;
  const fs::path lock = t.out / ".edgescout.lock";
  ASSERT_TRUE(run_program_until(t.detect(t.scene, bracket()), [&] { return fs::exists(lock); }));
  ASSERT_TRUE(fs::exists(lock));
  const Outcome outcome = run_program(t.detect(t.scene, bracket()));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(lock));
}

}  // namespace
}  // namespace edgescout::test
