// edgescout render: the files that scenes take things from, and the errors that name their option.
#include <gtest/gtest.h>

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
