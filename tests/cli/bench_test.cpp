// edgescout bench experiments as a user runs it: stopped and taken up again, with what it cannot
// use, and with a disk that is full.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "host/experiments/table.h"
#include "kernels/backend.h"
#include "tests/cli/example_scene.h"
#include "tests/experiments/well_formed.h"

namespace edgescout::test {
namespace {

namespace fs = std::filesystem;

// Images of a quarter of the paper's size, two starts, few candidates, one bin looked at twice.
std::vector<std::string> experiments(const fs::path& out, const std::vector<std::string>& more = {},
                                     int scenes = 3, int starts = 2) {
  std::vector<std::string> arguments{"bench",           "experiments",
                                     "--out",           out,
                                     "--image-scale",   "0.25",
                                     "--supersampling", "1",
                                     "--scenes",        std::to_string(scenes),
                                     "--starts",        std::to_string(starts),
                                     "--groups",        "1",
                                     "--group-starts",  "1",
                                     "--candidates",    "60",
                                     "--bins",          "1",
                                     "--max-views",     "2",
                                     "--coarse-poses",  "20",
                                     "--registered",    "3",
                                     "--particles",     "20",
                                     "--combinations",  "50"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// Photographs, recorded starts and meshes of other hands, where EDGESCOUT_DATA names the folder
// they lie in.
TEST(BenchExperiments, RunOnRealDataWhereThereIsSome) {
  const char* data = std::getenv("EDGESCOUT_DATA");
  if (!data) GTEST_SKIP() << "no EDGESCOUT_DATA";
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const Outcome outcome = run_program(experiments(
      out, {"--data", data, "--every", "400", "--frames-every", "16", "--strategies", "fixed"}, 1,
      1));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto sets_of = [&](const char* name) {
    const Table rows = load_table(out / (std::string(name) + ".csv"));
    std::set<std::string> sets;
    for (std::size_t row = 0; row < rows.rows.size(); ++row)
      sets.insert(text_in(rows, row, std::string(name) == "nbv" ? "types" : "set"));
    return sets;
  };
  using Sets = std::set<std::string>;
  EXPECT_EQ(sets_of("detection"), (Sets{"rendered", "d2co-starts", "brackets", "cat", "triangle"}));
  EXPECT_EQ(sets_of("registration"),
            (Sets{"rendered", "d2co-starts", "brackets", "brackets by distance", "cat",
                  "cat by distance", "triangle", "triangle by distance"}));
  EXPECT_EQ(sets_of("multiview"), (Sets{"rendered", "d2co-starts", "brackets"}));
  EXPECT_EQ(sets_of("nbv"), (Sets{"own", "cad", "photographs"}));
}

// What a killed writer leaves behind under a hidden name is no file of the results.
std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() != ".part")
      contents[fs::relative(entry.path(), folder)] = content_of(entry.path());
  return contents;
}

void expect_one_line(const Outcome& outcome, std::initializer_list<std::string> words) {
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  const std::string last = outcome.err.substr(outcome.err.rfind("edgescout: error: "));
  EXPECT_TRUE(is_one_line_error(last)) << outcome.err;
  for (const std::string& word : words)
    EXPECT_NE(last.find(word), std::string::npos) << word << " not in " << last;
}

TEST(BenchExperiments, WritesRowsTablesAndPlots) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const Outcome outcome = run_program(experiments(out, {"--seed", "5"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("registration: 3/3"), std::string::npos) << outcome.err;
  const std::string index = content_of(out / "index.md");
  for (const std::string name : {"detection", "registration", "multiview", "nbv"}) {
    const Table rows = load_table(out / (name + ".csv"));
    EXPECT_GT(rows.rows.size(), 10u) << name;
    EXPECT_EQ(rows.notes[1], (std::pair<std::string, std::string>{"seed", "5"}));
    EXPECT_EQ(rows.notes[2], (std::pair<std::string, std::string>{"device", "cpu"}));
    EXPECT_EQ(rows.notes.back().first, "commit");
    const std::string text = content_of(out / (name + ".md"));
    EXPECT_NE(text.find("seed 5; device cpu; "), std::string::npos) << text;
    EXPECT_NE(text.find("|---|"), std::string::npos);
    EXPECT_EQ(fault_of_xml(content_of(out / (name + ".svg"))), "");
    EXPECT_NE(index.find(name + ".md"), std::string::npos);
  }
  std::size_t rows = 0;
  for (const auto& [file, content] : files_in(out / "cells/registration"))
    rows += table_from_csv(content, file).rows.size();
  EXPECT_EQ(load_table(out / "registration.csv").rows.size(), rows);
}

TEST(BenchExperiments, KilledAndResumedGiveTheSameBytes) {
  const TemporaryFolder folder;
  const fs::path whole = folder.path() / "whole", cut = folder.path() / "cut";
  const std::vector<std::string> more{"registration", "--no-times"};
  ASSERT_EQ(run_program(experiments(whole, more, 6)).exit_code, 0);
  const auto finished = [&] {
    return fs::exists(cut / "cells") ? files_in(cut / "cells").size() : 0;
  };
  ASSERT_TRUE(run_program_until(experiments(cut, more, 6), [&] { return finished() > 0; }));
  const std::map<std::string, std::string> left = files_in(cut);
  ASSERT_GE(left.size(), 1u);
  ASSERT_LT(left.size(), 6u);
  const std::map<std::string, std::string> expected = files_in(whole);
  for (const auto& [file, content] : left) EXPECT_EQ(content, expected.at(file)) << file;

  std::vector<std::string> again = experiments(cut, more, 6);
  again.push_back("--resume");
  const Outcome outcome = run_program(again);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(files_in(cut), expected);
}

// A strategy finds by itself what it finds among all.
TEST(BenchExperiments, RunChosenStrategiesAlone) {
  const TemporaryFolder folder;
  const fs::path all = folder.path() / "all", some = folder.path() / "some";
  const std::vector<std::string> nbv{"nbv", "--no-times", "--searches", "one"};
  ASSERT_EQ(run_program(experiments(all, nbv)).exit_code, 0);
  const Outcome outcome =
      run_program(experiments(some, joined({nbv, {"--strategies", "fixed,dis"}})));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Table expected = load_table(all / "nbv.csv"), found = load_table(some / "nbv.csv");
  const auto strategy = std::ranges::find(expected.columns, "strategy") - expected.columns.begin();
  std::multiset<std::vector<std::string>> rows;
  for (const std::vector<std::string>& row : expected.rows)
    if (row[strategy] == "fixed" || row[strategy] == "dis") rows.insert(row);
  EXPECT_EQ(rows.size(), expected.rows.size() / 2);
  EXPECT_EQ(rows, std::multiset(found.rows.begin(), found.rows.end()));
  expect_one_line(run_program(experiments(folder.path() / "none", {"nbv", "--strategies", "best"})),
                  {"strategies", "best", "mi-max", "clairvoyant"});
  expect_one_line(run_program(experiments(folder.path() / "none", {"nbv", "--searches", "some"})),
                  {"searches", "some", "one, each, all"});
  expect_one_line(
      run_program(experiments(folder.path() / "none", {"nbv", "--strategies", "dis,fixed,dis"})),
      {"strategies", "dis twice", "each once"});
}

// The first draw goes on as if it were the only one; the others choose a second view each, and no
// other strategy draws.
TEST(BenchExperiments, LetRandomChooseManySecondViews) {
  const TemporaryFolder folder;
  const auto rows_with = [&](const std::string& draws) {
    const fs::path out = folder.path() / draws;
    std::vector<std::string> arguments =
        experiments(out, {"nbv", "--no-times", "--strategies", "random,fixed", "--searches", "one",
                          "--random-draws", draws});
    *std::next(std::ranges::find(arguments, "--max-views")) = "3";
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return load_table(out / "nbv.csv");
  };
  const Table once = rows_with("1"), often = rows_with("5");
  std::vector<std::vector<std::string>> first_draws;
  std::map<std::string, std::string> second_views;  // by draw
  for (std::size_t row = 0; row < often.rows.size(); ++row) {
    const std::string draw = text_in(often, row, "draw");
    if (draw == "0") {
      first_draws.push_back(often.rows[row]);
      continue;
    }
    EXPECT_EQ(text_in(often, row, "strategy"), "random");
    EXPECT_EQ(text_in(often, row, "views"), "2");
    second_views[draw] = text_in(often, row, "view");
  }
  EXPECT_EQ(first_draws, once.rows);
  EXPECT_EQ(second_views.size(), 4u);
  std::set<std::string> different;
  for (const auto& [draw, view] : second_views) different.insert(view);
  EXPECT_GT(different.size(), 1u) << "of 31 views";
  expect_one_line(run_program(experiments(folder.path() / "none", {"nbv", "--random-draws", "0"})),
                  {"random-draws"});
}

// A bin is the same whichever others there are.
TEST(BenchExperiments, RunChosenBinsAlone) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const auto run = [&](const std::vector<std::string>& bins) {
    std::vector<std::string> arguments{
        "bench", "experiments", "nbv",          "--out", out,           "--image-scale",
        "0.3",   "--no-times",  "--strategies", "fixed", "--max-views", "1"};
    arguments.insert(arguments.end(), bins.begin(), bins.end());
    return run_program(arguments);
  };
  ASSERT_EQ(run({"--only-bins", "2"}).exit_code, 0);
  const std::map<std::string, std::string> found = files_in(out / "cells");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.begin()->first, "nbv/bin_002.csv");
  const Table table = load_table(out / "nbv.csv");
  ASSERT_FALSE(table.rows.empty());
  for (const std::vector<std::string>& row : table.rows) EXPECT_EQ(row[0], "2");
  expect_one_line(run({"--only-bins", "2,1,2"}), {"only_bins", "2 twice"});
  expect_one_line(run({"--bins", "0"}), {"bins", "at least one"});
  expect_one_line(run({"--only-bins", "-1"}), {"only_bins", "-1"});
  for (const std::string kind : {"--bins", "--cad-bins"})
    expect_one_line(run({"--only-bins", "1", kind, "2"}), {kind + ", --only-bins", "both"});
  expect_one_line(run({"--only-bins", "1", "--bins", "0"}), {"bins", "at least one"});
}

TEST(BenchExperiments, OfAnUnknownNameListTheKnownOnes) {
  const TemporaryFolder folder;
  expect_one_line(run_program(experiments(folder.path() / "out", {"registratoin"})),
                  {"found registratoin", "detection, registration, multiview, nbv"});
  EXPECT_FALSE(fs::exists(folder.path() / "out"));
}

TEST(BenchExperiments, NameWhatIsMissingOfTheData) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out", data = folder.path() / "data";
  expect_one_line(run_program(experiments(out, {"nbv", "--data", data})),
                  {data.string(), "no folder"});
  fs::create_directory(data);
  expect_one_line(run_program(experiments(out, {"registration", "--data", data})),
                  {(data / "d2co-starts/ground_truth.json").string()});
  folder.write(
      "data/d2co-starts/ground_truth.json",
      R"({"images": [{"file": "images/a.png", "objects": [{"target": true, "cad": "cad/a.stl"}]}]})");
  folder.write("data/d2co-starts/starts.csv", "start_id,image,object_id,level,r00,tz\n");
  for (const char* file : {"images/a.png", "cad/a.stl"}) {
    expect_one_line(run_program(experiments(out, {"registration", "--data", data})),
                    {(data / "d2co-starts" / file).string()});
    folder.write(std::string("data/d2co-starts/") + file, "");
  }
  expect_one_line(run_program(experiments(out, {"registration", "--data", data})),
                  {(data / "brackets/000001/scene_camera.json").string()});
  expect_one_line(run_program(experiments(out, {"multiview", "nbv", "--data", data})),
                  {(data / "brackets/000001/scene_camera.json").string()});
  expect_one_line(run_program(experiments(out, {"nbv", "--data", data})),
                  {(data / "cad/AX-01_bearing_box.stl").string()});
  EXPECT_FALSE(fs::exists(out));
}

TEST(BenchExperiments, OfOtherSettingsAreNotMixed) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  ASSERT_EQ(run_program(experiments(out, {"registration"})).exit_code, 0);
  const auto before = files_in(out);
  expect_one_line(run_program(experiments(out, {"registration"})), {"scene_000.csv", "--resume"});
  expect_one_line(run_program(experiments(out, {"registration", "--resume", "--seed", "2"})),
                  {"scene_000.csv", "seed", "found 1", "expected 2"});
  expect_one_line(run_program(experiments(out, {"registration", "--resume"}, 3, 3)),
                  {"scene_000.csv", "starts", "found 2", "expected 3"});
  expect_one_line(run_program(experiments(out, {"registration", "--resume", "--solve-steps", "7"})),
                  {"scene_000.csv", "solve_steps", "found 100", "expected 7"});
  expect_one_line(run_program(experiments(out, {"registration", "--resume", "--edges", "lsd"})),
                  {"scene_000.csv", "edges", "found gradient", "expected lsd"});
  expect_one_line(run_program(experiments(out, {"detection", "registration"})),
                  {"scene_000.csv", "--resume"});
  expect_one_line(run_program(experiments(out, {"detection", "registration", "detection"})),
                  {"detection twice", "each once"});
  EXPECT_EQ(files_in(out), before) << "what comes first was not begun either";
}

TEST(BenchExperiments, OnAFullDiskKeepWhatIsFinished) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  // Cells are of a few KiB, the table of all rows is larger than 12; the shell counts in blocks of
  // 512 bytes.
  const std::vector<std::string> arguments = experiments(out, {"registration"}, 8);
  const Outcome outcome = run_program(arguments, "ulimit -f 24;");
  expect_one_line(outcome, {"registration.csv", "File too large"});
  EXPECT_EQ(files_in(out / "cells").size(), 8u);
  std::vector<std::string> again = arguments;
  again.push_back("--resume");
  EXPECT_EQ(run_program(again).exit_code, 0);
  EXPECT_GT(fs::file_size(out / "registration.csv"), 12u * 1024);
}

TEST(BenchExperiments, RefuseSizesOutOfBounds) {
  const TemporaryFolder folder;
  expect_one_line(run_program(experiments(folder.path() / "out", {"--short", "--full"})),
                  {"--short, --full", "one of the two"});
  expect_one_line(
      run_program({"bench", "experiments", "--out", folder.path() / "out", "--candidates", "0"}),
      {"--candidates", "found 0"});
  expect_one_line(
      run_program({"bench", "experiments", "--out", folder.path() / "out", "--supersampling", "2"}),
      {"supersampling", "found 2", "1, 3, 5 or 7"});
  expect_one_line(
      run_program({"bench", "experiments", "--out", folder.path() / "out", "--edges", "canny"}),
      {"--edges", "canny"});
}

std::vector<std::string> devices_in_short(const fs::path& out) {
  std::vector<std::string> arguments{"bench",        "devices",       "--out", out,
                                     "--no-kernels", "--repetitions", "3"};
  for (const auto& [option, value] : {std::pair{"--image-scale", "0.25"},
                                      {"--viewpoints", "1"},
                                      {"--in-plane-steps", "6"},
                                      {"--distance-ratio", "2"},
                                      {"--scan-hits", "100"},
                                      {"--coarse-poses", "20"},
                                      {"--candidates", "2"},
                                      {"--restart-rotation", "0"}})
    arguments.insert(arguments.end(), {option, value});
  return arguments;
}

TEST(BenchDevices, TimesEveryStageAndComparesWithTheCpu) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const Outcome outcome = run_program(devices_in_short(out));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json json = nlohmann::json::parse(content_of(out / "devices.json"));
  EXPECT_EQ(json.at("devices").size(), 1 + vulkan_devices().size());
  for (const nlohmann::json& device : json.at("devices")) {
    std::vector<std::string> stages;
    double parts_ms = 0, whole_ms = 0;
    for (const nlohmann::json& stage : device.at("stages")) {
      stages.push_back(stage.at("stage"));
      const double ms = stage.at("median_ms");
      if (stages.back() == "image to poses") whole_ms = ms;
      if (stages.back().starts_with("image to poses: ")) parts_ms += ms;
      EXPECT_EQ(stage.at("repetitions"), 3);
      EXPECT_LE(stage.at("min_ms"), stage.at("median_ms"));
      EXPECT_LE(stage.at("median_ms"), stage.at("max_ms"));
    }
    EXPECT_EQ(stages,
              (std::vector<std::string>{
                  "edges", "tensors", "scan", "registration", "scoring", "next view",
                  "image to poses", "image to poses: undistort", "image to poses: edges",
                  "image to poses: tensors", "image to poses: scan", "image to poses: coarse",
                  "image to poses: medium", "image to poses: fine", "image to poses: selection"}));
    EXPECT_NEAR(parts_ms, whole_ms, 0.2 * whole_ms);  // medians of each
    EXPECT_NEAR(device.at("images_per_second").get<double>() * whole_ms, 1000, 1);
  }
  EXPECT_EQ(json.at("devices").at(0).at("device"), "cpu");
  EXPECT_EQ(content_of(out / "devices.md"), outcome.out);
  for (const DeviceInfo& device : vulkan_devices())
    if (!device.hardware) {
      EXPECT_NE(outcome.out.find("is a software device"), std::string::npos) << outcome.out;
    }
}

// The times are printed before the files are written. Here the first file cannot be written.
TEST(BenchDevices, SayTheTimesAlsoWhereTheyCannotBeWritten) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  fs::create_directories(out / "devices.json");
  std::vector<std::string> arguments = devices_in_short(out);
  arguments.insert(arguments.end(), {"--device", "cpu"});
  const Outcome outcome = run_program(arguments);
  expect_one_line(outcome, {"devices.json"});
  EXPECT_NE(outcome.out.find("| image to poses |"), std::string::npos) << outcome.out;
}

TEST(BenchDevices, RefuseWhatTheyCannotTime) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const auto refused = [&](const std::string& option, const std::string& value,
                           std::initializer_list<std::string> words) {
    expect_one_line(run_program({"bench", "devices", "--out", out, option, value}), words);
    EXPECT_FALSE(fs::exists(out)) << option;
  };
  refused("--device", "vulkan:99", {"vulkan:99"});
  refused("--repetitions", "2", {"--repetitions", "3 to 1000"});
  refused("--distance-min", "0.5", {"--distance-max"});
}

}  // namespace
}  // namespace edgescout::test
