#include "host/bindings/python/src/option_fields.h"

#include <fmt/format.h>

#include <algorithm>

namespace edgescout::python {

namespace {

std::string python_name(const OptionInfo& option) {
  std::string name = option.name;
  std::ranges::replace(name, '-', '_');
  if (name == "lambda") name += '_';  // a keyword of Python
  return name;
}

[[noreturn]] void refuse_type(const OptionInfo& option, const py::object& value,
                              const char* expected) {
  throw py::type_error(fmt::format("{}: found {}, expected {}", python_name(option),
                                   std::string(py::repr(value)), expected));
}

template <typename T>
T value_of(const OptionInfo& option, const py::object& value, const char* expected) {
  try {
    return py::cast<T>(value);
  } catch (const py::cast_error&) {
    refuse_type(option, value, expected);
  }
}

// A number that is set only if it lies within its bounds.
template <typename T>
OptionField number_field(const std::string& type, const OptionInfo& option, T& field, T low,
                         T high) {
  return {python_name(option), option.help, [&field] { return py::cast(field); },
          [&field, type, option, low, high](const py::object& value) {
            T given = value_of<T>(option, value, std::is_integral_v<T> ? "an integer" : "a number");
            BoundsCheck(type).number(option, given, low, high);
            field = given;
          }};
}

OptionField flag_field(const OptionInfo& option, bool& field) {
  return {python_name(option), option.help, [&field] { return py::cast(field); },
          [&field, option](const py::object& value) {
            if (!py::isinstance<py::bool_>(value)) refuse_type(option, value, "True or False");
            field = py::cast<bool>(value);
          }};
}

}  // namespace

void OptionFields::number(const OptionInfo& option, int& field, int low, int high) {
  fields.push_back(number_field(type_, option, field, low, high));
}
void OptionFields::number(const OptionInfo& option, float& field, float low, float high) {
  fields.push_back(number_field(type_, option, field, low, high));
}
void OptionFields::number(const OptionInfo& option, double& field, double low, double high) {
  fields.push_back(number_field(type_, option, field, low, high));
}

void OptionFields::range(const OptionInfo& option, Range& field, double low, double high) {
  fields.push_back({python_name(option), option.help,
                    [&field] { return py::make_tuple(field.low, field.high); },
                    [&field, type = type_, option, low, high](const py::object& value) {
                      const auto ends = value_of<std::pair<double, double>>(
                          option, value, "two numbers, the smaller one first");
                      Range given{ends.first, ends.second};
                      BoundsCheck(type).range(option, given, low, high);
                      field = given;
                    }});
}

void OptionFields::numbers(const OptionInfo& option, std::vector<double>& field, int count,
                           double low, double high) {
  fields.push_back({python_name(option), option.help, [&field] { return py::cast(field); },
                    [&field, type = type_, option, count, low, high](const py::object& value) {
                      auto given = value_of<std::vector<double>>(option, value, "numbers");
                      BoundsCheck(type).numbers(option, given, count, low, high);
                      field = std::move(given);
                    }});
}

void OptionFields::flag(const OptionInfo& option, bool& field) {
  fields.push_back(flag_field(option, field));
}

// In Python it is an ordinary flag of its own meaning: search_alone is not detect_jointly.
void OptionFields::off_flag(const OptionInfo& option, bool& field) {
  OptionField inverted = flag_field(option, field);
  inverted.get = [&field] { return py::cast(!field); };
  inverted.set = [&field, set = inverted.set](const py::object& value) {
    set(value);
    field = !field;
  };
  fields.push_back(std::move(inverted));
}

void OptionFields::index(const OptionInfo& option, const Index& field,
                         std::span<const char* const> names) {
  const std::vector<std::string> words(names.begin(), names.end());
  fields.push_back({python_name(option), option.help,
                    [field, words] { return py::cast(words[std::size_t(field.get())]); },
                    [field, words, option](const py::object& value) {
                      const auto word = value_of<std::string>(option, value, "a word");
                      const auto known = std::ranges::find(words, word);
                      if (known == words.end())
                        throw py::value_error(fmt::format("{}: found {}, expected one of {}",
                                                          python_name(option), word,
                                                          fmt::join(words, ", ")));
                      field.set(int(known - words.begin()));
                    }});
}

const OptionField& field_named(const std::vector<OptionField>& fields, const std::string& name) {
  const auto found = std::ranges::find(fields, name, &OptionField::name);
  if (found != fields.end()) return *found;
  std::vector<std::string> names;
  for (const OptionField& field : fields) names.push_back(field.name);
  const auto near = py::cast<std::vector<std::string>>(
      py::module_::import("difflib").attr("get_close_matches")(name, names));
  throw py::attribute_error(fmt::format("no option {}{}{}", name, near.empty() ? "" : "; there is ",
                                        fmt::join(near, ", ")));
}

bool have_equal_values(const std::vector<OptionField>& a, const std::vector<OptionField>& b) {
  return std::ranges::equal(a, b, [](const OptionField& of_a, const OptionField& of_b) {
    return of_a.get().equal(of_b.get());
  });
}

py::dict help_of(const std::vector<OptionField>& fields) {
  py::dict help;
  for (const OptionField& field : fields) help[py::str(field.name)] = field.help;
  return help;
}

std::string repr_of(const std::string& type, const std::vector<OptionField>& fields) {
  std::vector<std::string> values;
  for (const OptionField& field : fields)
    values.push_back(field.name + "=" + std::string(py::repr(field.get())));
  return fmt::format("{}({})", type, fmt::join(values, ", "));
}

}  // namespace edgescout::python
