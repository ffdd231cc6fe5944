#include "host/cli/help.h"

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace edgescout {

namespace {

std::string without(const std::string& part, std::string text) {
  if (const std::size_t at = text.find(part); at != std::string::npos) text.erase(at, part.size());
  return text;
}

// One for the program and all its verbs, which inherit it.
class LevelledHelp : public CLI::Formatter {
 public:
  void mark_expert(const CLI::Option* option) { expert_.insert(option); }

  // Without the value that CLI11 gives a flag's negation.
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    return without("{false}", CLI::Formatter::make_option_name(option, is_positional));
  }

  // Without an empty list as default: it says that the option is not set.
  std::string make_option_opts(const CLI::Option* option) const override {
    return without("=[]", CLI::Formatter::make_option_opts(option));
  }

  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    if (shows_basic_) std::erase_if(options, [&](const CLI::Option* o) { return is_expert(o); });
    return options.empty() ? "" : CLI::Formatter::make_group(group, is_positional, options);
  }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    shows_basic_ = mode == CLI::AppFormatMode::Normal;
    std::string text = CLI::Formatter::make_help(app, name, mode);
    while (text.find("\n\n\n") != std::string::npos)  // also left by groups without basic options
      text.erase(text.find("\n\n\n"), 1);
    const std::size_t hidden =
        app->get_options([&](const CLI::Option* option) { return is_expert(option); }).size();
    if (mode != CLI::AppFormatMode::Normal || hidden == 0) return text;
    return text + "--help-all shows " + std::to_string(hidden) +
           (hidden == 1 ? " more option\n" : " more options\n");
  }

 private:
  bool is_expert(const CLI::Option* option) const { return expert_.contains(option); }
  std::set<const CLI::Option*> expert_;
  mutable bool shows_basic_ = true;  // of the help that is being made
};

}  // namespace

void add_help(CLI::App& program) {
  program.formatter(std::make_shared<LevelledHelp>());
  program.set_help_flag("-h,--help", "Show the basic options and exit");
  program.set_help_all_flag("--help-all", "Show all options and exit");
}

void mark_expert(CLI::App& verb, const CLI::Option* option) {
  if (const auto help = std::dynamic_pointer_cast<LevelledHelp>(verb.get_formatter()))
    help->mark_expert(option);
}

}  // namespace edgescout
