#include "host/bridge/ros2/ros_arguments.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "host/io/files.h"
#include "host/io/one_line.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

constexpr char command_line[] = "command line";

std::vector<std::string> values_of(const YAML::Node& node, const std::string& source,
                                   const std::string& name) {
  if (node.IsScalar()) return {node.Scalar()};
  std::vector<std::string> values;
  if (node.IsSequence())
    for (const YAML::Node& element : node) {
      if (!element.IsScalar()) throw InputError(source, name, "a list of lists", "a list");
      values.push_back(element.Scalar());
    }
  if (values.empty()) throw InputError(source, name, "no value", "a value or a list of some");
  return values;
}

// Every node has it. Stamps are carried through, whatever clock they are of.
bool is_of_every_node(const std::string& name) { return name == "use_sim_time"; }

void add_map(const YAML::Node& map, const std::string& source, const std::string& prefix,
             Parameters& parameters) {
  for (const auto& entry : map) {
    const std::string name = prefix + entry.first.as<std::string>();
    if (is_of_every_node(name)) continue;
    if (entry.second.IsMap())
      add_map(entry.second, source, name + ".", parameters);
    else
      parameters[name] = {source, values_of(entry.second, source, name)};
  }
}

// "/cell/edgescout" -> "/cell"
std::string_view first_part(std::string_view name) { return name.substr(0, name.find('/', 1)); }

// As rcl: "*" stands for one part of a name, "**" for any number of them. Both begin with "/".
bool matches(std::string_view section, std::string_view node) {
  if (section.empty()) return node.empty();
  const std::string_view part = first_part(section), rest = section.substr(part.size());
  if (part == "/**") {
    while (!matches(rest, node)) {
      if (node.empty()) return false;
      node.remove_prefix(first_part(node).size());
    }
    return true;
  }
  if (node.empty()) return false;
  const std::string_view of_node = first_part(node);
  return (part == "/*" || part == of_node) && matches(rest, node.substr(of_node.size()));
}

std::string name_below(const std::string& space, const std::string& key) {
  return space.empty() || key.starts_with('/') ? space + key : space + "/" + key;
}

// The sections of a file. Those of other nodes are noted by name.
class Sections {
 public:
  Sections(const std::string& source, const std::string& node, Parameters& parameters)
      : source_(source), node_(node), parameters_(parameters) {}

  // `space`: the names that the map stands under.
  void read(const YAML::Node& map, const std::string& space) {
    for (const auto& section : map) {
      const std::string key = section.first.as<std::string>();
      const std::string name = name_below(space, key);
      const bool is_of_node = matches(name.starts_with('/') ? name : "/" + name, node_);
      const YAML::Node values = section.second.IsMap() ? section.second["ros__parameters"]
                                                       : YAML::Node(YAML::NodeType::Undefined);
      if (values.IsDefined() && values.IsMap()) {
        if (is_of_node) add_map(values, source_, "", parameters_);
      } else if (is_namespace(section.second)) {
        read(section.second, name);
        continue;
      } else if (is_of_node) {
        throw InputError(source_, name, "no map ros__parameters", "one");
      }
      has_node_ = has_node_ || is_of_node;
      if (!is_of_node) others_ += (others_.empty() ? "" : ", ") + name;
    }
  }

  std::string warning() const {
    return has_node_ ? ""
                     : source_ + ": sections: found " + (others_.empty() ? "none" : others_) +
                           ", expected " + node_ + " or /**: no parameter of it is read";
  }

 private:
  // "cell: {edgescout: {ros__parameters: ..}}"
  static bool is_namespace(const YAML::Node& map) {
    return map.IsMap() && map.size() > 0 &&
           std::ranges::all_of(map, [](const auto& entry) { return entry.second.IsMap(); });
  }

  const std::string& source_;
  const std::string& node_;
  Parameters& parameters_;
  std::string others_;
  bool has_node_ = false;
};

// "a:=b" -> {"a", "b"}
std::pair<std::string, std::string> assignment(const std::string& word) {
  const std::size_t middle = word.find(":=");
  if (middle == std::string::npos || middle == 0)
    throw InputError(command_line, "--ros-args", word, "NAME:=VALUE");
  return {word.substr(0, middle), word.substr(middle + 2)};
}

void add_parameter(const std::string& word, Parameters& parameters) {
  const auto [name, value] = assignment(word);
  if (is_of_every_node(name)) return;
  try {
    parameters[name] = {command_line, values_of(YAML::Load(value), command_line, name)};
  } catch (const YAML::Exception&) {
    parameters[name] = {command_line, {value}};
  }
}

// Letters, digits and "_", no digit first.
bool is_name(std::string_view word) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return !word.empty() && !is_digit(word[0]) &&
         std::ranges::all_of(word, [&](char c) { return is_letter(c) || is_digit(c); });
}

// "image", "/camera/image", "~/detections"
bool is_topic_name(std::string_view word) {
  if (word.starts_with("~/")) word.remove_prefix(1);
  const std::string whole = word.starts_with('/') ? std::string(word) : "/" + std::string(word);
  for (std::string_view rest = whole; !rest.empty(); rest.remove_prefix(first_part(rest).size()))
    if (!is_name(first_part(rest).substr(1))) return false;
  return true;
}

void require_name(bool is_one, const std::string& of, const std::string& name) {
  if (!is_one)
    throw InputError(command_line, of, "\"" + name + "\"",
                     "a name of letters, digits and _, no digit first");
}

// "-r FROM:=TO", for one node alone "-r NODE:FROM:=TO".
struct Renaming {
  std::string node, from, to;
};

Renaming renaming_of(const std::string& word) {
  auto [from, to] = assignment(word);
  const std::size_t colon = from.find(':');
  if (colon == std::string::npos) return {"", from, to};
  return {from.substr(0, colon), from.substr(colon + 1), to};
}

// As rcl: the node's name first, then its namespace, then the others; each counts for the name that
// the node has by then.
void add_names(const std::vector<Renaming>& renamings, RosArguments& ros) {
  const auto is_of_node = [](const std::string& from) {
    return from == "__node" || from == "__name";
  };
  const auto is_for = [](const Renaming& renaming, const std::string& node) {
    return renaming.node.empty() || renaming.node == node;
  };
  const std::string first_name = ros.node;
  for (const Renaming& each : renamings)
    if (is_of_node(each.from) && is_for(each, first_name)) {
      require_name(is_name(each.to), each.from, each.to);
      ros.node = each.to;
    }
  for (const Renaming& each : renamings) {
    if (is_of_node(each.from) || !is_for(each, ros.node)) continue;
    if (each.from == "__ns") {
      ros.space = each.to.starts_with('/') ? each.to : "/" + each.to;
      require_name(ros.space == "/" || is_topic_name(ros.space), each.from, each.to);
    } else {
      require_name(is_topic_name(each.from), "-r", each.from);
      require_name(is_topic_name(each.to), each.from, each.to);
      ros.names[each.from] = each.to;
    }
  }
}

// "warn", or of one logger: "edgescout:=debug".
void add_log_level(const std::string& word, RosArguments& ros) {
  const std::size_t middle = word.find(":=");
  std::string logger = middle == std::string::npos ? "" : word.substr(0, middle);
  std::string level = middle == std::string::npos ? word : word.substr(middle + 2);
  std::ranges::transform(level, level.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::map<std::string, std::string> levels{{"debug", "debug"},  {"info", "info"},
                                                  {"warn", "warning"}, {"warning", "warning"},
                                                  {"error", "error"},  {"fatal", "error"}};
  const auto known = levels.find(level);
  if (known == levels.end())
    throw InputError(command_line, "--log-level", word, "debug, info, warn, error or fatal");
  std::ranges::replace(logger, '.', '/');
  if (logger.empty() || "/" + logger == node_name(ros))
    ros.parameters["log_level"] = {command_line, {known->second}};
}

// One of the words after --ros-args, with the value that follows it.
struct RosWord {
  std::string word, value;
};

// "-p a:=b" where an option of the program is expected.
void require_no_ros_word(const std::string& word) {
  const bool is_ros_option = word == "-p" || word == "--param" || word == "-r" ||
                             word == "--remap" || word == "--params-file";
  if (is_ros_option || (!word.starts_with("--") && word.find(":=") != std::string::npos))
    throw InputError(command_line, word, "it without --ros-args",
                     "--ros-args before parameters and names: --ros-args -p NAME:=VALUE");
}

std::vector<RosWord> split(const std::vector<std::string>& arguments, RosArguments& ros) {
  std::vector<RosWord> words;
  bool is_ros = false;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (word == "--ros-args" || (is_ros && word == "--")) {
      is_ros = word == "--ros-args";
    } else if (!is_ros) {
      require_no_ros_word(word);
      ros.rest.push_back(word);
    } else {
      if (i + 1 == arguments.size())
        throw InputError(command_line, word, "nothing after it", "a value");
      words.push_back({word, arguments[++i]});
    }
  }
  return words;
}

void add_file(const std::string& file, RosArguments& ros) {
  const std::string warning = add_parameters(read_file(file), file, node_name(ros), ros.parameters);
  if (!warning.empty()) ros.warnings.push_back(warning);
}

}  // namespace

RosArguments ros_arguments(const std::vector<std::string>& arguments) {
  RosArguments ros;
  const std::vector<RosWord> words = split(arguments, ros);
  const auto is_any = [](const std::string& word, std::initializer_list<const char*> names) {
    return std::ranges::find(names, word) != names.end();
  };
  std::vector<Renaming> renamings;  // first: sections of files name the node
  for (const auto& [word, value] : words)
    if (is_any(word, {"-r", "--remap"})) renamings.push_back(renaming_of(value));
  add_names(renamings, ros);
  for (const auto& [word, value] : words) {
    if (is_any(word, {"-p", "--param"}))
      add_parameter(value, ros.parameters);
    else if (word == "--params-file")
      add_file(value, ros);
    else if (!is_any(word, {"-r", "--remap", "--log-level"}))
      throw InputError(command_line, "--ros-args", word, "-p, -r, --params-file or --log-level");
  }
  for (const auto& [word, value] : words)  // counts more than a file's log_level
    if (word == "--log-level") add_log_level(value, ros);
  return ros;
}

std::string add_parameters(const std::string& text, const std::string& source,
                           const std::string& node, Parameters& parameters) {
  return with_errors_of_one_line([&] {
    try {
      const YAML::Node root = YAML::Load(text);
      if (!root.IsMap())
        throw InputError(source, "file", "no sections", "\"/**:\" with ros__parameters in it");
      Sections sections(source, node, parameters);
      sections.read(root, "");
      return one_line(sections.warning());
    } catch (const YAML::Exception& error) {
      throw InputError(source, "line " + std::to_string(error.mark.line + 1), error.msg, "YAML");
    }
  });
}

std::string node_name(const RosArguments& ros) {
  return (ros.space == "/" ? "" : ros.space) + "/" + ros.node;
}

std::string full_name(const std::string& name, const RosArguments& ros) {
  const auto whole = [&](const std::string& part) {
    const std::string space = ros.space == "/" ? "" : ros.space;
    if (part.starts_with("~/")) return node_name(ros) + part.substr(1);
    return part.starts_with('/') ? part : space + "/" + part;
  };
  for (const auto& [from, to] : ros.names)
    if (from == name || whole(from) == whole(name)) return whole(to);
  return whole(name);
}

bool is_truth_value(const std::string& word) {
  bool value = false;
  return YAML::convert<bool>::decode(YAML::Node(word), value);
}

std::string beside(const std::string& topic, const std::string& name) {
  return topic.substr(0, topic.rfind('/') + 1) + name;
}

std::vector<std::string> options_of(const Parameters& parameters, const std::string& prefix,
                                    const std::vector<std::string>& given) {
  std::vector<std::string> options;
  for (const auto& [name, parameter] : parameters) {
    const bool has_prefix = name.find('.') != std::string::npos;
    if (prefix.empty() ? has_prefix : !name.starts_with(prefix)) continue;
    std::string option = "--" + name.substr(prefix.size());
    std::ranges::replace(option, '_', '-');
    const bool is_given = std::ranges::any_of(given, [&](const std::string& word) {
      return word == option || word.starts_with(option + "=");
    });
    if (is_given) continue;
    if (parameter.values.size() == 1) {  // flags take a value in this form only
      options.push_back(option + "=" + parameter.values[0]);
    } else {
      options.push_back(option);
      options.insert(options.end(), parameter.values.begin(), parameter.values.end());
    }
  }
  return options;
}

}  // namespace edgescout::ros2
