// Scenes of BOP's layout as experiments take them.
#include "host/experiments/known_scene.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/examples.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

namespace fs = std::filesystem;

TEST(BopSceneOfExperiments, HasItsImagesInOneWorld) {
  const KnownScene scene =
      bop_scene("set", examples() / "scenes/000001", examples() / "parts", {0, 1});
  EXPECT_EQ(scene.name, "000001_000000");
  ASSERT_EQ(scene.images.size(), 2u);
  EXPECT_GT(
      distance_between_m(scene.images[0].camera_from_world, scene.images[1].camera_from_world),
      0.01);
  ASSERT_FALSE(scene.instances.empty());
}

// Taken for one camera, three images would give a pose, and rates of it, that are nobody's.
TEST(BopSceneOfExperiments, OfSeveralImagesNeedsTheCamerasPoses) {
  const TemporaryFolder folder;
  const fs::path copy = folder.path() / "000001";
  fs::copy(examples() / "scenes/000001", copy, fs::copy_options::recursive);
  nlohmann::json cameras = nlohmann::json::parse(content_of(copy / "scene_camera.json"));
  cameras.at("1").erase("cam_R_w2c");
  cameras.at("1").erase("cam_t_w2c");
  folder.write("000001/scene_camera.json", cameras.dump());
  const auto load = [&](const std::vector<int>& images) {
    return bop_scene("set", copy, examples() / "parts", images);
  };
  expect_input_error([&] { load({0, 1}); }, {"scene_camera.json", "1", "cam_R_w2c"});
  EXPECT_EQ(load({1}).images.size(), 1u) << "one image is its own world";
}

}  // namespace
}  // namespace edgescout::test
