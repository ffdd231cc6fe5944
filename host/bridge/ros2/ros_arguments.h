// What follows --ros-args on the command line of a ROS 2 node: parameters and other names.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace edgescout::ros2 {

struct Parameter {
  std::string source;               // the file or "command line", for errors
  std::vector<std::string> values;  // of a list several
};
using Parameters = std::map<std::string, Parameter>;  // by name: "min_probability", "scout.radius"

struct RosArguments {
  std::string node = "edgescout", space = "/";  // __node, __ns
  Parameters parameters;                        // of this node; later ones count
  std::map<std::string, std::string> names;     // as stated: "image" -> "/camera/image_raw"
  std::vector<std::string> rest;                // all other arguments
  std::vector<std::string> warnings;            // of files without a section of this node
};

// "/cell/edgescout"
std::string node_name(const RosArguments& arguments);

// Reads "--ros-args [-p NAME:=VALUE] [-r [NODE:]FROM:=TO] [--params-file FILE] [--log-level LEVEL]
// [--]". Sections of a file, renamings and levels of other nodes are left out. The level becomes
// the parameter log_level. InputError: a word that is none of these; a name that ROS refuses; a
// file that is no parameter file, naming file and key.
RosArguments ros_arguments(const std::vector<std::string>& arguments);

// Adds the parameters of a file's text for a node, given by its whole name ("/cell/edgescout"): of
// sections that match it as rcl says ("cell/edgescout", "/*/edgescout", "/**"; nodes may stand in
// their namespaces). Returns a warning where none does, else nothing. InputError naming `source`
// and key.
std::string add_parameters(const std::string& text, const std::string& source,
                           const std::string& node, Parameters& parameters);

// Whether YAML takes the word for true or false.
bool is_truth_value(const std::string& word);

// The whole name of a topic or service, after the renaming of the command line: "image" ->
// "/image",
// "~/detections" -> "/edgescout/detections".
std::string full_name(const std::string& name, const RosArguments& arguments);
// Of another topic in the same place: "/camera/image_raw" -> "/camera/camera_info".
std::string beside(const std::string& topic, const std::string& name);

// The parameters as arguments of the command line: {"--min-probability", "0.3"}. Those that stand
// in `given` are left out. `prefix`: of those that are meant ("scout."), which they lose.
std::vector<std::string> options_of(const Parameters& parameters, const std::string& prefix,
                                    const std::vector<std::string>& given);

}  // namespace edgescout::ros2
