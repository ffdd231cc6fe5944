#include "host/cli/config.h"

#include <yaml-cpp/yaml.h>

#include "host/cli/renamed_options.h"
#include "host/io/one_line.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// The app of the verb that runs, and the names that lead to it.
struct RunningVerb {
  std::vector<const CLI::App*> apps;  // the program first
  std::vector<std::string> names;     // one less
};

RunningVerb running_verb(const CLI::App& program) {
  RunningVerb running{{&program}, {}};
  const auto is_running = [](const CLI::App* verb) { return verb->parsed(); };
  while (true) {
    const std::vector<const CLI::App*> next = running.apps.back()->get_subcommands(is_running);
    if (next.empty()) return running;
    running.apps.push_back(next.front());
    running.names.push_back(next.front()->get_name());
  }
}

bool has_option(const CLI::App& app, const std::string& name) {
  return app.get_option_no_throw("--" + name) || app.get_option_no_throw(name);
}

class YamlReader {
 public:
  YamlReader(std::string source, RunningVerb running)
      : source_(std::move(source)), running_(std::move(running)) {}

  // `depth`: number of verbs' names above these keys.
  void read(const YAML::Node& map, std::size_t depth) {
    for (const auto& entry : map) {
      const std::string key = entry.first.as<std::string>();
      if (entry.second.IsMap())
        read_section(key, entry.second, depth);
      else
        add_item(key, entry.second, depth);
    }
  }
  std::vector<CLI::ConfigItem> take() { return std::move(items_); }

 private:
  void read_section(const std::string& verb, const YAML::Node& section, std::size_t depth) {
    const auto verbs = running_.apps[depth]->get_subcommands(
        [&](const CLI::App* app) { return app->get_name() == verb; });
    if (verbs.empty())
      throw InputError(source_, verb, "a section", "an option or the name of a verb");
    if (depth < running_.names.size() && running_.names[depth] == verb) read(section, depth + 1);
  }

  // The nearest app that has the option takes it: its place among the running apps, counted from 1.
  // 0: none.
  std::size_t level_of(const std::string& key) const {
    std::size_t level = running_.apps.size();
    while (level > 0 && !has_option(*running_.apps[level - 1], key)) --level;
    return level;
  }

  // Keys above the verb's own section also apply to the verb.
  void add_item(std::string key, const YAML::Node& value, std::size_t depth) {
    if (level_of(key) == 0)
      key = present_name(key, source_, [&](const std::string& name) { return level_of(name) > 0; });
    const std::size_t level = level_of(key);
    if (level == 0 || level < depth + 1)
      throw InputError(source_, key, "an unknown option", "one that --help-all lists");
    CLI::ConfigItem item;
    item.parents.assign(running_.names.begin(),
                        running_.names.begin() + static_cast<std::ptrdiff_t>(level - 1));
    item.name = key;
    if (value.IsSequence())
      for (const YAML::Node& element : value) item.inputs.push_back(element.as<std::string>());
    else
      item.inputs.push_back(value.as<std::string>());
    items_.push_back(std::move(item));
  }

  std::string source_;
  RunningVerb running_;
  std::vector<CLI::ConfigItem> items_;
};

void emit_options(YAML::Emitter& out, const CLI::App& app, bool default_also) {
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_configurable() || option->get_lnames().empty()) continue;
    const bool given = option->count() > 0;
    if (!given && (!default_also || option->get_default_str().empty())) continue;
    out << YAML::Key << option->get_lnames().front() << YAML::Value;
    if (!given)
      out << option->get_default_str();
    else if (option->results().size() == 1)
      out << option->results().front();
    else
      out << YAML::Flow << option->results();
  }
  for (const CLI::App* verb :
       app.get_subcommands([](const CLI::App* verb) { return verb->parsed(); })) {
    out << YAML::Key << verb->get_name() << YAML::Value << YAML::BeginMap;
    emit_options(out, *verb, default_also);
    out << YAML::EndMap;
  }
}

}  // namespace

std::vector<CLI::ConfigItem> YamlConfig::from_config(std::istream& input) const {
  const std::vector<std::string> files = program_.get_config_ptr()->results();
  const std::string source = files.empty() ? "configuration" : files.back();
  YamlReader reader(source, running_verb(program_));
  return with_errors_of_one_line([&] {
    try {
      const YAML::Node root = YAML::Load(input);
      if (!root.IsNull() && !root.IsMap())
        throw InputError(source, "configuration", "no keys", "lines such as \"device: auto\"");
      reader.read(root, 0);
    } catch (const YAML::Exception& error) {
      throw InputError(source, "line " + std::to_string(error.mark.line + 1), error.msg, "YAML");
    }
    return reader.take();
  });
}

std::string YamlConfig::to_config(const CLI::App* app, bool default_also, bool, std::string) const {
  YAML::Emitter out;
  out << YAML::BeginMap;
  emit_options(out, *app, default_also);
  out << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

void add_yaml_config(CLI::App& program) {
  program
      .set_config("--config", "", "YAML file with options by the same names; the command line wins")
      ->type_name("FILE")
      ->configurable(false);
  program.config_formatter(std::make_shared<YamlConfig>(program));
}

}  // namespace edgescout
