// The set d2co-starts, where EDGESCOUT_DATA names the folder it lies in: other people's poses,
// judged by our metrics.
#include "host/experiments/recorded_starts.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "host/core/pose_error.h"
#include "host/io/image.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

namespace fs = std::filesystem;

class RecordedStarts : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("EDGESCOUT_DATA");
    if (!data || !fs::exists(fs::path(data) / "d2co-starts"))
      GTEST_SKIP() << "EDGESCOUT_DATA names no folder with d2co-starts";
    folder = fs::path(data) / "d2co-starts";
  }
  fs::path folder;
};

// The published files note for every final pose whether its authors counted it as correct.
TEST_F(RecordedStarts, OriginalResultsAreCorrectAsPublished) {
  std::map<std::string, KnownScene> scenes;
  int files = 0, poses = 0, right = 0;
  for (const fs::directory_entry& file : fs::directory_iterator(folder / "original_results")) {
    ++files;
    for (const RecordedResult& result : recorded_results(file.path())) {
      if (!scenes.contains(result.image))
        scenes[result.image] = recorded_scene(folder, result.image, 0);
      const KnownScene& scene = scenes.at(result.image);
      const auto instance =
          std::ranges::find(scene.instances, result.instance, &KnownInstance::name);
      ASSERT_NE(instance, scene.instances.end()) << result.instance;
      const Se3 truth = scene.images[0].camera_from_world * instance->world_from_object;
      EXPECT_EQ(pose_error(result.camera_from_object, truth, {}).passes(), result.is_right)
          << file.path() << ": start " << result.start << ", " << result.method;
      ++poses;
      right += result.is_right;
    }
  }
  EXPECT_GE(files, 8);
  EXPECT_GT(poses, 6000);
  EXPECT_GT(right, 2000);
}

// The level of a start in starts.csv is its distance from the truth.
TEST_F(RecordedStarts, LieAtTheDistanceOfTheirLevel) {
  int count = 0;
  for (const std::string& image : recorded_images(folder)) {
    const KnownScene scene = recorded_scene(folder, image, 0);
    for (const RecordedStart& start : recorded_starts(folder, scene, 1)) {
      const Se3 truth =
          scene.images[0].camera_from_world * scene.instances[start.instance].world_from_object;
      EXPECT_NEAR(angle_between_rad(start.camera_from_object, truth), 0.1 * start.level, 1e-5);
      EXPECT_NEAR(distance_between_m(start.camera_from_object, truth), 0.005 * start.level, 1e-7);
      ++count;
    }
  }
  EXPECT_EQ(count, 1500);
}

TEST_F(RecordedStarts, OfOneSceneInThreeViewsAgree) {
  EXPECT_EQ(other_views(folder, "m00_v0"), 2);
  EXPECT_EQ(other_views(folder, "s00"), 0);
  const KnownScene scene = recorded_scene(folder, "m00_v0", 2);
  EXPECT_EQ(scene.images.size(), 3u);
  EXPECT_EQ(recorded_scene(folder, "m00_v0", 0).instances.size(), scene.instances.size());
}

TEST(RecordedStartsMissing, AreNamed) {
  const TemporaryFolder folder;
  expect_input_error([&] { recorded_images(folder.path()); }, {"ground_truth.json"});
  folder.write("ground_truth.json", "{}");
  expect_input_error([&] { recorded_images(folder.path()); }, {"starts.csv"});
  folder.write("starts.csv", "start_id,image\n0,s00\n");
  expect_input_error([&] { recorded_images(folder.path()); }, {"starts.csv", "object_id"});
  folder.write("starts.csv", "start_id,image,object_id,level,r00,tz\n0,s00,a,1,1,1\n");
  expect_input_error([&] { recorded_images(folder.path()); }, {"s00.png"});
}

TEST(RecordedStartsUnusable, AreNamedByTheirField) {
  const TemporaryFolder folder;
  save_png(Image{16, 16, std::vector<std::uint8_t>(16 * 16)}, folder.path() / "s00.png");
  folder.write(
      "ground_truth.json",
      R"({"images": [{"name": "s00", "file": "s00.png", "width": 16, "height": 16, "fx": 20,
                   "fy": 20, "cx": 7.5, "cy": 7.5, "R_cam_world": [1, 0, 0, 0, 1, 0, 0, 0, 1],
                   "t_cam_world": [0, 0, 500], "objects": [{"target": "yes"}]}]})");
  expect_input_error(
      [&] { recorded_scene(folder.path(), "s00", 0); },
      {"ground_truth.json", "/images/0/objects/0/target", "found \"yes\"", "true or false"});
  expect_input_error([&] { recorded_scene(folder.path(), "s01", 0); },
                     {"ground_truth.json", "/images", "found no s01"});
}

// There are four levels: others would be looked up outside of their table.
TEST(RecordedStartsUnusable, AreNamedByTheirRow) {
  const TemporaryFolder folder;
  folder.write("ground_truth.json", "{}");
  for (const std::string level : {"0", "5", "-1", "2.5", "1e9", ""}) {
    folder.write("starts.csv", "start_id,image,object_id,level,r00,tz\n0,s00,a,1,1,1\n1,s00,a," +
                                   level + ",1,1\n");
    expect_input_error([&] { recorded_images(folder.path()); },
                       {"starts.csv", "row 2", "level", "found " + level, "1, 2, 3 or 4"});
  }
  const std::filesystem::path results =
      folder.write("results.csv",
                   "start_id,image,object_id,level,method,cpu_ms,ok,r00,r01,r02,r10,r11,r12,r20,"
                   "r21,r22,tx,ty,tz\n"
                   "0,s00,a,7,d2co,1,1,1,0,0,0,1,0,0,0,1,0,0,500\n");
  expect_input_error([&] { recorded_results(results); },
                     {"results.csv", "row 1", "level", "found 7"});
}

}  // namespace
}  // namespace edgescout::test
