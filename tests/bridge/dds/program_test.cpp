// The program beside a peer on DDS.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <optional>
#include <sstream>

#include "host/active/scout.h"
#include "host/bridge/ros2/depth_message.h"
#include "host/bridge/ros2/program/program_options.h"
#include "host/cli/template_sets.h"
#include "host/io/depth_png.h"
#include "host/io/results.h"

#include "tests/bridge/dds/camera_peer.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::ros2::test {

namespace {

// "score x y z qx qy qz qw" of what `edgescout detect` finds in the picture.
std::vector<std::array<double, 8>> found_by_command_line(
    const TemporaryFolder& folder, const std::filesystem::path& image,
    const std::vector<std::string>& more = {}) {
  const Camera camera = small_world().camera();
  const std::string calibration = folder.write(
      "camera.yaml", "image_width: " + std::to_string(camera.width) +
                         "\nimage_height: " + std::to_string(camera.height) +
                         "\ncamera_matrix: {rows: 3, cols: 3, data: [" + std::to_string(camera.fx) +
                         ", 0, " + std::to_string(camera.cx) + ", 0, " + std::to_string(camera.fy) +
                         ", " + std::to_string(camera.cy) + ", 0, 0, 1]}\n");
  const std::string out = folder.path() / "out";
  const edgescout::test::Outcome outcome = edgescout::test::run_program(
      joined({{"detect", image.string(), "--camera", calibration, "--out", out}, bracket(more)}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::vector<std::array<double, 8>> rows;
  for (const Detection& d :
       load_image_result(folder.path() / "out" / (image.stem().string() + ".json")).detections) {
    const Se3& pose = d.world_from_object;
    rows.push_back({d.probability, pose.translation_m.x(), pose.translation_m.y(),
                    pose.translation_m.z(), pose.rotation.x(), pose.rotation.y(), pose.rotation.z(),
                    pose.rotation.w()});
  }
  return rows;
}

// The numbers of a file are decimal, and its rotations are matrices.
void expect_same(const std::array<double, 8>& a, const std::array<double, 8>& b) {
  const double sign = a[4] * b[4] + a[5] * b[5] + a[6] * b[6] + a[7] * b[7] < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
  for (std::size_t i = 4; i < 8; ++i) EXPECT_NEAR(a[i], sign * b[i], 1e-9);
}

TEST(Program, DetectsInImagesAndNamesASecondCamera) {
  RunningProgram program(bracket());
  CameraPeer peer;
  ASSERT_TRUE(peer.send_until([&] { return !peer.detections.empty(); }))
      << peer.diagnostics() << program.log();
  EXPECT_EQ(peer.detections.front().header.frame_id, "camera");
  EXPECT_FALSE(peer.detections.front().detections.empty());
  (void)peer.writer<sensor_msgs_msg_dds__Image_>("rt/image", {});
  EXPECT_TRUE(peer.spin_until([&] {
    return peer.status && peer.status->message.find("/image: found 2 publishers") == 0;
  })) << peer.diagnostics();
  EXPECT_EQ(program.stop(), 0) << program.log();
}

TEST(Program, MakesNoFurtherTemplatesOnceItEnds) {
  const TemporaryFolder folder;
  ProgramOptions options;
  read_options(bracket({"--template-cache", folder.path() / "cache"}), options);
  const SearchedImages searched{small_world().camera(), {}, {}};
  EXPECT_THROW(template_sets_of(load_models(options.models), options.templates, searched,
                                *small_world().backend, make_template_cache(options.models.cache),
                                [] { return true; }),
               Cancelled);
}

TEST(Program, DetectsWithDepthWhatTheCommandLineDoes) {
  RunningProgram program(bracket({"--depth", "aligned", "--depth-seconds", "60"}));
  CameraPeer peer;
  peer.sends_depth = true;
  ASSERT_TRUE(peer.send_until([&] { return !peer.detections.empty(); }))
      << peer.diagnostics() << program.log();
  EXPECT_EQ(program.stop(), 0) << program.log();

  const TemporaryFolder folder;
  save_png(small_world().image(), folder.path() / "view.png");
  const msg::Image message = depth_message();
  write_depth_png(depth_of(message, {}, "depth"), 0.001, folder.path() / "depth.png");
  const auto expected = found_by_command_line(folder, folder.path() / "view.png",
                                              {"--depth", folder.path() / "depth.png"});
  const std::vector<msg::Detection3D>& found = peer.detections.front().detections;
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_FALSE(found.empty());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const msg::ObjectHypothesisWithPose& best = found[i].results.at(0);
    const msg::Point& p = best.pose.pose.position;
    const msg::Quaternion& q = best.pose.pose.orientation;
    expect_same({best.hypothesis.score, p.x, p.y, p.z, q.x, q.y, q.z, q.w}, expected[i]);
  }
}

TEST(Program, DetectsForAPeerOfAnotherVendor) {
#ifdef EDGESCOUT_FASTDDS_PEER
  RunningProgram program(bracket());
  const TemporaryFolder folder;
  const Image& image = small_world().image();
  const Camera camera = small_world().camera();
  const std::filesystem::path pgm = folder.write(
      "view.pgm", "P5 " + std::to_string(image.width) + " " + std::to_string(image.height) +
                      " 255\n" + std::string(image.pixels.begin(), image.pixels.end()));
  std::string command = "ROS_DOMAIN_ID=" + std::to_string(own_domain()) +
                        " '" EDGESCOUT_FASTDDS_PEER "' detect '" + pgm.string() + "'";
  for (const double number : {camera.fx, camera.fy, camera.cx, camera.cy})
    command += " " + std::to_string(number);
  const std::filesystem::path out = folder.path() / "peer";
  ASSERT_EQ(std::system((command + " >'" + out.string() + "'").c_str()), 0) << program.log();
  std::istringstream lines(content_of(out));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line.substr(0, 6), "stamp ");
  EXPECT_NE(line.find(".5 frame camera"), std::string::npos) << line;
  const auto expected = found_by_command_line(folder, pgm);
  ASSERT_FALSE(expected.empty());
  for (const std::array<double, 8>& row : expected) {
    std::array<double, 8> found{};
    double variance = 0;
    for (double& number : found) lines >> number;
    lines >> variance;
    expect_same(found, row);
    EXPECT_GT(variance, 0);
  }
  std::getline(lines, line);
  std::getline(lines, line);
  EXPECT_EQ(line, "answer to request 7: success");
  EXPECT_EQ(program.stop(), 0) << program.log();
#else
  GTEST_SKIP() << "libfastrtps-dev is missing";
#endif
}

TEST(Program, LivesThroughWrongBytesOfAnotherVendor) {
#ifdef EDGESCOUT_FASTDDS_PEER
  RunningProgram program(bracket({"--log-level", "error"}));
  const TemporaryFolder folder;
  const std::filesystem::path pgm = folder.write("a.pgm", "P5 32 24 255\n" + std::string(768, 'a'));
  const char* count = std::getenv("EDGESCOUT_FUZZ_MESSAGES");
  const std::string command = "ROS_DOMAIN_ID=" + std::to_string(own_domain()) +
                              " '" EDGESCOUT_FASTDDS_PEER "' mutate '" + pgm.string() + "' " +
                              (count ? count : "1000") + " 5 > /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(program.is_running()) << program.log();
  CameraPeer peer;  // it still works
  ASSERT_TRUE(peer.send_until([&] { return !peer.detections.empty(); }))
      << peer.diagnostics() << program.log();
  if (count) std::cout << peer.diagnostics();
  EXPECT_EQ(program.stop(), 0) << program.log();
#else
  GTEST_SKIP() << "libfastrtps-dev is missing";
#endif
}

struct Refusal {
  std::vector<std::string> arguments;
  std::initializer_list<std::string> words;
};

TEST(Program, RefusesWrongRequestsInOneLine) {
  const TemporaryFolder folder;
  const std::string file = folder.write(
      "p.yaml", "/**:\n  ros__parameters: {min_probability: 0.3, minimum_probability: 0.2}\n");
  const std::string scout =
      folder.write("s.yaml", "/**:\n  ros__parameters: {scout: {max_view: 3}}\n");
  const std::string value = folder.write("v.yaml", "/**:\n  ros__parameters: {candidates: 0}\n");
  const std::string list =
      folder.write("l.yaml", "edgescout:\n  ros__parameters: {min_probability: [1, 2]}\n");
  const Refusal refusals[] = {
      {bracket({"--ros-args", "--params-file", file}),
       {"p.yaml: minimum_probability: found an unknown parameter"}},
      {bracket({"--ros-args", "--params-file", scout}),
       {"s.yaml: scout.max_view: found an unknown"}},
      {{"--model", part_file(1), "--unit", "mm", "--ros-args", "--params-file", value},
       {"v.yaml: candidates: found 0, expected 1 to"}},
      {bracket({"--candidates", "0"}), {"--candidates: found 0, expected 1 to"}},
      {bracket({"--ros-args", "-p", "scout.max_views:=0"}),
       {"command line: scout.max_views: found 0, expected 1 to"}},
      {bracket({"--ros-args", "--params-file", list}),
       {"l.yaml: min_probability: found a list of 2 values, expected one value"}},
      {bracket({"--ros-args", "-p", "world_box:=[0, 0, 0, 1, 1, 1, 1]"}),
       {"command line: world_box: found a list of 7 values, expected 6 at most"}},
      {bracket({"--ros-args", "-p", "publish_tf:=maybe"}),
       {"command line: publish_tf: found maybe, expected true or false"}},
      {bracket({"--ros-args", "-p", "faint_edges:=7"}),
       {"command line: faint_edges: found 7, expected true or false"}},
      {bracket({"--publish-tf=maybe"}), {"--publish-tf: found maybe, expected"}},
      {bracket({"-p", "min_probability:=0.5"}), {"-p: found it without --ros-args"}},
      {bracket({"--ros-args", "-p", "tpyo:=1"}),
       {"command line: tpyo: found an unknown parameter"}},
      {{}, {"--model, --templates: found neither"}},
      {{"--model", "none.ply", "--unit", "mm"}, {"none.ply"}},
      {bracket({"--views", "none.json"}), {"none.json"}},
      {bracket({"--nonsense"}), {"--nonsense"}}};
  for (const Refusal& refusal : refusals) {
    ProgramOptions options;
    edgescout::test::expect_input_error(
        [&] {
          read_options(refusal.arguments, options);
          load_models(options.models);
        },
        refusal.words);
  }
  RunningProgram program(refusals[0].arguments);
  EXPECT_EQ(program.wait(), 2);
  const std::string log = program.log();
  EXPECT_TRUE(log.starts_with("edgescout_ros2: error: ")) << log;
  EXPECT_EQ(std::ranges::count(log, '\n'), 1) << log;
}

// Before an image comes, and by the names that were given.
TEST(Program, RefusesDistancesInMillimetres) {
  RunningProgram program({"--model", part_file(1), "--unit", "mm", "--distance-min", "350",
                          "--ros-args", "-p", "distance_max:=800"});
  EXPECT_EQ(program.wait(), 2);
  const std::string log = program.log();
  EXPECT_NE(log.find("obj_000001: distances: found 350 m and more"), std::string::npos) << log;
  EXPECT_NE(log.find("--distance-min and distance_max in metres"), std::string::npos) << log;
}

TEST(Program, TheExampleOfParametersIsOne) {
  ProgramOptions options;
  const std::string file = edgescout::test::examples() / "ros2/parameters.yaml";
  EXPECT_EQ(read_options({"--ros-args", "--params-file", file}, options), "");
  EXPECT_EQ(options.bridge.scout.max_views, 4);
  EXPECT_EQ(options.templates.distance_min_m, 0.3);
  EXPECT_NE(read_options({"--help"}, options).find("--on-request"), std::string::npos);
}

// What stands before --ros-args counts more.
TEST(Program, TakesTheLogLevelOfRos) {
  const auto level_of = [](const std::vector<std::string>& words) {
    ProgramOptions options;
    EXPECT_EQ(read_options(bracket(words), options), "");
    return options.log_level;
  };
  EXPECT_EQ(level_of({}), "info");
  EXPECT_EQ(level_of({"--ros-args", "--log-level", "warn"}), "warning");
  EXPECT_EQ(level_of({"--log-level", "debug", "--ros-args", "--log-level", "warn"}), "debug");
}

// Parameters mean what the options mean; the help lists them.
TEST(Program, TakesParametersOfAFile) {
  const TemporaryFolder folder;
  const std::string file = folder.write(
      "p.yaml", "/**:\n  ros__parameters:\n    use_sim_time: false\n    model: [" + part_file(1) +
                    "]\n    unit: mm\n    device: cpu\n    on_request: true\n"
                    "    faint_edges: false\n    image_qos: reliable\n"
                    "    world_box: [-1, -1, -1, 1, 1, 1]\n    scout: {max_views: 3}\n");
  RunningProgram program({"--ros-args", "--params-file", file, "-r", "__node:=finder", "-r",
                          "image:=/cell/image_raw"});
  Peer peer;
  std::optional<msg::DiagnosticStatus> status;
  peer.subscribe<diagnostic_msgs_msg_dds__DiagnosticArray_>(
      "rt/diagnostics", {},
      [&](const auto& wire) { status = plain_of<msg::DiagnosticArray>(wire).status.at(0); });
  ASSERT_TRUE(peer.spin_until([&] { return status.has_value(); }, 20)) << program.log();
  EXPECT_EQ(status->name, "finder: detection");
  EXPECT_EQ(status->message, "/cell/camera_info: found no publisher, expected one");
  EXPECT_EQ(program.stop(), 0) << program.log();
}

}  // namespace

}  // namespace edgescout::ros2::test
