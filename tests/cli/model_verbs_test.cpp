// edgescout model build and model draw; damaged template files where a verb reads them.
#include <gtest/gtest.h>

#include "host/io/image.h"
#include "host/model/template_set.h"
#include "tests/cli/example_scene.h"

namespace edgescout::test {
namespace {

std::vector<std::string> build(const std::string& out, const std::vector<std::string>& more = {}) {
  return joined({{"model", "build", part_file(2), "--unit", "mm", "--viewpoints", "2", "--device",
                  "cpu", "--out", out},
                 more});
}
const std::vector<std::string> distances{"--distance-min", "0.3", "--distance-max", "0.6"};

TEST(ModelBuild, WritesASetThatReadsBack) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "part.est";
  const Outcome plain = run_program(build(file, distances));
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_NE(plain.err.find("templates of obj_000002: 100/100"), std::string::npos) << plain.err;
  EXPECT_NE(plain.out.find("object 2, diameter "), std::string::npos) << plain.out;
  const TemplateSet set = load_templates(file);
  EXPECT_EQ(set.object_id, 2);
  EXPECT_EQ(set.views.size(), 42u);
  EXPECT_EQ(set.options.distance_max_m, 0.6);
  const Outcome symmetric =
      run_program(build(file, joined({distances, models_info(), {"--object-id", "2"}})));
  ASSERT_EQ(symmetric.exit_code, 0) << symmetric.err;
  EXPECT_EQ(load_templates(file).symmetries.discrete.size(), 2u);
  EXPECT_LT(load_templates(file).views.size(), 35u);
  ASSERT_EQ(run_program(build(file, joined({distances, {"--symmetry", "y2"}}))).exit_code, 0);
  EXPECT_EQ(load_templates(file).symmetries.discrete.size(), 2u);
  const Outcome both =
      run_program(build(file, joined({distances, models_info(), {"--symmetry", "y4"}})));
  ASSERT_EQ(both.exit_code, 0) << both.err;
  EXPECT_NE(both.err.find("object 2: the symmetries of --symmetry, 3 besides the identity, replace "
                          "the 1 of "),
            std::string::npos)
      << both.err;
  EXPECT_EQ(load_templates(file).symmetries.discrete.size(), 4u);
}

TEST(ModelBuild, ChoosesDistancesByTheCamera) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "part.est";
  const std::string camera =
      folder.write("camera.json",
                   R"({"fx": 800, "fy": 800, "cx": 320, "cy": 240, "width": 640, "height": 480})");
  ASSERT_EQ(run_program(build(file, {"--camera", camera})).exit_code, 0);
  const TemplateSet set = load_templates(file);
  EXPECT_NEAR(set.options.distance_min_m, 800 * set.model.mesh.diameter_m / 640, 1e-9);
  EXPECT_NEAR(set.options.distance_max_m, 20 * set.options.distance_min_m, 1e-9);
}

TEST(ModelBuild, RefusesDistancesInMillimetres) {
  const TemporaryFolder folder;
  expect_refused(
      build(folder.path() / "part.est", {"--distance-min", "350", "--distance-max", "800"}),
      {"obj_000002: distances: found 350 m and more", "--distance-min", "metres", "(--unit)"});
}

TEST(ModelBuild, RefusesAndWritesNothing) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out/part.est";
  expect_refused(build(out), {"--distance-min", "--camera"});
  expect_refused(build(out, {"--distance-min", "0.6", "--distance-max", "0.3"}),
                 {"--distance-max", "found 0.3", "at least --distance-min"});
  expect_refused(build(out, {"--distance-min", "0.6"}),
                 {"--distance-max", "both", "--distance-min"});
  expect_refused(build(out, {"--distance-max", "0.6"}),
                 {"--distance-min", "both", "--distance-max"});
  expect_refused(build(out, {"--distance-min", "0.6", "--distance-ratio", "1"}),
                 {"--distance-ratio", "found 1"});
  expect_refused(build(out, joined({distances, {"--symmetry", "q4"}})), {"--symmetry", "q4"});
  expect_refused(build(out, joined({distances, {"--latitude-min", "91"}})),
                 {"--latitude-min", "found 91"});
  EXPECT_FALSE(fs::exists(out.parent_path()));
  expect_refused(build("/proc/part.est", distances), {"/proc"});
}

TEST(ModelDraw, DrawsMeshesAndSets) {
  const TemporaryFolder folder;
  const std::string set = folder.path() / "part.est", picture = folder.path() / "part.png";
  ASSERT_EQ(run_program(build(set, distances)).exit_code, 0);
  for (const std::vector<std::string>& source :
       {std::vector<std::string>{set}, {part_file(2), "--unit", "mm"}}) {
    const Outcome outcome = run_program(joined(
        {{"model", "draw"},
         source,
         {"--columns", "3", "--rows", "2", "--tile", "100", "--out", picture, "--device", "cpu"}}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Image image = load_image(picture);
    EXPECT_EQ(image.width, 300);
    EXPECT_EQ(image.height, 200);
    // Every tile shows an outline on an empty ground.
    for (int tile = 0; tile < 6; ++tile) {
      int bright = 0;
      for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x)
          bright += image.at(tile % 3 * 100 + x, tile / 3 * 100 + y) > 100;
      EXPECT_GT(bright, 100) << tile;
      EXPECT_LT(bright, 4000) << tile;
    }
    fs::remove(picture);
  }
  expect_refused({"model", "draw", part_file(2), "--out", picture},
                 {"obj_000002.ply", "--unit", "none", "mm, cm, m or in"});
  expect_refused({"model", "draw", set, "--unit", "mm", "--out", picture}, {"--unit", "part.est"});
  expect_refused({"model", "draw", set, "--tile", "9", "--out", picture}, {"--tile", "found 9"});
  EXPECT_FALSE(fs::exists(picture));
}

// Whichever verb reads it.
TEST(Templates, DamagedFilesAreRefused) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "part.est";
  ASSERT_EQ(run_program(build(file, distances)).exit_code, 0);
  const std::string whole = content_of(file);
  std::string version = whole, payload = whole;
  ++version[8];
  ++payload.back();
  const std::string starts = folder.path() / "starts.csv";
  save_bop_results(true_results(load_bop_scene(one_view()), 0), starts);
  const fs::path out = folder.path() / "out";
  const auto refused = [&](const std::string& bad, std::initializer_list<std::string> words) {
    expect_refused({"register", one_view(), "--poses", starts, "--templates", bad, "--out", out},
                   words);
    expect_refused({"detect", one_view(), "--templates", bad, "--out", out}, words);
    expect_refused({"model", "draw", bad, "--out", out}, words);
  };
  refused(folder.write("cut.est", whole.substr(0, whole.size() / 2)), {"cut.est", "length"});
  refused(folder.write("version.est", version), {"version.est", "version", "expected 1"});
  refused(folder.write("sum.est", payload), {"sum.est", "checksum"});
  refused(folder.path() / "none.est", {"none.est", "No such file"});
  const std::string tells = "a CAD file (templates are given with --templates)";
  expect_refused({"detect", one_view(), "--model", file, "--out", out},
                 {"part.est", "template file", tells});
  expect_refused(
      {"register", one_view(), "--poses", starts, "--model", file, "--unit", "mm", "--out", out},
      {"part.est", "template file", tells});
  expect_refused(
      {"register", one_view(), "--poses", starts, "--templates", file, file, "--out", out},
      {"part.est", "object id", "2 twice"});
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace edgescout::test
