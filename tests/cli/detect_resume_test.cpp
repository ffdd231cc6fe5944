// edgescout detect interrupted and taken up again: nothing half-written, nothing done twice.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

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
  std::vector<std::string> arguments(const std::vector<std::string>& more = {}) const {
    return detect(images, joined({bracket(), {"--camera", camera()}, more}));
  }
  nlohmann::json summary() const { return nlohmann::json::parse(content_of(out / "summary.json")); }
};

std::map<fs::path, fs::file_time_type> times_in(const fs::path& folder, const std::string& extension) {
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
  const Outcome outcome = run_program(t.arguments({"--resume"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(t.summary().at("done"), 2);
  EXPECT_EQ(t.summary().at("skipped"), 1);
  EXPECT_EQ(times_in(t.out, ".json").at(t.json(0)), before);
  EXPECT_EQ(load_image_result(t.json(2)).image.filename(), "c.png");
  EXPECT_EQ(load_bop_results(t.out / "results.csv").size(), rows);
}

TEST(DetectResume, ListsNoOlderResultOfAnImageThatFailsNow) {
  const Copies t(2);
  ASSERT_EQ(run_program(t.arguments()).exit_code, 0);
  t.folder.write("images/b.png", "no image");
  EXPECT_EQ(run_program(t.arguments()).exit_code, 1);
  for (const BopResult& row : load_bop_results(t.out / "results.csv")) EXPECT_EQ(row.image_id, 0);
}

TEST(DetectResume, GoesOnAfterBeingKilled) {
  const Copies t(6);
  const pid_t child = start_program(t.arguments());
  ASSERT_GT(child, 0);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!fs::exists(t.json(0)) && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  ::kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status)) << "it had ended before";
  const auto finished = times_in(t.out, ".json");
  ASSERT_GE(finished.size(), 1u);
  ASSERT_LT(finished.size(), 6u);
  for (const auto& [file, time] : finished) EXPECT_NO_THROW(load_image_result(file)) << file;
  for (const auto& [file, time] : times_in(t.out, ".png")) EXPECT_NO_THROW(load_image(file)) << file;
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
