// edgescout render: the files that scenes take things from, and the errors that name their option.
#include <gtest/gtest.h>

#include <cmath>

#include "host/io/bop.h"
#include "host/io/depth_file.h"
#include "host/io/image.h"
#include "host/io/mesh.h"
#include "host/render/parts.h"
#include "tests/cli/program.h"

namespace edgescout::test {
namespace {

Outcome render_with(const std::vector<std::string>& more, const TemporaryFolder& folder) {
  std::vector<std::string> arguments{"render",
                                     "--part",
                                     "hex_nut",
                                     "--objects",
                                     "1",
                                     "--width",
                                     "64",
                                     "--height",
                                     "48",
                                     "--focal",
                                     "70",
                                     "--out",
                                     (folder.path() / "out").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(arguments);
}

TEST(Render, TakesPhotographsAndForeignPartsFromFiles) {
  const TemporaryFolder folder;
  const std::string here = folder.path().string(), part = here + "/part.ply";
  save_png(Image{40, 30, std::vector<std::uint8_t>(1200, 90)}, folder.path() / "photograph.png");
  save_ply_mm(make_part("gear_plate").mesh, part);
  const Outcome outcome = render_with(
      {"--backgrounds", here, "--board-texture", here, "--environments", here, "--clutter-model",
       part, "--clutter-objects", "2", "--metal", "1", "--jpeg", "60", "90"},
      folder);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(load_image(folder.path() / "out/000000/gray/000000.png").width, 64);
}

// The file's unit and the values that it gives are those that the loader reads.
TEST(Render, WritesDepthBesideTheGreyImages) {
  const TemporaryFolder folder;
  const Outcome plain = render_with({}, folder);
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  const std::filesystem::path scene = folder.path() / "out/000000";
  EXPECT_FALSE(std::filesystem::exists(scene / "depth"));
  const std::string grey = content_of(scene / "gray/000000.png");
  EXPECT_EQ(load_bop_images(scene).images[0].depth_scale, 1);
  const Outcome outcome = render_with({"--depth", "--depth-unit", "0.0002"}, folder);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(content_of(scene / "gray/000000.png"), grey);
  const BopImage image = load_bop_images(scene).images[0];
  EXPECT_NEAR(image.depth_scale, 0.2, 1e-12);
  const DepthImage depth = load_depth(image.depth_file, {}, 1e-3 * image.depth_scale);
  ASSERT_EQ(depth.width, 64);
  ASSERT_EQ(depth.height, 48);
  const double distance_m =
      load_bop_scene(scene).truth.at(0)[0].camera_from_object.translation_m.z();
  int near = 0;
  for (const float z_m : depth.z_m) near += std::abs(z_m - distance_m) < 0.1 * distance_m;
  EXPECT_GT(near, 200);
}

TEST(Render, NamesTheOptionOfWhatCannotBeUsed) {
  const TemporaryFolder folder;
  folder.write("notes/a.txt", "no image");
  folder.write("part.stl", "no mesh");
  const std::string notes = (folder.path() / "notes").string();
  const std::vector<std::vector<std::string>> wrong{
      {"--backgrounds", notes},
      {"--board-texture", notes},
      {"--environments", notes + "/missing"},
      {"--clutter-model", (folder.path() / "part.stl").string()},
      {"--jpeg", "90", "30"},
      {"--depth-holes", "1.5"},
      {"--vignetting", "0", "2"}};
  for (const std::vector<std::string>& arguments : wrong) {
    const Outcome outcome = render_with(arguments, folder);
    EXPECT_EQ(outcome.exit_code, 2) << arguments[0];
    EXPECT_NE(outcome.err.find(arguments[0] + ": "), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out")) << arguments[0];
  }
}

}  // namespace
}  // namespace edgescout::test
