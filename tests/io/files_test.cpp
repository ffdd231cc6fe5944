#include "host/io/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>

#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

TEST(ReadFile, ReturnsEveryByte) {
  const TemporaryFolder folder;
  const std::string bytes("a\0b\r\n\xff", 6);
  EXPECT_EQ(read_file(folder.write("x.bin", bytes)), bytes);
  EXPECT_EQ(read_file(folder.write("empty", "")), "");
}

TEST(ReadFile, NamesAMissingFileAndAFolder) {
  const TemporaryFolder folder;
  expect_input_error([&] { read_file(folder.path() / "none.txt"); }, {"none.txt", "No such file"});
  expect_input_error([&] { read_file(folder.path()); }, {folder.path().filename(), "a folder"});
}

TEST(WriteFileAtomically, WritesAndReplacesAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "result.json";
  write_file_atomically(file, "first");
  write_file_atomically(file, std::string(100000, 'x'));
  EXPECT_EQ(content_of(file), std::string(100000, 'x'));
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, IsTheWholeFileOrNone) {
  const TemporaryFolder folder;
  const auto file = folder.write("report.html", "old");
  {
    AtomicFile whole(file);
    whole.write("new, ");
    whole.write("but not finished");
    EXPECT_EQ(content_of(file), "old");
  }
  EXPECT_EQ(content_of(file), "old");
  EXPECT_EQ(folder.entries(), 1u);
  AtomicFile whole(file);
  for (const char* part : {"new, ", "", "finished"}) whole.write(part);
  whole.finish();
  EXPECT_EQ(content_of(file), "new, finished");
  EXPECT_EQ(folder.entries(), 1u);
  AtomicFile nowhere(folder.path() / "no" / "r.html");
  expect_input_error([&] { nowhere.write("x"); }, {"r.html", "No such file"});
}

// In a container every run has the same process id, and counts its files from 0.
TEST(WriteFileAtomically, PassesOverWhatAKilledRunLeft) {
  const TemporaryFolder folder;
  const int left = 1000;  // more than this process has written
  for (int i = 0; i < left; ++i)
    for (const char* name : {"result.json", "probe"})
      folder.write(
          (std::ostringstream() << "." << name << "." << ::getpid() << "-" << i << ".part").str(),
          "left");
  write_file_atomically(folder.path() / "result.json", "new");
  require_writable_folder(folder.path());
  EXPECT_EQ(content_of(folder.path() / "result.json"), "new");
  EXPECT_EQ(folder.entries(), 2u * left + 1);
}

TEST(WriteFileAtomically, FailsWhereTheFolderIsMissingOrAFile) {
  const TemporaryFolder folder;
  folder.write("plain", "");
  expect_input_error([&] { write_file_atomically(folder.path() / "no" / "r.json", "x"); },
                     {"r.json", "No such file"});
  expect_input_error([&] { write_file_atomically(folder.path() / "plain" / "r.json", "x"); },
                     {"r.json", "Not a directory"});
}

TEST(WriteFileAtomically, LeavesNothingWhereTheTargetIsAFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "r.json");
  expect_input_error([&] { write_file_atomically(folder.path() / "r.json", "x"); },
                     {"r.json", "directory"});
  EXPECT_EQ(folder.entries(), 1u);
}

// write() fails after some bytes, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit now{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_{};
  void (*old_handler_)(int);
};

TEST(WriteFileAtomically, KeepsTheOldFileWhereTheNewOneFindsNoRoom) {
  const TemporaryFolder folder;
  const auto file = folder.write("result.json", "old");
  {
    const FileSizeLimit full(4096);
    expect_input_error([&] { write_file_atomically(file, std::string(100000, 'x')); },
                       {"result.json", "File too large"});
  }
  EXPECT_EQ(content_of(file), "old");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(RequireWritableFolder, CreatesItAndLeavesItEmpty) {
  const TemporaryFolder folder;
  require_writable_folder(folder.path() / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path() / "a" / "b"));
}

TEST(RequireWritableFolder, RemovesTemporaryFilesOfKilledRunsAndNoOthers) {
  const TemporaryFolder folder;
  const auto old = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
  const auto make = [&](const char* name) {
    std::filesystem::path file = folder.path() / name;
    std::ofstream(file) << "half";
    std::filesystem::last_write_time(file, old);
    return file;
  };
  const std::filesystem::path abandoned = make(".a.json.7-0.part"),
                              in_use = make(".b.json.7-1.part"), of_the_user = make("notes.part"),
                              result = make("a.json");
  const std::filesystem::path fresh = folder.path() / ".c.json.7-2.part";
  std::ofstream(fresh) << "half";
  const int descriptor = ::open(in_use.c_str(), O_RDONLY);
  ASSERT_EQ(::flock(descriptor, LOCK_EX), 0);
  require_writable_folder(folder.path());
  ::close(descriptor);
  EXPECT_FALSE(exists(abandoned));
  for (const auto& kept : {in_use, of_the_user, result, fresh}) EXPECT_TRUE(exists(kept)) << kept;
}

TEST(RequireWritableFolder, FailsUnderAFileAndWhereNothingMayBeWritten) {
  const TemporaryFolder folder;
  folder.write("plain", "");
  expect_input_error([&] { require_writable_folder(folder.path() / "plain"); },
                     {"plain", "output folder"});
  expect_input_error([&] { require_writable_folder(folder.path() / "plain" / "x"); },
                     {"plain/x", "output folder"});
  // Nobody, root included, creates files there.
  expect_input_error([&] { require_writable_folder("/proc"); }, {"/proc", "output folder"});
  expect_input_error([&] { require_writable_folder("/proc/none"); },
                     {"/proc/none", "output folder"});
}

TEST(RequireWritableFolder, FailsWithoutPermission) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "locked");
  std::filesystem::permissions(folder.path() / "locked", std::filesystem::perms::owner_read);
  expect_input_error([&] { require_writable_folder(folder.path() / "locked"); },
                     {"locked", "Permission denied"});
}

}  // namespace
}  // namespace edgescout::test
