// A device that is lost in the middle of a batch: an error that names it, finished images on disk,
// the rest done by a resumed run. And one whose memory others hold: an image that is refused.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "host/io/results.h"
#include "tests/cli/small_scene.h"

namespace edgescout::test {
namespace {

struct LostDevice : ::testing::Test {
  SmallScene scene;
  fs::path images = scene.folder.path() / "images";
  fs::path submits_file = scene.folder.path() / "submits";

  void SetUp() override {
    if (nlohmann::json::parse(run_program({"devices", "--json"}).out).at("devices").empty())
      GTEST_SKIP() << "no Vulkan device";
    fs::create_directories(images);
    fs::copy_file(scene.image(), images / "a.png");
  }
  std::vector<std::string> detect(const std::vector<std::string>& more = {}) const {
    return joined(
        {{"detect", images, "--out", scene.out, "--device", "vulkan", "--no-overlays", "--camera",
          scene.camera(), "--candidates", "4"},
         {"--model", part_file(1), "--unit", "mm", "--viewpoints", "1", "--in-plane-steps", "12",
          "--distance-min", "0.27", "--distance-max", "0.33", "--coarse-poses", "50"},
         more});
  }
  // ASan insists on being first; the shim replaces two functions of the loader, none of the C
  // library.
  Outcome run_on_device_lost_after(int submits, const std::vector<std::string>& arguments,
                                   const std::string& more_environment = "") const {
    return run_program(
        arguments, "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD='" EDGESCOUT_FAILING_DEVICE
                   "' SUBMITS_FILE='" +
                       submits_file.string() + "' FAIL_AFTER_SUBMITS=" + std::to_string(submits) +
                       more_environment);
  }
  int submits_of(const std::vector<std::string>& arguments) const {
    const Outcome alone = run_on_device_lost_after(std::numeric_limits<int>::max(), arguments);
    EXPECT_EQ(alone.exit_code, 0) << alone.err;
    return std::stoi(content_of(submits_file));
  }
};

// The tensor of a 320x240 image has 9 MB.
TEST_F(LostDevice, RefusesATensorThatFindsNoMemory) {
  const Outcome outcome =
      run_on_device_lost_after(std::numeric_limits<int>::max(), detect(), " FREE_BYTES=8000000");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  for (const char* word : {"a.png", "a tensor of", "has free", "--device cpu"})
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
}

TEST_F(LostDevice, KeepsWhatWasFinished) {
  const int submits_of_one = submits_of(detect());
  ASSERT_GT(submits_of_one, 0);
  fs::remove_all(scene.out);
  fs::copy_file(scene.image(), images / "b.png");

  const Outcome outcome = run_on_device_lost_after(submits_of_one, detect());
  ASSERT_EQ(outcome.exit_code, 3) << outcome.err;
  const std::size_t error = outcome.err.find("edgescout: error: ");
  ASSERT_NE(error, std::string::npos) << outcome.err;
  EXPECT_TRUE(is_one_line_error(outcome.err.substr(error))) << outcome.err;
  for (const char* word : {"VK_ERROR_DEVICE_LOST", "dcd_"})
    EXPECT_NE(outcome.err.find(word, error), std::string::npos) << outcome.err;
  EXPECT_NO_THROW(load_image_result(scene.out / "a.json"));
  EXPECT_FALSE(fs::exists(scene.out / "b.json"));
  const std::vector<BopResult> rows = load_bop_results(scene.out / "results.csv");
  EXPECT_FALSE(rows.empty());
  for (const BopResult& row : rows) EXPECT_EQ(row.image_id, 0);

  const Outcome resumed = run_program(detect({"--resume"}));
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(nlohmann::json::parse(content_of(scene.out / "summary.json")).at("skipped"), 1);
  EXPECT_NO_THROW(load_image_result(scene.out / "b.json"));
}

// The folder holds results of both images from an earlier run.
TEST_F(LostDevice, ListsNoOlderPosesOfRegistration) {
  const BopScene views = load_bop_scene(two_views());
  const BopResult first = true_results(views, 0)[0], second = true_results(views, 1)[0];
  const fs::path starts = scene.folder.path() / "starts.csv";
  const std::vector<std::string> call =
      joined({{"register", two_views(), "--poses", starts, "--out", scene.out, "--device", "vulkan",
               "--search-rotation", "0", "--no-overlays"},
              part_models()});
  save_bop_results({first}, starts);
  const int submits_of_one = submits_of(call);
  save_bop_results({first, second}, starts);
  ASSERT_EQ(run_program(call).exit_code, 0);
  ASSERT_EQ(load_bop_results(scene.out / "results.csv").size(), 2u);

  const Outcome outcome = run_on_device_lost_after(submits_of_one, call);
  ASSERT_EQ(outcome.exit_code, 3) << outcome.err;
  const std::vector<BopResult> rows = load_bop_results(scene.out / "results.csv");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].image_id, 0);
  ASSERT_EQ(run_on_device_lost_after(0, call).exit_code, 3);
  EXPECT_TRUE(load_bop_results(scene.out / "results.csv").empty());
}

}  // namespace
}  // namespace edgescout::test
