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
  EXPECT_EQ(add_parameters(file, "f.yaml", "/edgescout", parameters), "");
  EXPECT_EQ(options_of(parameters, "", {}),
            (Words{"--min-probability=0.5", "--model", "a.ply", "b c.ply", "--on-request=true"}));
  EXPECT_EQ(options_of(parameters, "scout.", {}), (Words{"--radius=0.4"}));
  EXPECT_EQ(options_of(parameters, "", {"--model", "c.ply", "--on-request"}),
            (Words{"--min-probability=0.5"}));
}

// Whether a file's section is read for a node, and what is said where it is not.
std::string warning_of(const std::string& section, const std::string& node, bool is_read) {
  Parameters parameters;
  const std::string warning = add_parameters(
      "\"" + section + "\": {ros__parameters: {min_probability: 0.5}}", "f.yaml", node, parameters);
  EXPECT_EQ(parameters.contains("min_probability"), is_read) << section << " " << node;
  EXPECT_EQ(warning.empty(), is_read) << section << " " << node;
  return warning;
}

TEST(RosArguments, SectionsNameTheNodeWithItsNamespace) {
  for (const char* section : {"/cell/edgescout", "cell/edgescout", "/cell/*", "/*/edgescout", "/**",
                              "**", "/**/edgescout", "/cell/**", "/*/*", "/**/*", "/cell/**/*"})
    warning_of(section, "/cell/edgescout", true);
  for (const char* section : {"/edgescout", "edgescout", "/*", "/cell", "/cell/edgescout/part",
                              "/cell/edge", "/*/*/*", "/cell/other", "/hall/**"})
    warning_of(section, "/cell/edgescout", false);
  for (const char* section : {"edgescout", "/edgescout", "/*", "/**/edgescout", "/**"})
    warning_of(section, "/edgescout", true);
  EXPECT_EQ(warning_of("edgescout", "/cell/edgescout", false),
            "f.yaml: sections: found edgescout, expected /cell/edgescout or /**: no parameter of "
            "it is read");
}

TEST(RosArguments, NodesMayStandInTheirNamespaces) {
  Parameters parameters;
  const std::string text =
      "/hall:\n  cell:\n    edgescout: {ros__parameters: {unit: mm, scout: {radius: 0.4}}}\n"
      "    other: {ros__parameters: {nonsense: 1}}\n";
  EXPECT_EQ(add_parameters(text, "f.yaml", "/hall/cell/edgescout", parameters), "");
  EXPECT_EQ(parameters.size(), 2u);
  EXPECT_EQ(parameters.at("unit").values, Words{"mm"});
  EXPECT_NE(add_parameters(text, "f.yaml", "/cell/edgescout", parameters)
                .find("found /hall/cell/edgescout, /hall/cell/other, expected /cell/edgescout"),
            std::string::npos);
}

TEST(RosArguments, WarnsOfAFileOfOtherNodes) {
  const edgescout::test::TemporaryFolder folder;
  const std::string other = folder.write("o.yaml", "other: {ros__parameters: {a: 9}}");
  const std::string own = folder.write("p.yaml", "/cell/edgescout: {ros__parameters: {a: 1}}");
  const RosArguments ros = ros_arguments(
      {"--ros-args", "--params-file", other, "--params-file", own, "-r", "__ns:=/cell"});
  EXPECT_EQ(ros.parameters.at("a").values, Words{"1"});
  ASSERT_EQ(ros.warnings.size(), 1u);
  EXPECT_NE(ros.warnings[0].find("o.yaml: sections: found other, expected /cell/edgescout"),
            std::string::npos);
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

TEST(RosArguments, RenamesOfOneNodeCountForItAlone) {
  const RosArguments ros = ros_arguments({"--ros-args", "-r", "edgescout:__node:=finder", "-r",
                                          "other:__node:=nobody", "-r", "finder:image:=/a", "-r",
                                          "edgescout:camera_info:=/b", "-r", "finder:__ns:=/cell"});
  EXPECT_EQ(node_name(ros), "/cell/finder");
  EXPECT_EQ(full_name("image", ros), "/a");
  EXPECT_EQ(full_name("camera_info", ros), "/cell/camera_info");
}

TEST(RosArguments, RefusesNamesThatRosRefuses) {
  for (const char* renaming : {"__node:=bad name", "__node:=", "__node:=1st", "__node:=a/b",
                               "__ns:=/a b", "__ns:=/a/", "__ns:=//a", "image:=/a b", "image:=",
                               "image:=/1st", "im age:=/a", "edgescout::=/a", "~image:=/a"})
    expect_input_error(
        [&] {
          ros_arguments({"--ros-args", "-r", renaming});
        },
        {"command line", "expected a name of letters, digits and _"});
  expect_input_error(
      [] {
        ros_arguments({"--ros-args", "-r", "__node:=bad name"});
      },
      {"command line: __node: found \"bad name\""});
}

TEST(RosArguments, TheLogLevelIsAParameter) {
  const edgescout::test::TemporaryFolder folder;
  const std::string path = folder.write("p.yaml", "/**: {ros__parameters: {log_level: debug}}");
  const auto level_of = [&](const Words& more) {
    Words words{"--ros-args", "-r", "__ns:=/cell", "--params-file", path};
    words.insert(words.begin() + 1, more.begin(), more.end());
    return ros_arguments(words).parameters.at("log_level").values.at(0);
  };
  EXPECT_EQ(level_of({}), "debug");
  EXPECT_EQ(level_of({"--log-level", "warn"}), "warning");
  EXPECT_EQ(level_of({"--log-level", "INFO"}), "info");
  EXPECT_EQ(level_of({"--log-level", "fatal"}), "error");
  EXPECT_EQ(level_of({"--log-level", "cell.edgescout:=error"}), "error");
  EXPECT_EQ(level_of({"--log-level", "rcl:=error"}), "debug");
  for (const char* level : {"debug2", "", "rcl:=loud"})
    expect_input_error(
        [&] {
          level_of({"--log-level", level});
        },
        {"command line: --log-level: found ", "expected debug, info, warn, error"});
}

TEST(RosArguments, KnowsTruthValues) {
  for (const char* word : {"true", "false", "True", "yes", "off"})
    EXPECT_TRUE(is_truth_value(word));
  for (const char* word : {"7", "1", "maybe", ""}) EXPECT_FALSE(is_truth_value(word)) << word;
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
    return [&parameters, text] { add_parameters(text, "f.yaml", "/edgescout", parameters); };
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
