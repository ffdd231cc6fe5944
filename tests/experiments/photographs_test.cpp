// The photographs below a data folder: none is left out without a word.
#include "host/experiments/photographs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

std::vector<std::string> files_of_all() {
  std::vector<std::string> files{"brackets/models/obj_000001.ply", "cat/models/obj_000001.ply",
                                 "triangle/models/obj_000001.ply", "triangle/rgb/000200.png",
                                 "triangle/rgb/000201.png"};
  for (const std::string scene : {"brackets/000001", "brackets/000002", "cat", "triangle"})
    for (const char* index : {"/scene_camera.json", "/scene_gt.json"})
      files.push_back(scene + index);
  for (const char* image :
       {"000001/rgb/000001", "000001/rgb/000002", "000001/rgb/000003", "000002/rgb/000004"})
    files.push_back("brackets/" + std::string(image) + ".png");
  for (int frame = 0; frame <= 30; frame += 2)
    files.push_back("cat/rgb/0000" + std::string(frame < 10 ? "0" : "") + std::to_string(frame) +
                    ".png");
  return files;
}

TEST(Photographs, ThatAreMissingAreNamed) {
  const TemporaryFolder folder;
  for (const std::string& file : files_of_all()) folder.write(file, "");
  EXPECT_EQ(single_photographs(folder.path(), 1).size(), 22u);
  for (const std::string& file : files_of_all()) {
    std::filesystem::remove(folder.path() / file);
    expect_input_error([&] { photographs_in(folder.path(), 1); }, {file});
    folder.write(file, "");
  }
}

TEST(Photographs, AreAskedForAsFarAsTheyAreUsed) {
  const TemporaryFolder folder;
  for (const std::string& file : files_of_all()) folder.write(file, "");
  std::filesystem::remove(folder.path() / "cat/rgb/000026.png");
  EXPECT_EQ(single_photographs(folder.path(), 4).size(), 10u);
}

// The prism's models_info.json knows of no symmetry; the photographs do, and each brings its
// corners onto corners.
TEST(Photographs, OfThePrismKnowItsSixEqualPoses) {
  const char* data = std::getenv("EDGESCOUT_DATA");
  if (!data || !std::filesystem::exists(std::filesystem::path(data) / "triangle"))
    GTEST_SKIP() << "EDGESCOUT_DATA names no folder with photographs";
  const std::vector<NamedPhotograph> photographs = single_photographs(data, 1);
  const KnownScene scene = photographed_scene(photographs.back().source);
  ASSERT_EQ(scene.set, "triangle");
  const Object& prism = scene.objects.at(0);
  ASSERT_EQ(prism.symmetries.discrete.size(), 6u);
  for (const Se3& symmetry : prism.symmetries.discrete)
    for (const Eigen::Vector3d& corner : prism.mesh.vertices_m) {
      double nearest_m = 1;
      for (const Eigen::Vector3d& other : prism.mesh.vertices_m)
        nearest_m = std::min(nearest_m, (symmetry * corner - other).norm());
      EXPECT_LT(nearest_m, 1e-4) << "of 67 mm";
    }
  EXPECT_EQ(photographed_scene(photographs.front().source).objects.at(0).symmetries.discrete.size(),
            2u)
      << "a bracket's are those of its models_info.json";
}

}  // namespace
}  // namespace edgescout::test
