#include "host/experiments/cells.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <stdexcept>

#include "kernels/error.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

namespace fs = std::filesystem;

// Cells a, b, below/c ..: each a row with its name; counts how often cells ran. A cell named in
// `fails` throws.
struct Trial {
  TemporaryFolder folder;
  std::atomic<int> ran{0};
  std::string fails;
  std::vector<Cell> cells;
  CellRun run;

  explicit Trial(std::vector<std::string> names = {"a", "b", "below/c"}) {
    for (const std::string& name : names)
      cells.push_back({name, [this, name](Backend&) {
                         if (name == fails) throw std::runtime_error(name + " failed");
                         ++ran;
                         return Table{{}, {"name"}, {{name}}};
                       }});
    run.folder = folder.path() / "cells";
    run.settings = {{"seed", "1"}, {"scenes", "3"}};
    run.commit = "abc";
    run.make_backend = [] { return make_cpu_backend(1); };
  }
  std::vector<Table> go() { return run_cells(cells, run); }
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(run.folder))
      if (entry.is_regular_file())
        contents[fs::relative(entry.path(), run.folder)] = content_of(entry.path());
    return contents;
  }
};

TEST(Cells, AreAFileEachWithWhatTheyWereMadeWith) {
  Trial t;
  const std::vector<Table> tables = t.go();
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[2].rows[0][0], "below/c");
  const std::map<std::string, std::string> expected{
      {"a.csv", "# seed: 1\n# scenes: 3\n# commit: abc\nname\na\n"},
      {"b.csv", "# seed: 1\n# scenes: 3\n# commit: abc\nname\nb\n"},
      {"below/c.csv", "# seed: 1\n# scenes: 3\n# commit: abc\nname\nbelow/c\n"}};
  EXPECT_EQ(t.files(), expected);
}

TEST(Cells, AreNotDoneTwice) {
  Trial t;
  t.go();
  const auto before = t.files();
  fs::remove(t.run.folder / "b.csv");
  t.run.resume = true;
  t.ran = 0;
  const std::vector<Table> tables = t.go();
  EXPECT_EQ(t.ran, 1);
  EXPECT_EQ(tables[0].rows[0][0], "a");
  EXPECT_EQ(t.files(), before);
}

TEST(Cells, ThatCannotBeReadAreDoneAgain) {
  Trial t;
  t.go();
  const auto before = t.files();
  t.folder.write("cells/a.csv", "# seed: 1\n# sce");
  t.run.resume = true;
  t.ran = 0;
  t.go();
  EXPECT_EQ(t.ran, 1);
  EXPECT_EQ(t.files(), before);
}

TEST(Cells, OfAnEarlierRunAreNotOverwritten) {
  Trial t;
  t.go();
  expect_input_error([&] { t.go(); }, {"a.csv", "resume"});
}

TEST(Cells, OfOtherSettingsAreNoPartOfThisRun) {
  Trial t;
  t.go();
  t.run.resume = true;
  t.run.settings[0].second = "2";
  expect_input_error([&] { t.go(); }, {"a.csv", "seed", "found 1", "expected 2"});
  t.run.settings = {{"seed", "1"}, {"scenes", "3"}, {"starts", "5"}};
  expect_input_error([&] { t.go(); }, {"a.csv", "starts", "found nothing", "expected 5"});
  t.run.settings = {{"seed", "1"}};
  expect_input_error([&] { t.go(); }, {"a.csv", "scenes", "found 3", "expected nothing"});
}

// Another build may give other results. It continues only with any_commit, and the cells note it.
TEST(Cells, OfSeveralCommitsAreDistinguished) {
  Trial t;
  t.go();
  fs::remove(t.run.folder / "b.csv");
  t.run.resume = true;
  t.run.commit = "def";
  expect_input_error([&] { t.go(); }, {"a.csv", "commit", "found abc", "any_commit"});
  t.run.any_commit = true;
  EXPECT_EQ(joined(t.go()).notes.back(),
            (std::pair<std::string, std::string>{"commit", "abc def"}));
}

TEST(Cells, OfOtherColumnsEndTheRun) {
  Trial t;
  t.go();
  t.folder.write("cells/a.csv", "# seed: 1\n# scenes: 3\n# commit: old\nname,more\na,1\n");
  fs::remove(t.run.folder / "b.csv");
  t.run.resume = t.run.any_commit = true;
  expect_input_error([&] { t.go(); }, {"c.csv", "columns"});
}

TEST(Cells, KeepWhatIsFinishedWhereOneFails) {
  Trial t;
  t.fails = "b";
  EXPECT_THROW(t.go(), std::runtime_error);
  EXPECT_EQ(t.files().size(), 1u);
  EXPECT_TRUE(t.files().contains("a.csv"));
}

TEST(Cells, GiveTheSameSideBySide) {
  std::vector<std::string> names;
  for (int i = 0; i < 40; ++i) names.push_back("cell_" + std::to_string(i));
  Trial alone(names), parallel(names);
  parallel.run.workers = 4;
  std::size_t last = 0, calls = 0;
  parallel.run.progress = [&](std::size_t done, std::size_t all) {
    EXPECT_EQ(done, calls++);
    EXPECT_EQ(all, names.size());
    last = done;
  };
  const std::vector<Table> one = alone.go(), four = parallel.go();
  EXPECT_EQ(alone.files(), parallel.files());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(one[i].rows, four[i].rows);
  EXPECT_EQ(last, names.size());
}

TEST(Cells, OfAFailureAmongManyEndTheRun) {
  std::vector<std::string> names;
  for (int i = 0; i < 40; ++i) names.push_back("cell_" + std::to_string(i));
  Trial t(names);
  t.run.workers = 4;
  t.fails = "cell_3";
  EXPECT_THROW(t.go(), std::runtime_error);
  EXPECT_FALSE(t.files().contains("cell_3.csv"));
  EXPECT_LT(t.ran, 40);
}

// One cell's own file cannot be written while others are at work: the run ends with its name, what
// is finished stays, nothing half written lies about, and it goes on from there.
TEST(Cells, OfWhichOneCannotBeWrittenKeepTheOthers) {
  std::vector<std::string> names;
  for (int i = 0; i < 12; ++i) names.push_back("cell_" + std::to_string(i));
  Trial t(names);
  t.run.workers = 3;
  const fs::path in_the_way = t.run.folder / "cell_5.csv";
  const auto run = t.cells[5].run;
  t.cells[5].run = [&](Backend& backend) {
    fs::create_directories(in_the_way / "full");
    return run(backend);
  };
  expect_input_error([&] { t.go(); }, {"cell_5.csv"});
  const std::map<std::string, std::string> left = t.files();
  EXPECT_GE(left.size(), 5u);
  EXPECT_LT(left.size(), 12u);
  for (const auto& [file, content] : left) {
    EXPECT_TRUE(file.ends_with(".csv")) << file;
    EXPECT_NE(content.find("\nname\ncell_"), std::string::npos) << "whole: " << file;
  }
  fs::remove_all(in_the_way);
  t.cells[5].run = run;
  t.run.resume = true;
  t.ran = 0;
  t.go();
  EXPECT_EQ(t.ran, 12 - static_cast<int>(left.size()));
  EXPECT_EQ(t.files().size(), 12u);
}

}  // namespace
}  // namespace edgescout::test
