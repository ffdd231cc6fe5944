// The photographs below a data folder: none is left out without a word.
#include "host/experiments/photographs.h"

#include <gtest/gtest.h>

#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

std::vector<std::string> files_of_all() {
  std::vector<std::string> files{"brackets/models/obj_000001.ply", "cat/models/obj_000001.ply",
                                 "triangle/models/obj_000001.ply", "triangle/rgb/000200.png",
                                 "triangle/rgb/000201.png"};
  for (const std::string scene : {"brackets/000001", "brackets/000002", "cat", "triangle"})
    for (const char* index : {"/scene_camera.json", "/scene_gt.json"}) files.push_back(scene + index);
  for (const char* image :
       {"000001/rgb/000001", "000001/rgb/000002", "000001/rgb/000003", "000002/rgb/000004"})
    files.push_back("brackets/" + std::string(image) + ".png");
  for (int frame = 0; frame <= 30; frame += 2)
    files.push_back("cat/rgb/0000" + std::string(frame < 10 ? "0" : "") + std::to_string(frame) + ".png");
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

}  // namespace
}  // namespace edgescout::test
