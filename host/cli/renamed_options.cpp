#include "host/cli/renamed_options.h"

#include <algorithm>

#include "host/core/log.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct RenamedOption {
  std::string old_name, new_name;
  bool is_ablation = false;
};

// 0.1 -> 0.2. Ablations whose name stays are listed for the verbs that had them.
const std::vector<RenamedOption>& renamed_options() {
  static const std::vector<RenamedOption> options{
      {"helping-views", "support-views"},
      {"aligned", "coarse-poses"},
      {"aligned-jointly", "coarse-poses-joint"},
      {"promising", "medium-poses-joint"},
      {"max-spent", "max-claimed"},
      {"second-look", "restart-rotation"},
      {"survivors", "search-kept"},
      {"no-polish", "no-edge-icp"},
      {"literal", "paper-formula", true},
      {"scenes-by-psi", "combinations-by-psi", true},
      {"sharpness", "sharpness", true},
      {"free-sight", "visibility-exponent", true},
      {"repeat-angle", "view-correlation-angle", true},
      {"unknown", "exploration-bonus", true},
      {"unknown-angle", "exploration-correlation-angle", true},
      {"seen", "seen-distance", true},
      {"alone", "search-alone", true},
      {"first-image-only", "first-image-only", true},
  };
  return options;
}

// By the old name or, for an ablation, the new one; nullptr: not in the table.
const RenamedOption* find(const std::string& name) {
  const auto& all = renamed_options();
  const auto it = std::ranges::find_if(all, [&](const RenamedOption& option) {
    return option.old_name == name || (option.is_ablation && option.new_name == name);
  });
  return it == all.end() ? nullptr : &*it;
}

void warn(const std::string& name, const RenamedOption& option) {
  if (name != option.new_name)
    log(LogLevel::Warning, "--" + name + " is now --" + option.new_name +
                               "; the former name goes with the next version");
}

std::string place_of_ablation(const std::string& name, const RenamedOption& option) {
  const std::string place = " of edgescout bench experiments";
  return name == option.new_name ? "--" + name + " is an option" + place
                                 : "--" + name + " is now --" + option.new_name + place;
}

}  // namespace

std::vector<std::string> with_present_names(std::vector<std::string> arguments) {
  const bool is_bench = std::ranges::find(arguments, "bench") != arguments.end();
  for (std::string& argument : arguments) {
    if (argument == "--") break;
    if (!argument.starts_with("--")) continue;
    const std::size_t end = std::min(argument.find('='), argument.size());
    const std::string name = argument.substr(2, end - 2);
    const RenamedOption* option = find(name);
    if (!option) continue;
    if (option->is_ablation && !is_bench) throw InputError(place_of_ablation(name, *option));
    warn(name, *option);
    argument = "--" + option->new_name + argument.substr(end);
  }
  return arguments;
}

std::string present_name(const std::string& key, const std::string& source,
                         const std::function<bool(const std::string&)>& is_known) {
  const RenamedOption* option = find(key);
  if (!option) return key;
  if (!is_known(option->new_name)) {
    if (option->is_ablation) throw InputError(source + ": " + place_of_ablation(key, *option));
    return key;
  }
  warn(key, *option);
  return option->new_name;
}

}  // namespace edgescout
