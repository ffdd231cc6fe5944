// Every verb that takes a mesh warns once of one with holes.
#include <gtest/gtest.h>

#include "tests/cli/register_call.h"
#include "tests/cli/small_scout.h"
#include "tests/io/sample_meshes.h"

namespace edgescout::test {
namespace {

class MeshWithHoles : public testing::Test {
 protected:
  void expect_one_warning(const std::vector<std::string>& arguments) {
    const Outcome outcome = run_program(arguments);
    EXPECT_NE(outcome.exit_code, -1);
    EXPECT_EQ(count_of(outcome.err, "warning: mesh open: "), 1u) << outcome.err;
  }
  static std::string text() {
    Triangles open = box(45, 30, 40);
    open.triangles.resize(10);  // one side is missing
    return ascii_ply(open);
  }

  TemporaryFolder folder;
  const std::string file = folder.write("open.ply", text());
  const std::string templates = folder.path() / "open.est", out = folder.path() / "out";
  const std::vector<std::string> model{"--model", file, "--unit", "mm", "--object-id", "1"};
};

TEST_F(MeshWithHoles, IsWarnedOfByTheVerbsOfModels) {
  expect_one_warning({"model", "inspect", file, "--unit", "mm"});
  expect_one_warning({"model", "draw", file, "--unit", "mm", "--tile", "64", "--out",
                      folder.path() / "new/open.png", "--device", "cpu"});
  expect_one_warning(
      joined({{"model", "build", file, "--unit", "mm", "--out", templates, "--device", "cpu"},
              few_templates()}));
  expect_one_warning({"model", "draw", templates, "--tile", "64", "--out",
                      folder.path() / "open.png", "--device", "cpu"});
}

TEST_F(MeshWithHoles, IsWarnedOfByDetect) {
  const SmallScene scene;
  expect_one_warning(scene.detect(scene.scene, joined({model, few_templates()})));
}

TEST_F(MeshWithHoles, IsWarnedOfByRegister) {
  const SmallScene scene;
  const fs::path starts = folder.path() / "starts.csv";
  save_bop_results(true_results(load_bop_scene(scene.scene), 0), starts);
  expect_one_warning(joined(
      {{"register", scene.scene, "--poses", starts, "--out", out, "--device", "cpu"}, model}));
}

TEST_F(MeshWithHoles, IsWarnedOfByScout) {
  SmallScout small;
  small.max_views = "1";
  std::vector<std::string> arguments = small.arguments({"--object-id", "1"});
  *std::ranges::find(arguments, part_file(1)) = file;
  *(std::ranges::find(arguments, "--out") + 1) = out;
  expect_one_warning(arguments);
}

}  // namespace
}  // namespace edgescout::test
