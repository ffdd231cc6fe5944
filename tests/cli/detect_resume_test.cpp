// edgescout detect interrupted and taken up again: nothing half-written, nothing done twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/io/results.h"
#include "tests/cli/small_scene.h"

namespace edgescout::test {
namespace {

// Copies of one image, a.png and on.
struct Copies : SmallScene {
  fs::path images = folder.path() / "images";
  int count;
  explicit Copies(int copies) : count(copies) {
    fs::create_directories(images);
    for (int i = 0; i < count; ++i) fs::copy_file(image(), images / (name(i) + ".png"));
  }
  static std::string name(int i) { return std::string(1, static_cast<char>('a' + i)); }
  fs::path json(int i) const { return out / (name(i) + ".json"); }
  std::vector<std::string> arguments(const std::vector<std::string>& more = {},
                                     const std::string& fx = "400") const {
    return detect(images, joined({bracket(), {"--camera", camera(fx)}, more}));
  }
  nlohmann::json summary() const { return nlohmann::json::parse(content_of(out / "summary.json")); }
};

std::map<fs::path, fs::file_time_type> times_in(const fs::path& folder,
                                                const std::string& extension) {
  std::map<fs::path, fs::file_time_type> times;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == extension && entry.path().filename().string()[0] != '.' &&
        entry.path().filename() != "summary.json")
      times[entry.path()] = entry.last_write_time();
  return times;
}

TEST(DetectResume, DoesOnlyWhatIsMissing) {
  const Copies t(3);
  ASSERT_EQ(run_program(t.arguments()).exit_code, 0);
  const std::size_t rows = load_bop_results(t.out / "results.csv").size();
  ASSERT_GT(rows, 0u);
  fs::remove(t.json(1));
  t.folder.write("out/c.json", "{\"edgescout_result\": 1");  // cut short
  const auto before = times_in(t.out, ".json").at(t.json(0));
  const auto pictures = pictures_in(t.out);
  EXPECT_EQ(pictures.size(), 3u);
  const Outcome outcome = run_program(t.arguments({"--resume"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(t.summary().at("done"), 2);
  EXPECT_EQ(t.summary().at("skipped"), 1);
  EXPECT_EQ(pictures_in(t.out), pictures) << "of the image skipped as well";
  EXPECT_EQ(times_in(t.out, ".json").at(t.json(0)), before);
  EXPECT_EQ(load_image_result(t.json(2)).image.filename(), "c.png");
  EXPECT_EQ(load_bop_results(t.out / "results.csv").size(), rows);
  EXPECT_NE(outcome.out.find(std::to_string(rows) + " poses in 3 images"), std::string::npos)
      << "those of images skipped count: " << outcome.out;
}

TEST(DetectResume, ListsNoOlderResultOfAnImageThatFailsNow) {
  const Copies t(2);
  ASSERT_EQ(run_program(t.arguments()).exit_code, 0);
  t.folder.write("images/b.png", "no image");
  EXPECT_EQ(run_program(t.arguments()).exit_code, 1);
  for (const BopResult& row : load_bop_results(t.out / "results.csv")) EXPECT_EQ(row.image_id, 0);
}

TEST(DetectResume, LeavesNoResultsOfAnEarlierRun) {
  const Copies t(2);
  ASSERT_EQ(run_program(t.arguments()).exit_code, 0);
  t.folder.write("out/notes.json", "{}");
  t.folder.write("images/b.png", "no image");
  ASSERT_EQ(run_program(t.arguments({"--no-overlays"})).exit_code, 1);
  EXPECT_TRUE(pictures_in(t.out).empty());
  EXPECT_TRUE(fs::exists(t.json(0)));
  EXPECT_TRUE(fs::exists(t.out / "notes.json")) << "no result";
  EXPECT_FALSE(fs::exists(t.json(1))) << "it failed now";
  for (int i : {0, 1}) EXPECT_FALSE(fs::exists(t.out / (t.name(i) + "_overlay.png"))) << i;
}

TEST(DetectResume, RefusesAFolderWithResultsOfOtherImages) {
  const Copies t(2);
  ASSERT_EQ(run_program(t.arguments()).exit_code, 0);
  const std::string before = content_of(t.out / "results.csv");
  fs::remove(t.images / "b.png");
  expect_refused(t.arguments(), {t.out, "b.json of another run", "another --out"});
  EXPECT_EQ(content_of(t.out / "results.csv"), before);
  EXPECT_TRUE(fs::exists(t.json(0)) && fs::exists(t.json(1)));
}

TEST(DetectResume, TakesNoOtherImagesResult) {
  const Copies t(1);
  fs::create_directories(t.folder.path() / "other");
  fs::copy_file(t.image(), t.folder.path() / "other/a.png");
  const auto run_in = [&](const std::string& folder, const std::vector<std::string>& more) {
    const std::vector<std::string> arguments = joined({bracket(), {"--camera", t.camera()}, more});
    return run_program(t.detect("a.png", arguments),
                       "cd '" + (t.folder.path() / folder).string() + "' &&");
  };
  ASSERT_EQ(run_in("images", {}).exit_code, 0);
  EXPECT_EQ(load_image_result(t.json(0)).image, t.images / "a.png");
  ASSERT_EQ(run_in("other", {"--resume"}).exit_code, 0);
  EXPECT_EQ(t.summary().at("done"), 1);
  EXPECT_EQ(load_image_result(t.json(0)).image, t.folder.path() / "other/a.png");
}

TEST(DetectResume, TakesNoResultOfAnotherImageId) {
  const Copies t(1);
  ASSERT_EQ(run_program(t.arguments()).exit_code, 0);
  fs::copy_file(t.image(), t.images / "0.png");  // a.png is image 1 now
  ASSERT_EQ(run_program(t.arguments({"--resume"})).exit_code, 0);
  EXPECT_EQ(t.summary().at("done"), 2);
  EXPECT_EQ(load_image_result(t.json(0)).image_id, 1);
}

TEST(DetectResume, RefusesResultsMadeWithOtherSettings) {
  const Copies t(1);
  ASSERT_EQ(run_program(t.arguments()).exit_code, 0);
  const std::string before = content_of(t.json(0));
  const auto expect_refused_with = [&](const std::vector<std::string>& call,
                                       std::initializer_list<std::string> words) {
    const Outcome outcome = run_program(joined({call, {"--resume"}}));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " not in " << outcome.err;
  };
  expect_refused_with(t.arguments({"--lambda", "50"}), {"a.json: lambda: found 30, expected 50"});
  expect_refused_with(t.arguments({"--no-faint-edges"}),
                      {"faint-edges: found true, expected false"});
  expect_refused_with(t.arguments({"--model", part_file(2)}), {"model of object 2: found nothing"});
  expect_refused_with(t.arguments({"--latitude-min", "0"}),
                      {"templates of object 1", "latitude -90", "latitude 0"});
  expect_refused_with(t.arguments({}, "405"), {"camera", "fx 400", "fx 405"});
  const std::string changed = t.folder.write("obj_000001.ply", content_of(part_file(2)));
  expect_refused_with(
      t.detect(t.images, joined({few_templates(),
                                 {"--model", changed, "--unit", "mm", "--camera", t.camera()}})),
      {"model of object 1: found checksum"});
  EXPECT_EQ(content_of(t.json(0)), before);
}

// The same in other words, and on another device.
TEST(DetectResume, TakesUpTheSameSettings) {
  const Copies t(1);
  ASSERT_EQ(run_program(t.arguments()).exit_code, 0);
  std::vector<std::string> again = t.arguments({"--resume", "--lambda", "30.0", "--faint-edges"});
  std::ranges::replace(again, "cpu", "cpu-reference");
  const Outcome outcome = run_program(again);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(t.summary().at("skipped"), 1);
}

TEST(DetectResume, RefusesResultsOfAnotherPrior) {
  const SmallScene t;
  const auto call = [&](const std::string& top, const std::vector<std::string>& more) {
    return t.detect(
        t.scene,
        joined({bracket(), {"--world-box", "-0.2", "-0.2", "-0.05", "0.2", "0.2", top}, more}));
  };
  ASSERT_EQ(run_program(call("0.1", {})).exit_code, 0);
  EXPECT_EQ(run_program(call("0.1", {"--resume"})).exit_code, 0);
  const Outcome other = run_program(call("0.11", {"--resume"}));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("world-box: found [-0.2,-0.2,-0.05,0.2,0.2,0.1], expected"),
            std::string::npos)
      << other.err;
  EXPECT_EQ(run_program(t.detect(t.scene, joined({bracket(), {"--resume"}}))).exit_code, 2);
}

TEST(DetectResume, GoesOnAfterBeingKilled) {
  const Copies t(6);
  ASSERT_TRUE(run_program_until(t.arguments(), [&] { return fs::exists(t.json(0)); }));
  const auto finished = times_in(t.out, ".json");
  ASSERT_GE(finished.size(), 1u);
  ASSERT_LT(finished.size(), 6u);
  for (const auto& [file, time] : finished) EXPECT_NO_THROW(load_image_result(file)) << file;
  for (const auto& [file, time] : times_in(t.out, ".png"))
    EXPECT_NO_THROW(load_image(file)) << file;
  EXPECT_FALSE(fs::exists(t.out / "summary.json"));

  const Outcome outcome = run_program(t.arguments({"--resume"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(t.summary().at("skipped"), finished.size());
  EXPECT_EQ(t.summary().at("done"), 6 - finished.size());
  const auto all = times_in(t.out, ".json");
  EXPECT_EQ(all.size(), 6u);
  for (const auto& [file, time] : finished) EXPECT_EQ(all.at(file), time) << file;
  std::set<int> listed;
  for (const BopResult& row : load_bop_results(t.out / "results.csv")) listed.insert(row.image_id);
  EXPECT_EQ(listed.size(), 6u);
}

}  // namespace
}  // namespace edgescout::test
