#include "host/cli/run_program.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <opencv2/core/utils/logger.hpp>

#include "host/cli/caught_errors.h"
#include "host/cli/config.h"
#include "host/cli/exit_codes.h"
#include "host/cli/help.h"
#include "host/cli/renamed_options.h"
#include "host/cli/verbs.h"
#include "host/cli/words_behind_lists.h"
#include "host/core/freed_memory.h"
#include "host/core/log.h"
#include "host/core/option_names.h"
#include "host/io/one_line.h"

namespace edgescout {

namespace {

void send_log_to_stderr() {
  spdlog::set_default_logger(spdlog::stderr_color_mt("edgescout"));
  spdlog::set_pattern("%n: %^%l%$: %v");
  set_log_sink([](LogLevel level, const std::string& message) {
    constexpr spdlog::level::level_enum levels[] = {spdlog::level::debug, spdlog::level::info,
                                                    spdlog::level::warn, spdlog::level::err};
    spdlog::log(levels[static_cast<int>(level)], one_line(message));  // names of files may break it
  });
}

// Its log of an image that it cannot decode would stand beside our line.
void silence_opencv() { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); }

void name_options_as_typed() {
  set_option_naming([](const std::string& name) { return "--" + name; });
}

void add_log_level(CLI::App& app) {
  const std::map<std::string, spdlog::level::level_enum> levels{{"debug", spdlog::level::debug},
                                                                {"info", spdlog::level::info},
                                                                {"warning", spdlog::level::warn},
                                                                {"error", spdlog::level::err}};
  app.add_option_function<std::string>(
         "--log-level", [levels](const std::string& word) { spdlog::set_level(levels.at(word)); },
         "Lowest level of messages on standard error: debug, info, warning or error")
      ->check(CLI::IsMember(levels))
      ->default_str("info");
}

int fail(const std::string& message, ExitCode code) {
  std::cerr << "edgescout: error: " << one_line(message) << std::endl;
  return code;
}

// Lists take the words that stand behind them.
std::string lists_of(const CLI::App& verb) {
  std::string lists;
  for (const CLI::Option* option : verb.get_options())
    if (option->count() > 1 && option->nonpositional())
      lists += (lists.empty() ? "" : ", ") + option->get_name();
  return lists;
}

// Empty: it has none.
std::string verbs_of(const CLI::App& app) {
  std::string verbs;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!verb->get_name().empty()) verbs += " " + verb->get_name();
  return verbs;
}

std::string help_of(const CLI::App& verb) {
  std::string names = verb.get_name();
  for (const CLI::App* outer = verb.get_parent(); outer; outer = outer->get_parent())
    names.insert(0, outer->get_name() + " ");
  return names + " --help-all";
}

// CLI11 reports a missing verb even if the verb is misspelt.
std::string explanation(const CLI::ParseError& error, const CLI::App& app) {
  if (const std::string name = std::string(error.what()).substr(0, 6);
      (name == "inputs" || name == "source") && !app.get_subcommands().empty())
    if (const std::string lists = lists_of(*app.get_subcommands().front()); !lists.empty())
      return "command line: " + name + ": found none: " + lists +
             " took what stands behind, expected " + name + " before it";
  constexpr std::string_view required = " is required";
  std::string text = error.what();
  const bool is_required = text.ends_with(required);
  if (!is_required && !dynamic_cast<const CLI::ExtrasError*>(&error)) return text;
  const CLI::App* verb = &app;
  while (!verb->get_subcommands().empty()) verb = verb->get_subcommands().front();
  const std::vector<std::string> unknown = app.remaining(true);
  const std::string found = unknown.empty() ? "" : "command line: found " + unknown.front();
  if (const std::string verbs = verbs_of(*verb); !verbs.empty())
    return (found.empty() ? "command line: found no subcommand" : found) +
           ", expected one of:" + verbs;
  if (!found.empty()) return found + ", expected what " + help_of(*verb) + " lists";
  if (!is_required) return text;
  return "command line: " + text.substr(0, text.size() - required.size()) +
         ": found nothing, expected a value (" + help_of(*verb) + ")";
}

int run(int argc, char** argv) {
  CLI::App app{"Finds textureless rigid objects in grey images from their CAD models", "edgescout"};
  app.set_version_flag("--version", "edgescout " EDGESCOUT_VERSION);
  app.require_subcommand(1);
  app.fallthrough();  // the program's own options may also follow the verb
  add_help(app);
  add_yaml_config(app);
  add_log_level(app);
  int exit_code = exit_internal_error;
  add_bench(app, exit_code);
  add_camera_verb(app, exit_code);
  add_detect(app, exit_code);
  add_devices(app, exit_code);
  add_eval(app, exit_code);
  add_explain(app, exit_code);
  add_merge(app, exit_code);
  add_model(app, exit_code);
  add_register(app, exit_code);
  add_render(app, exit_code);
  add_scout(app, exit_code);
  add_track(app, exit_code);
  std::vector<std::string> arguments =
      with_inputs_in_front(app, with_present_names({argv + 1, argv + argc}));
  std::ranges::reverse(arguments);  // what CLI11 asks for
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(explanation(error, app), exit_bad_request);
  }
  if (!std::cout.flush())
    return fail("standard output: found a write error, expected room for the result",
                exit_bad_request);
  return exit_code;
}

}  // namespace

int run_program(int argc, char** argv) {
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file-size limit is then an error of write(), as a full disk is
  keep_freed_memory();
  name_options_as_typed();
  send_log_to_stderr();
  silence_opencv();
  return with_caught_errors([&] { return run(argc, argv); }, fail);
}

}  // namespace edgescout
