// The options of the program: those of `edgescout detect` and `edgescout scout` that a node needs,
// and its own.
#pragma once

#include <string>
#include <vector>

#include "host/bridge/ros2/bridge_options.h"
#include "host/bridge/ros2/dds/bridge_topics.h"
#include "host/bridge/ros2/ros_arguments.h"
#include "host/cli/inputs.h"

namespace edgescout::ros2 {

struct ProgramOptions {
  RosArguments ros;
  ModelArguments models;
  TemplateOptions templates;
  CameraArguments camera;
  std::string device = "auto";
  std::string log_level = "info";
  std::string views_file;
  TopicOptions topics;
  BridgeOptions bridge;
};

// Reads the command line and the files of parameters that it names. Returns the text to print in
// place of work (--help), or none. InputError: an option or a parameter that does not exist, named
// with its file, or a value out of bounds.
std::string read_options(const std::vector<std::string>& arguments, ProgramOptions& options);

}  // namespace edgescout::ros2
