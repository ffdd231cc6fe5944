#include "host/bridge/ros2/ros_arguments.h"

#include <gtest/gtest.h>

#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::ros2::test {

namespace {

using edgescout::test::expect_input_error;
using Words = std::vector<std::string>;

constexpr char file[] = R"(
/**:
  ros__parameters:
    use_sim_time: true
    model: [a.ply, "b c.ply"]
    min_probability: 0.3
    scout: {radius: 0.4}
other_node:
  ros__parameters: {nonsense: 1}
edgescout:
  ros__parameters: {min_probability: 0.5, on_request: true}
)";

TEST(RosArguments, ReadsAParameterFile) {
  Parameters parameters;
  add_parameters(file, "f.yaml", "edgescout", parameters);
  EXPECT_EQ(options_of(parameters, "", {}),
            (Words{"--min-probability=0.5", "--model", "a.ply", "b c.ply", "--on-request=true"}));
  EXPECT_EQ(options_of(parameters, "scout.", {}), (Words{"--radius=0.4"}));
  EXPECT_EQ(options_of(parameters, "", {"--model", "c.ply", "--on-request"}),
            (Words{"--min-probability=0.5"}));
}

TEST(RosArguments, LaterWordsCount) {
  const edgescout::test::TemporaryFolder folder;
  const std::string path = folder.write("p.yaml", file);
  const RosArguments ros = ros_arguments({"--unit", "mm", "--ros-args", "--params-file", path, "-p",
                                          "min_probability:=0.9", "-p", "center:=[0, 0.1, 2]", "-r",
                                          "__node:=finder", "-r", "image:=/cam/image_raw",
                                          "--remap", "__ns:=cell", "--", "--device", "cpu"});
  EXPECT_EQ(ros.rest, (Words{"--unit", "mm", "--device", "cpu"}));
  EXPECT_EQ(ros.parameters.at("min_probability").values, Words{"0.9"});
  EXPECT_EQ(ros.parameters.at("center").values, (Words{"0", "0.1", "2"}));
  EXPECT_FALSE(ros.parameters.contains("on_request"));  // of another node
  EXPECT_EQ(full_name("image", ros), "/cam/image_raw");
  EXPECT_EQ(full_name("~/detections", ros), "/cell/finder/detections");
  EXPECT_EQ(full_name("camera_info", ros), "/cell/camera_info");
  EXPECT_EQ(full_name("/tf", ros), "/tf");
  EXPECT_EQ(beside(full_name("image", ros), "camera_info"), "/cam/camera_info");
}

TEST(RosArguments, NamesMayBeGivenWhole) {
  const RosArguments ros = ros_arguments(
      {"--ros-args", "-r", "/tf:=/robot/tf", "-r", "~/detections:=found", "-r", "/image:=/x"});
  EXPECT_EQ(full_name("/tf", ros), "/robot/tf");
  EXPECT_EQ(full_name("~/detections", ros), "/found");
  EXPECT_EQ(full_name("image", ros), "/x");
}

TEST(RosArguments, RefusesOtherWords) {
  expect_input_error([] { ros_arguments({"--ros-args", "-x", "y"}); }, {"--ros-args: found -x"});
  expect_input_error([] { ros_arguments({"--ros-args", "-p"}); }, {"-p: found nothing after it"});
  expect_input_error([] { ros_arguments({"--ros-args", "-p", "a=3"}); }, {"found a=3", ":="});
  for (const Words& words : {Words{"-p", "a:=1"}, Words{"--unit", "mm", "-r", "image:=/x"},
                             Words{"--params-file", "p.yaml"}, Words{"a:=1"},
                             Words{"--ros-args", "-p", "a:=1", "--", "-p", "b:=1"}})
    expect_input_error([&] { ros_arguments(words); },
                       {"found it without --ros-args", "expected --ros-args before"});
  expect_input_error(
      [] {
        ros_arguments({"--ros-args", "--params-file", "none.yaml"});
      },
      {"none.yaml"});
  Parameters parameters;
  const auto add = [&](const std::string& text) {
    return [&parameters, text] { add_parameters(text, "f.yaml", "edgescout", parameters); };
  };
  expect_input_error(add("a: [b"), {"f.yaml: line"});
  expect_input_error(add("- 1"), {"f.yaml: file: found no sections"});
  expect_input_error(add("/**: {a: 1}"), {"f.yaml: /**: found no map ros__parameters"});
  expect_input_error(add("/**: 3"), {"f.yaml: /**"});
  expect_input_error(add("/**: {ros__parameters: {a: [[1]]}}"),
                     {"f.yaml: a: found a list of lists"});
  expect_input_error(add("/**: {ros__parameters: {a: []}}"), {"f.yaml: a: found no value"});
  expect_input_error(add("/**: {ros__parameters: {a: }}"), {"f.yaml: a: found no value"});
}

}  // namespace

}  // namespace edgescout::ros2::test
