#include "host/cli/option_table.h"

#include <algorithm>
#include <sstream>

#include "host/cli/help.h"

namespace edgescout {

namespace {

template <typename T>
std::string text_of(T value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

template <typename T>
CLI::Validator within(T low, T high, const std::string& help) {
  const std::string bounds = text_of(low) + " to " + text_of(high);
  return CLI::Validator(
      [=](const std::string& found) {
        T value{};
        const bool is_number = CLI::detail::lexical_cast(found, value);
        return is_number && value >= low && value <= high
                   ? ""
                   : "found " + found + ", expected " + bounds +
                         (is_number
                              ? unit_after_bounds(help, double(value), double(low), double(high))
                              : "");
      },
      "in " + bounds);
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  const std::string list = CLI::detail::join(words, ", ");
  return CLI::Validator(
      [=](const std::string& found) {
        return std::ranges::find(words, found) != words.end()
                   ? ""
                   : "found " + found + ", expected one of " + list;
      },
      "one of " + list);
}

// What is said of an option besides its name and field.
struct Heading {
  std::string help, group;
  OptionLevel level;
};

void finish(CLI::App& verb, CLI::Option* option, const Heading& heading) {
  option->group(heading.group);
  if (heading.level == OptionLevel::Expert) mark_expert(verb, option);
}

template <typename T>
void add_number(CLI::App& verb, const std::string& name, T& field, std::pair<T, T> bounds,
                const Heading& heading) {
  finish(verb,
         verb.add_option("--" + name, field, heading.help)
             ->check(within(bounds.first, bounds.second, heading.help))
             ->capture_default_str(),
         heading);
}

void add_flag(CLI::App& verb, const std::string& name, bool& field, const Heading& heading) {
  CLI::Option* option = verb.add_flag("--" + name, field, heading.help);
  option->default_function([&field] { return std::string(field ? "true" : "false"); });
  finish(verb, option, heading);
}

}  // namespace

void CommandLineOptions::number(const OptionInfo& option, int& field, int low, int high) {
  add_number(verb_, option.name, field, {low, high}, {option.help, group_, option.level});
}

void CommandLineOptions::number(const OptionInfo& option, float& field, float low, float high) {
  add_number(verb_, option.name, field, {low, high}, {option.help, group_, option.level});
}

void CommandLineOptions::number(const OptionInfo& option, double& field, double low, double high) {
  add_number(verb_, option.name, field, {low, high}, {option.help, group_, option.level});
}

void CommandLineOptions::range(const OptionInfo& option, Range& field, double low, double high) {
  const std::string name = std::string("--") + option.name;
  CLI::Option* added = verb_.add_option_function<std::vector<double>>(
      name,
      [&field, name](const std::vector<double>& ends) {
        if (ends.back() < ends.front())
          throw CLI::ValidationError(name, "found " + text_of(ends.front()) + " before " +
                                               text_of(ends.back()) + ", expected MIN MAX");
        field = {ends.front(), ends.back()};
      },
      option.help);
  added->expected(1, 2)->type_name("MIN [MAX]")->check(within(low, high, option.help));
  added->default_function(
      [&field] { return "[" + text_of(field.low) + ", " + text_of(field.high) + "]"; });
  added->capture_default_str();
  finish(verb_, added, {option.help, group_, option.level});
}

void CommandLineOptions::numbers(const OptionInfo& option, std::vector<double>& field, int count,
                                 double low, double high) {
  finish(verb_,
         verb_.add_option(std::string("--") + option.name, field, option.help)
             ->expected(count)
             ->check(within(low, high, option.help))
             ->capture_default_str(),
         {option.help, group_, option.level});
}

void CommandLineOptions::flag(const OptionInfo& option, bool& field) {
  const std::string name = option.name;
  add_flag(verb_, field ? name + ",!--no-" + name : name, field,
           {option.help, group_, option.level});
}

void CommandLineOptions::off_flag(const OptionInfo& option, bool& field) {
  CLI::Option* added = verb_.add_flag_function(
      std::string("--") + option.name, [&field](std::int64_t count) { field = count <= 0; },
      option.help);
  added->default_function([&field] { return std::string(field ? "false" : "true"); });
  finish(verb_, added, {option.help, group_, option.level});
}

void CommandLineOptions::index(const OptionInfo& option, const Index& field,
                               std::span<const char* const> names) {
  const std::vector<std::string> words(names.begin(), names.end());
  CLI::Option* added = verb_.add_option_function<std::string>(
      std::string("--") + option.name,
      [field, words](const std::string& word) {
        field.set(int(std::ranges::find(words, word) - words.begin()));
      },
      option.help);
  added->default_function([field, words] { return words[std::size_t(field.get())]; });
  added->check(one_of(words))->capture_default_str();
  finish(verb_, added, {option.help, group_, option.level});
}

OptionTable& OptionTable::level(OptionLevel level) {
  level_ = level;
  return *this;
}

template <typename T>
OptionTable& OptionTable::bounded(const std::string& name, T& field, T low, T high,
                                  const std::string& help) {
  add_number(verb_, name, field, {low, high}, {help, group_, level_});
  return *this;
}
template OptionTable& OptionTable::bounded(const std::string&, int&, int, int, const std::string&);
template OptionTable& OptionTable::bounded(const std::string&, unsigned&, unsigned, unsigned,
                                           const std::string&);
template OptionTable& OptionTable::bounded(const std::string&, float&, float, float,
                                           const std::string&);
template OptionTable& OptionTable::bounded(const std::string&, double&, double, double,
                                           const std::string&);

OptionTable& OptionTable::flag(const std::string& name, bool& field, const std::string& help) {
  add_flag(verb_, name, field, {help, group_, level_});
  return *this;
}

OptionTable& OptionTable::choice(const std::string& name, std::string& field,
                                 const std::vector<std::string>& words, const std::string& help) {
  finish(verb_,
         verb_.add_option("--" + name, field, help)->check(one_of(words))->capture_default_str(),
         {help, group_, level_});
  return *this;
}

std::vector<std::pair<std::string, std::string>> settings_of(CLI::App& verb,
                                                             const std::set<std::string>& groups) {
  std::vector<std::pair<std::string, std::string>> settings{{"verb", verb.get_name()}};
  const auto is_row = [&](const CLI::Option* option) {
    return groups.contains(option->get_group());
  };
  for (CLI::Option* option : verb.get_options(is_row)) {
    option->capture_default_str();  // the present value of the field
    settings.emplace_back(option->get_lnames().front(), option->get_default_str());
  }
  return settings;
}

}  // namespace edgescout
