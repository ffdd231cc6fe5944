// Entries of the file cache: whole or not there, whatever happens to their files.
#include "host/io/file_cache.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "tests/io/collected_log.h"
#include "tests/io/temporary_folder.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

namespace fs = std::filesystem;

constexpr BinaryFormat test_format{{'T', 'E', 'S', 'T', 'F', 'I', 'L', 'E'}, 1, "test file"};
constexpr std::uint64_t roomy = 1 << 30;

void put(FileCache& cache, const std::string& key, const std::string& content) {
  cache.write(key, [&](BinaryWriter& out) { out.put_text(content); });
}

// Empty: no entry.
std::string got(const FileCache& cache, const std::string& key) {
  std::string content;
  const bool found = cache.read(key, [&](BinaryReader& in) { content = in.get_text(); });
  return found ? content : "";
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& file : fs::directory_iterator(folder))
    files.push_back(file.path());
  return files;
}

void age(const fs::path& file, int hours) {
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
}

TEST(FileCache, ReturnsWhatWasWrittenWithTheKey) {
  const TemporaryFolder folder;
  FileCache cache(folder.path() / "made" / "by it", test_format, roomy);
  EXPECT_EQ(got(cache, "a"), "");
  put(cache, "a", "content of a");
  put(cache, "b", "content of b");
  EXPECT_EQ(got(cache, "a"), "content of a");
  EXPECT_EQ(got(cache, "b"), "content of b");
  EXPECT_EQ(got(cache, "ab"), "");
  put(cache, "a", "another");
  EXPECT_EQ(got(FileCache(folder.path() / "made" / "by it", test_format, roomy), "a"), "another");
  EXPECT_EQ(files_in(folder.path() / "made" / "by it").size(), 2u);
}

TEST(FileCache, WithoutAFolderOrRoomKeepsNothing) {
  const CollectedLog log;
  FileCache nowhere({}, test_format, roomy);
  put(nowhere, "a", "content");
  EXPECT_EQ(got(nowhere, "a"), "");
  const TemporaryFolder folder;
  FileCache full(folder.path() / "full", test_format, 10);
  put(full, "a", std::string(11, 'x'));
  EXPECT_EQ(got(full, "a"), "");
  EXPECT_FALSE(fs::exists(folder.path() / "full"));
  EXPECT_TRUE(log.messages.empty());
}

// The entry of "a" is replaced by `bytes`. It must be as none, with one warning, and be
// replaceable.
void expect_made_anew(const TemporaryFolder& folder, const std::string& bytes) {
  FileCache cache(folder.path(), test_format, roomy);
  const fs::path file = cache.file_of("a");
  folder.write(file.filename().string(), bytes);
  {
    const CollectedLog log;
    EXPECT_EQ(got(cache, "a"), "");
    ASSERT_EQ(log.messages.size(), 1u);
    EXPECT_EQ(log.messages[0].first, LogLevel::Warning);
    EXPECT_NE(log.messages[0].second.find(file.string()), std::string::npos);
    EXPECT_TRUE(log.messages[0].second.ends_with("it is made anew")) << log.messages[0].second;
  }
  put(cache, "a", "content of a");
  EXPECT_EQ(got(cache, "a"), "content of a");
}

TEST(FileCache, DamagedEntriesAreAsNone) {
  const TemporaryFolder folder;
  FileCache cache(folder.path(), test_format, roomy);
  put(cache, "a", "content of a");
  put(cache, "b", "content of b");
  const std::string whole = content_of(cache.file_of("a"));
  Random random = test_random();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string bad = whole;
    bad[at] = static_cast<char>(bad[at] ^ (1 << random.below(8)));
    expect_made_anew(folder, bad);
    expect_made_anew(folder, whole.substr(0, at));
  }
  expect_made_anew(folder, whole + "x");
  expect_made_anew(folder, "a file of another program");
  expect_made_anew(folder, content_of(cache.file_of("b")));  // whole, of another key
}

TEST(FileCache, WhatCannotBeReadAsItsContentIsAsNone) {
  const TemporaryFolder folder;
  FileCache cache(folder.path(), test_format, roomy);
  cache.write("a", [](BinaryWriter& out) { out.put(std::uint64_t{1000}); });  // of a long text
  const CollectedLog log;
  EXPECT_EQ(got(cache, "a"), "");
  cache.write("a", [](BinaryWriter& out) { out.put_text("text"), out.put(1); });
  EXPECT_EQ(got(cache, "a"), "");
  EXPECT_EQ(log.messages.size(), 2u);
}

TEST(FileCache, AFolderInTheEntrysPlaceIsLoggedOnce) {
  const TemporaryFolder folder;
  FileCache cache(folder.path(), test_format, roomy);
  fs::create_directory(cache.file_of("a"));
  const CollectedLog log;
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(got(cache, "a"), "");
    put(cache, "a", "content");
  }
  EXPECT_EQ(log.messages.size(), 1u);
}

TEST(FileCache, RemovesTheLeastRecentlyUsedEntries) {
  const TemporaryFolder folder;
  FileCache cache(folder.path(), test_format, 3500);  // three entries of 1,000 bytes and a bit
  const std::string content(1000, 'x');
  int hours = 10;
  for (const char* key : {"a", "b", "c"}) {
    put(cache, key, content);
    age(cache.file_of(key), hours--);
  }
  EXPECT_EQ(got(cache, "a"), content);  // now the most recently used one
  put(cache, "d", content);
  EXPECT_EQ(got(cache, "b"), "");
  for (const char* kept : {"a", "c", "d"}) EXPECT_EQ(got(cache, kept), content) << kept;
  put(cache, "e", std::string(3000, 'x'));
  EXPECT_EQ(files_in(folder.path()).size(), 1u);
  EXPECT_NE(got(cache, "e"), "");
}

TEST(FileCache, LeavesFilesOfOthersAlone) {
  const TemporaryFolder folder;
  const std::string digits(64, 'a');
  for (const std::string& name : {std::string("part.templates"), digits, digits + ".cached.txt",
                                  std::string(64, 'g') + ".cached"})
    age(folder.write(name, std::string(10000, 'x')), 100);
  FileCache cache(folder.path(), test_format, 3000);
  put(cache, "a", std::string(1000, 'x'));
  put(cache, "b", std::string(1000, 'x'));
  EXPECT_EQ(files_in(folder.path()).size(), 6u);
}

TEST(FileCache, AFolderThatCannotBeMadeIsLoggedOnce) {
  FileCache cache("/proc/none", test_format, roomy);  // nobody, root included, creates files there
  const CollectedLog log;
  for (const char* key : {"a", "b"}) {
    put(cache, key, "content");
    EXPECT_EQ(got(cache, key), "");
  }
  ASSERT_EQ(log.messages.size(), 1u);
  EXPECT_EQ(log.messages[0].first, LogLevel::Warning);
  EXPECT_NE(log.messages[0].second.find("/proc/none"), std::string::npos);
}

TEST(FileCache, AReadOnlyFolderIsReadAndLoggedOnce) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  FileCache cache(folder.path() / "locked", test_format, roomy);
  put(cache, "a", "content");
  fs::permissions(folder.path() / "locked", fs::perms::owner_read | fs::perms::owner_exec);
  const CollectedLog log;
  put(cache, "b", "content");
  put(cache, "c", "content");
  EXPECT_EQ(got(cache, "a"), "content");
  EXPECT_EQ(got(cache, "b"), "");
  EXPECT_EQ(log.messages.size(), 1u);
  fs::permissions(folder.path() / "locked", fs::perms::owner_all);
}

TEST(FileCache, OnAFullDiskKeepsWhatIsThere) {
  const TemporaryFolder folder;
  FileCache cache(folder.path(), test_format, roomy);
  put(cache, "a", "content");
  rlimit old{};
  ::getrlimit(RLIMIT_FSIZE, &old);
  const rlimit little{4096, old.rlim_max};
  const auto old_handler = ::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &little);
  const CollectedLog log;
  for (const char* key : {"a", "b"}) put(cache, key, std::string(100000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &old);
  ::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(got(cache, "a"), "content");
  EXPECT_EQ(got(cache, "b"), "");
  EXPECT_EQ(files_in(folder.path()).size(), 1u);
  EXPECT_EQ(log.messages.size(), 1u);
}

// The exit code of a child that does the work. -1: it was killed.
int exit_code_of(pid_t child) {
  int status = 0;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

pid_t in_another_process(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  return child;
}

std::string content_with(int number) { return std::string(20000, static_cast<char>('a' + number)); }

// Writes and reads entries that other processes write, read and remove, too. Returns the number of
// warnings and wrong contents.
int use(const fs::path& folder, int first) {
  const CollectedLog log;
  FileCache cache(folder, test_format, 50000);  // two of the four entries
  int wrong = 0;
  for (int i = 0; i < 200; ++i) {
    const int number = (first + i) % 4;
    const std::string found = got(cache, std::to_string(number));
    wrong += !found.empty() && found != content_with(number);
    if (found.empty()) put(cache, std::to_string(number), content_with(number));
  }
  return wrong + static_cast<int>(log.messages.size());
}

TEST(FileCache, IsSharedByProcessesAtTheSameTime) {
  const TemporaryFolder folder;
  std::vector<pid_t> children;
  for (int i = 0; i < 4; ++i)
    children.push_back(in_another_process([&folder, i] { return use(folder.path(), i); }));
  for (const pid_t child : children) EXPECT_EQ(exit_code_of(child), 0);
  EXPECT_LE(files_in(folder.path()).size(), 4u);
}

TEST(FileCache, AKilledProcessLeavesNothingThatCounts) {
  const TemporaryFolder folder;
  std::string large;
  large.resize(20'000'000, 'x');
  FileCache cache(folder.path(), test_format, roomy);
  for (int i = 0; i < 10; ++i) {
    const pid_t child = in_another_process([&] {
      while (true) put(cache, "a", large);
      return 0;
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + 7 * i));
    ::kill(child, SIGKILL);
    EXPECT_EQ(exit_code_of(child), -1);
    const CollectedLog log;
    const std::string found = got(cache, "a");
    EXPECT_TRUE(found.empty() || found == large);
    EXPECT_TRUE(log.messages.empty());
  }
  for (const fs::path& file : files_in(folder.path())) age(file, 1);
  put(cache, "a", "small");
  EXPECT_EQ(files_in(folder.path()).size(), 1u);
}

}  // namespace
}  // namespace edgescout::test
