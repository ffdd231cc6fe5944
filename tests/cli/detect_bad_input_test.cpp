// edgescout detect: what it refuses and warns of.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "host/io/image.h"
#include "tests/cli/small_scene.h"

namespace edgescout::test {
namespace {

TEST(Detect, RefusesWhereEveryImageIsBad) {
  const SmallScene t;
  t.folder.write("bad/a.png", "no image");
  t.folder.write("bad/b.png", "");
  expect_refused(t.detect(t.folder.path() / "bad", joined({bracket(), {"--camera", t.camera()}})),
                 {"b.png", "empty"});
  EXPECT_FALSE(fs::exists(t.out));
}

// Only the detection finds out.

TEST(Detect, RefusesTheOnlyImageWhereItIsTooLarge) {
  const SmallScene t;
  const fs::path wide = t.folder.path() / "wide.png";
  save_png(Image{32767, 120, std::vector<std::uint8_t>(32767 * 120, 128)}, wide);
  const std::string lens =
      t.folder.write("lens.yaml",
                     "image_width: 32767\nimage_height: 120\nK: [400, 0, 159.5, 0, 400, "
                     "59.5, 0, 0, 1]\nD: [0.1, 0, 0, 0, 0]\n");
  const Outcome outcome = run_program(t.detect(wide, joined({bracket(), {"--camera", lens}})));
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  const std::size_t error = outcome.err.find("edgescout: error: ");
  ASSERT_NE(error, std::string::npos) << outcome.err;
  EXPECT_TRUE(is_one_line_error(outcome.err.substr(error))) << outcome.err;
  EXPECT_NE(outcome.err.find("wide.png: image: size: found 32767x120", error), std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.err.find("edgescout: warning: " + wide.string()), std::string::npos)
      << "logged twice: " << outcome.err;
  EXPECT_FALSE(fs::exists(t.out)) << "something was written";
}

TEST(Detect, RefusesViewsThatAreJoinedTwice) {
  const SmallScene t;
  expect_refused(joined({{"detect", t.scene, t.scene, "--joint", "--out", t.out, "--device", "cpu"},
                         bracket()}),
                 {"000000.png", "view", "twice"});
  EXPECT_FALSE(fs::exists(t.out));
}

TEST(Detect, RefusesCameraPosesThatShareNothing) {
  const SmallScene t(2);
  const fs::path file = t.scene / "scene_camera.json";
  nlohmann::json cameras = nlohmann::json::parse(content_of(file));
  for (auto& camera : cameras)
    for (auto& number : camera["cam_t_w2c"]) number = 1000 * number.get<double>();
  std::ofstream(file) << cameras;
  expect_refused(t.detect(t.scene, joined({bracket(), {"--joint"}})),
                 {"000003", "camera poses", "lengths in mm where m are expected"});
  EXPECT_FALSE(fs::exists(t.out));
}

TEST(Detect, RefusesAPartThatCannotBeSeen) {
  const SmallScene t;
  expect_refused(
      t.detect(t.scene, joined({{"--model", part_file(1), "--unit", "in"}, few_templates()})),
      {"obj_000001", "size", "--unit"});
  EXPECT_FALSE(fs::exists(t.out));
  const Outcome warned = run_program(t.detect(
      t.scene,
      joined({{"--model", part_file(1), "--unit", "mm", "--viewpoints", "3"},
              {"--in-plane-steps", "12", "--distance-min", "2.8", "--distance-max", "3"}})));
  EXPECT_NE(warned.err.find("expected 12 to 320 px"), std::string::npos) << warned.err;
}

// Millimetres taken for metres, of the part and of each length.
TEST(Detect, RefusesLengthsInAWrongUnit) {
  const SmallScene t;
  const auto refused = [&](const std::vector<std::string>& more,
                           std::initializer_list<std::string> words) {
    expect_refused(
        t.detect(t.scene, joined({{"--log-level", "error", "--model", part_file(1)}, more})),
        words);
    EXPECT_FALSE(fs::exists(t.out)) << "something was written";
  };
  refused({"--unit", "m"}, {"diameter: found ", " m, which", "another unit (--unit)"});
  refused({"--unit", "m", "--distance-min", "0.3", "--distance-max", "0.8"},
          {"size: found a diameter of ", "(--unit)"});
  const auto with = [&](const std::vector<std::string>& more) {
    return joined({{"--unit", "mm"}, more});
  };
  refused(with({"--distance-min", "350", "--distance-max", "800"}),
          {"at 350.000 to 800.000 m", "--distance-max; metres"});
  refused(with({"--distance-min", "3500", "--distance-max", "8000"}),
          {"--distance-min: found 3500, expected 0 to 1000 m: 3500 mm are 3.5"});
  refused(with({"--plane-tolerance", "2"}), {"--plane-tolerance", "0 to 1 m: 2 mm are 0.002"});
  refused(with({"--penetration", "2"}), {"--penetration", "0 to 1 m: 2 mm are 0.002"});
  refused(with({"--world-box", "-300", "-200", "0", "300", "200", "100"}),
          {"detect.world_box: found a side of 600 m", "at most 20 m: 600 mm are 0.6"});
  for (const char* name : {"--depth-noise", "--depth-noise-floor"})
    refused(with({name, "1", "--depth", "scene"}), {name, "m: 1 mm are 0.001"});
  refused(with({"--depth-range", "100", "2000", "--depth", "scene"}),
          {"--depth-range", "0 to 100 m: 2000 mm are 2"});
  refused(with({"--depth-pose", "25", "0", "0", "0", "0", "0", "1", "--depth", "scene"}),
          {"--depth-pose", "-10 to 10 m: 25 mm are 0.025"});
}

TEST(Detect, WarnsOfDistancesAtWhichNothingIsSeen) {
  const SmallScene t;
  const auto sizes_warned_of = [&](const char* farthest) {
    const Outcome outcome =
        run_program(t.detect(t.scene, {"--model", part_file(1), "--unit", "mm", "--viewpoints", "1",
                                       "--in-plane-steps", "1", "--distance-min", "0.27",
                                       "--distance-max", farthest, "--distance-ratio", "2"}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err.find("size: found a diameter of") != std::string::npos;
  };
  EXPECT_FALSE(sizes_warned_of("0.33"));
  EXPECT_TRUE(sizes_warned_of("330"));
}

TEST(Detect, WarnsOfAPlaneAboveTheCameras) {
  const SmallScene t;
  const auto warned = [&](const char* d) {
    const Outcome outcome =
        run_program(t.detect(t.scene, joined({bracket(), {"--world-plane", "0", "0", "1", d}})));
    return outcome.err.find("--world-plane: found all cameras below it") != std::string::npos;
  };
  EXPECT_TRUE(warned("150"));
  EXPECT_FALSE(warned("-0.01"));
}

// An option that takes a list takes no image.
TEST(Detect, TakesImagesBehindLists) {
  const SmallScene t;
  const std::vector<std::string> rest{"--out", t.out, "--device", "cpu"},
      model{"--model", part_file(1)}, unit{"--unit", "mm"};
  const auto refused = [&](const std::vector<std::string>& words,
                           std::initializer_list<std::string> expected) {
    expect_refused(joined({{"detect"}, words, rest}), expected);
  };
  const std::string image = t.image();
  refused(joined({unit, model, {image}}), {"000000.png", "camera", "--camera FILE"});
  refused(joined({unit, {"--model=" + part_file(1), image}}), {"000000.png", "--camera FILE"});
  refused(joined({unit, model, {"--object-id", "1", image}}), {"000000.png", "--camera FILE"});
  refused(joined({unit, model, {"--symmetry", "z2", image}}), {"000000.png", "--camera FILE"});
  refused(joined({unit, model, {"none.png"}}), {"none.png: input"});
  refused(joined({unit, model, {"image"}}),
          {"command line: inputs: found none: --model took what stands behind"});
  expect_refused(joined({{"scout"}, unit, model, {t.folder.path()}, rest}),
                 {t.folder.path(), "source: found a folder of BOP scenes"});
}

TEST(Detect, RefusesPriorsThatAreNone) {
  const SmallScene t;
  const auto refused = [&](const fs::path& input, const std::vector<std::string>& more,
                           std::initializer_list<std::string> words) {
    expect_refused(t.detect(input, joined({bracket(), more})), words);
    EXPECT_FALSE(fs::exists(t.out)) << "something was written";
  };
  refused(t.scene, {"--world-box", "0", "0", "0.1", "1", "1", "0.1"},
          {"detect.world_box", "1 x 1 x 0 m", "corners"});
  refused(t.scene, {"--world-box", "0", "0", "0", "1", "1"}, {"--world-box", "6"});
  refused(t.scene, {"--world-box", "0", "0", "0", "1", "1", "x"}, {"--world-box", "x"});
  refused(t.scene, {"--world-plane", "0", "0", "0", "1"}, {"detect.world_plane", "length 0"});
  refused(t.scene, {"--world-plane", "0", "0", "1"}, {"--world-plane", "4"});
  refused(t.scene, {"--plane-tolerance", "-1"}, {"--plane-tolerance", "-1"});
  for (const std::vector<std::string>& prior : std::vector<std::vector<std::string>>{
           {"--world-box", "0", "0", "0", "1", "1", "1"}, {"--world-plane", "0", "0", "1", "0"}})
    refused(t.image(), joined({prior, {"--camera", t.camera()}}),
            {"000000.png", "world pose", "found none", "--world-box"});
  // Without distances they come from the box.
  expect_refused(t.detect(t.scene, {"--model", part_file(1), "--unit", "mm", "--world-box", "40",
                                    "0", "0", "41", "1", "1"}),
                 {"detect.world_box", "from the cameras", "--distance-min"});
}

TEST(Detect, RefusesCamerasThatDoNotFit) {
  const SmallScene t;
  const auto refused = [&](const std::vector<std::string>& more,
                           std::initializer_list<std::string> words) {
    expect_refused(t.detect(t.image(), joined({bracket(), more})), words);
    EXPECT_FALSE(fs::exists(t.out)) << "something was written";
  };
  refused({}, {"000000.png", "camera", "--camera FILE"});
  refused({"--camera", t.folder.path() / "none.yaml"}, {"none.yaml"});
  refused({"--camera", t.camera("-400")}, {"camera.yaml", "fx", "-400"});
  refused({"--camera", t.camera(".nan")}, {"camera.yaml", "camera_matrix", "not finite"});
  refused({"--camera", t.camera("400", 640, 480)},
          {"camera.yaml", "320x240", "640x480", "--scale-camera"});
  refused({"--camera", t.camera("400", 640, 400), "--scale-camera"},
          {"camera.yaml", "320x240", "640x400"});
  refused({"--joint", "--camera", t.camera()}, {"000000.png", "world pose", "--joint"});
}

TEST(Detect, WarnsOfACalibrationOfUnknownSize) {
  const SmallScene t;
  const std::string sizeless =
      t.folder.write("k.yaml", "K: [400, 0, 159.5, 0, 400, 119.5, 0, 0, 1]\n");
  const auto warned = [&](const std::string& camera) {
    const Outcome outcome =
        run_program(t.detect(t.image(), joined({bracket(), {"--camera", camera}})));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err.find("edgescout: warning: " + camera + ": width, height: found none") !=
           std::string::npos;
  };
  EXPECT_TRUE(warned(sizeless));
  EXPECT_FALSE(warned(t.camera()));
}

TEST(Detect, RefusesOptionsDevicesAndFolders) {
  const SmallScene t;
  const auto refused = [&](const std::vector<std::string>& more,
                           std::initializer_list<std::string> words) {
    expect_refused(joined({{"detect", t.scene, "--out", t.out}, more}), words);
    EXPECT_FALSE(fs::exists(t.out)) << "something was written";
  };
  refused(joined({bracket(), {"--min-probability", "1.5"}}),
          {"--min-probability", "1.5", "0 to 1"});
  refused(joined({bracket(), {"--min-probability", "nan"}}),
          {"--min-probability", "nan", "0 to 1"});
  refused(joined({bracket(), {"--bins", "61"}}), {"bins", "61"});
  refused(joined({bracket(), {"--distance-ratio", "1"}}), {"--distance-ratio"});
  refused(joined({bracket(), {"--device", "vulkan:99"}}), {"device", "vulkan:99"});
  refused({"--device", "cpu"}, {"--model", "neither"});
  refused({"--device", "cpu", "--model", part_file(1)}, {"--unit"});
  refused({"--device", "cpu", "--unit", "mm", "--model", part_file(1), part_file(1)},
          {"obj_000001.ply", "object id", "twice"});
  refused({"--device", "cpu", "--unit", "mm", "--model", t.folder.path() / "none.stl"},
          {"none.stl"});
  // What a template file says itself.
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{"--unit", "mm"},
                                             {"--object-id", "1"},
                                             {"--distance-min", "0.2"},
                                             {"--viewpoints", "4"}})
    refused(joined({{"--templates", "part.est"}, more}), {more[0], "together with --templates"});
  const fs::path below = t.folder.write("file", "content") / "out";
  expect_refused(joined({{"detect", t.scene, "--out", below, "--device", "cpu"}, bracket()}),
                 {below, "output folder"});
  expect_refused(joined({{"detect", t.folder.path() / "nowhere", "--out", t.out, "--device", "cpu"},
                         bracket()}),
                 {"nowhere", "input"});
  fs::create_directories(t.folder.path() / "empty");
  expect_refused(
      joined({{"detect", t.folder.path() / "empty", "--out", t.out, "--device", "cpu"}, bracket()}),
      {"empty", "no image"});
}

TEST(Detect, RefusesTheSameObjectInTwoTemplateFiles) {
  const SmallScene t;
  const std::string set = t.folder.path() / "part.est";
  ASSERT_EQ(run_program(joined({{"model", "build", part_file(1), "--unit", "mm", "--device", "cpu",
                                 "--out", set},
                                few_templates()}))
                .exit_code,
            0);
  expect_refused(t.detect(t.scene, {"--templates", set, set}),
                 {"part.est", "object id", "1 twice"});
  expect_refused(t.detect(t.image(), {"--templates", set}), {"000000.png", "camera"});
  expect_refused({"detect", "--templates", set, t.image(), "--out", t.out, "--device", "cpu"},
                 {"000000.png", "camera"});
  expect_refused(t.detect(t.image(), {"--templates", set, "--camera", t.camera("-400")}),
                 {"camera.yaml", "fx"});
  EXPECT_FALSE(fs::exists(t.out));
}

}  // namespace
}  // namespace edgescout::test
