#include "host/io/folder_lock.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>

#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

namespace fs = std::filesystem;

TEST(FolderLock, RefusesASecondHolderAndNamesTheFirst) {
  const TemporaryFolder folder;
  const FolderLock first(folder.path());
  const std::string holder = "process " + std::to_string(::getpid()) + " on host ";
  expect_input_error([&] { const FolderLock second(folder.path()); },
                     {folder.path().string(), "output folder", "in use by " + holder});
  EXPECT_TRUE(holder_of(folder.path()).value_or("").starts_with(holder));
}

TEST(FolderLock, LeavesNothingBehind) {
  const TemporaryFolder folder;
  { const FolderLock lock(folder.path() / "a/b"); }
  EXPECT_FALSE(fs::exists(folder.path() / "a")) << "it made them, and they are empty";
  fs::create_directories(folder.path() / "c");
  { const FolderLock lock(folder.path() / "c/d"); }
  EXPECT_TRUE(fs::is_empty(folder.path() / "c")) << "it was there before";
  {
    const FolderLock lock(folder.path() / "e");
    folder.write("e/result", "x");
  }
  EXPECT_TRUE(fs::exists(folder.path() / "e/result"));
  EXPECT_FALSE(fs::exists(folder.path() / "e/.edgescout.lock"));
  EXPECT_FALSE(holder_of(folder.path() / "e"));
}

// A child that dies holds nothing, and its lock's file is in nobody's way.
TEST(FolderLock, IsFreedByACrash) {
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock(folder.path());
    ::_exit(0);  // without destructors
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(fs::exists(folder.path() / ".edgescout.lock"));
  EXPECT_FALSE(holder_of(folder.path()));
  { const FolderLock lock(folder.path()); }
  EXPECT_FALSE(fs::exists(folder.path() / ".edgescout.lock"));
}

// Of many that want it at once and let go again, never two have it.
TEST(FolderLock, IsHeldByOneOfManyProcesses) {
  const TemporaryFolder folder;
  const auto take_turns = [&] {
    for (int turn = 0; turn < 200; ++turn) {
      try {
        const FolderLock lock(folder.path());
        if (!fs::create_directory(folder.path() / "inside")) ::_exit(1);
        fs::remove(folder.path() / "inside");
      } catch (const InputError&) {
      }
    }
    ::_exit(0);
  };
  std::vector<pid_t> children;
  for (int i = 0; i < 4; ++i)
    if (children.push_back(::fork()); children.back() == 0) take_turns();
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(WEXITSTATUS(status), 0) << "two were inside";
  }
}

TEST(FolderLock, RemovesWhatKilledRunsLeft) {
  const TemporaryFolder folder;
  folder.write(".a.json.7-0.part", "cut");
  fs::create_directories(folder.path() / "scene/gray");
  folder.write("scene/gray/.b.png.7-1.part", "cut");
  folder.write("scene/gray/b.png", "whole");
  { const FolderLock lock(folder.path()); }
  EXPECT_FALSE(fs::exists(folder.path() / ".a.json.7-0.part"));
  EXPECT_TRUE(fs::exists(folder.path() / "scene/gray/.b.png.7-1.part")) << "a folder in it";
  {
    const FolderLock in_use(folder.path() / "scene");
    const FolderLock lock(folder.path(), 2);
    EXPECT_TRUE(fs::exists(folder.path() / "scene/gray/.b.png.7-1.part")) << "held by another";
  }
  { const FolderLock lock(folder.path(), 2); }
  EXPECT_FALSE(fs::exists(folder.path() / "scene/gray/.b.png.7-1.part"));
  EXPECT_TRUE(fs::exists(folder.path() / "scene/gray/b.png"));
}

TEST(FolderLock, NamesAFolderThatCannotBeMade) {
  const TemporaryFolder folder;
  folder.write("file", "x");
  expect_input_error([&] { const FolderLock lock(folder.path() / "file/out"); },
                     {"file/out", "output folder", "Not a directory"});
}

}  // namespace
}  // namespace edgescout::test
