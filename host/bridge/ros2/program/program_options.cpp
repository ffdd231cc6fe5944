#include "host/bridge/ros2/program/program_options.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <numbers>
#include <set>
#include <sstream>
#include <string_view>

#include "host/active/views.h"
#include "host/cli/common_arguments.h"
#include "host/cli/help.h"
#include "host/cli/option_table.h"
#include "host/cli/template_sets.h"
#include "host/core/option_names.h"
#include "host/io/camera_file.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

constexpr char scout_prefix[] = "scout.";

void add_topics(CLI::App& app, TopicOptions& topics) {
  const auto choice = [&](const std::string& name, bool& field, const char* no, const char* yes,
                          const std::string& help) {
    app.add_option_function<std::string>(
           name, [&field, yes](const std::string& word) { field = word == yes; }, help)
        ->check(CLI::IsMember(std::vector<std::string>{no, yes}))
        ->default_str(field ? yes : no)
        ->group("ROS 2");
  };
  choice("--image-transport", topics.is_compressed, "raw", "compressed",
         "Form of the images: raw, or compressed (IMAGE/compressed)");
  choice("--image-qos", topics.is_image_reliable, "sensor_data", "reliable",
         "Of images and CameraInfo: sensor_data takes them from every publisher; reliable misses "
         "none, of reliable publishers");
}

void add_options(CLI::App& app, ProgramOptions& o) {
  add_model_arguments(app, o.models);
  add_camera(app, o.camera);
  add_device(app, o.device);
  app.add_option("--log-level", o.log_level,
                 "Lowest level of messages on standard error: debug, info, warning or error")
      ->check(CLI::IsMember({"debug", "info", "warning", "error"}))
      ->capture_default_str();
  add_topics(app, o.topics);
  CommandLineOptions add(app);
  describe(o.bridge, add);
  app.add_option("--world-frame", o.bridge.world_frame,
                 "Frame of the poses, by tf; default: that of the image")
      ->type_name("FRAME")
      ->group("ROS 2");
  app.add_option("--views", o.views_file,
                 "Where the scout may send the camera: [{camera_from_world: {R, t}} ..]")
      ->type_name("FILE")
      ->group("ROS 2");
  add_max_seconds(app, o.bridge.max_seconds);
  add_scale_camera(app, o.bridge.scale_camera);
  describe(o.bridge.images, add);
  add_detection_options(app, o.templates, o.bridge.pipeline);
}

// A list where one value is meant would be read as further arguments, and a flag as a count.
void require_fitting(const CLI::Option& option, const std::string& name,
                     const Parameter& parameter) {
  const int most = option.get_items_expected_max();
  const bool is_flag = most == 0;
  const std::size_t count = parameter.values.size();
  if (count > std::size_t(std::max(most, 1)))
    throw InputError(parameter.source, name, "a list of " + std::to_string(count) + " values",
                     most > 1 ? std::to_string(most) + " at most" : "one value");
  if (is_flag && !is_truth_value(parameter.values[0]))
    throw InputError(parameter.source, name, parameter.values[0], "true or false");
}

// Names where a parameter stands that does not exist or has no fitting value.
void require_known(const CLI::App& app, const Parameters& parameters, const std::string& prefix) {
  for (const auto& [name, parameter] : parameters) {
    const bool has_prefix = name.find('.') != std::string::npos;
    if (prefix.empty() ? has_prefix && !name.starts_with(scout_prefix)
                       : !name.starts_with(prefix)) {
      if (!prefix.empty()) continue;
      throw InputError(parameter.source, name, "an unknown parameter", "one of --help-all");
    }
    if (has_prefix && prefix.empty()) continue;
    std::string option = name.substr(prefix.size());
    std::ranges::replace(option, '_', '-');
    const CLI::Option* known = app.get_option_no_throw("--" + option);
    if (!known)
      throw InputError(parameter.source, name, "an unknown parameter", "one of --help-all");
    require_fitting(*known, name, parameter);
  }
}

// Messages name an option as it was given: "--distance-min" on the command line, else the parameter
// "distance_min".
std::set<std::string>& typed_options() {
  static std::set<std::string> options;
  return options;
}

void name_options_as_given(const std::vector<std::string>& words) {
  typed_options().clear();
  for (const std::string& word : words)
    if (word.starts_with("--")) typed_options().insert(word.substr(0, word.find('=')));
  set_option_naming([](const std::string& name) {
    if (typed_options().contains("--" + name)) return "--" + name;
    std::string parameter = name;
    std::ranges::replace(parameter, '-', '_');
    return parameter;
  });
}

void parse(CLI::App& app, std::vector<std::string> arguments) {
  std::ranges::reverse(arguments);  // what CLI11 asks for
  app.parse(std::move(arguments));
}

// "Could not convert: --center = a" -> "--center: found a, expected a value of its type"
std::string naming_option_first(const std::string& message) {
  constexpr std::string_view conversion = "Could not convert: ", middle = " = ";
  const std::size_t end = message.find(middle);
  if (!message.starts_with(conversion) || end == std::string::npos) return message;
  return message.substr(conversion.size(), end - conversion.size()) + ": found " +
         message.substr(end + middle.size()) + ", expected a value of its type";
}

// "--candidates: found 0" -> "p.yaml: candidates: found 0" where that file says so.
std::string naming_parameters(const std::string& message, const Parameters& parameters) {
  const std::size_t end = message.find(": ");
  if (!message.starts_with("--") || end == std::string::npos) return message;
  const std::string option = message.substr(0, end);
  if (typed_options().contains(option)) return message;
  for (const std::string& prefix : {std::string(), std::string(scout_prefix)}) {
    std::string name = option.substr(2);
    std::ranges::replace(name, '-', '_');
    if (const auto given = parameters.find(prefix + name); given != parameters.end())
      return given->second.source + ": " + given->first + message.substr(end);
  }
  return message;
}

void finish(ProgramOptions& o) {
  BridgeOptions& bridge = o.bridge;
  bridge.node = o.ros.node;
  o.topics.depth = bridge.depth;
  bridge.field_of_view_rad = o.camera.field_of_view_deg * std::numbers::pi / 180;
  if (!o.camera.file.empty()) {
    bridge.camera = load_camera(o.camera.file, o.camera.name);
    bridge.camera_file = o.camera.file;
  }
  if (!o.views_file.empty()) bridge.scout_views = load_views(o.views_file);
  bridge.pipeline.validate();
  bridge.images.validate();
  bridge.depth_values.validate();
  bridge.scout.validate();
  o.templates.validate();
}

}  // namespace

std::string read_options(const std::vector<std::string>& arguments, ProgramOptions& options) {
  options.ros = ros_arguments(arguments);
  name_options_as_given(options.ros.rest);
  CLI::App app{
      "Detection as a node of ROS 2, on Cyclone DDS. Parameters have the names of the "
      "options, with underscores; those of the scout begin with \"scout.\"",
      "edgescout_ros2"};
  CLI::App scout;
  add_help(app);
  app.set_version_flag("--version", "edgescout_ros2 " EDGESCOUT_VERSION);
  add_options(app, options);
  CommandLineOptions add_to_scout(scout);
  describe_scout(options.bridge.scout, add_to_scout);
  const Parameters& parameters = options.ros.parameters;
  require_known(app, parameters, "");
  require_known(scout, parameters, scout_prefix);
  try {
    std::vector<std::string> words = options_of(parameters, "", options.ros.rest);
    words.insert(words.end(), options.ros.rest.begin(), options.ros.rest.end());
    parse(app, words);
    parse(scout, options_of(parameters, scout_prefix, {}));
  } catch (const CLI::Success& text) {
    std::ostringstream printed;
    app.exit(text, printed, printed);
    return printed.str();
  } catch (const CLI::ParseError& error) {
    throw InputError(naming_parameters(naming_option_first(error.what()), parameters));
  }
  refuse_beside_templates(app);
  finish(options);
  return "";
}

}  // namespace edgescout::ros2
