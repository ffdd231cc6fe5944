#include "host/core/option_text.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <optional>
#include <type_traits>

#include "host/core/words.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// The shortest text that reads back as the same number.
template <typename T>
std::string text_of(T number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

std::string text_of(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) {
    if (!text.empty()) text += ' ';
    text += text_of(number);
  }
  return text;
}

// The whole text is one number.
template <typename T>
std::optional<T> number_of(const std::string& text) {
  T number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end) return {};
  return number;
}

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

std::vector<double> numbers_of(const OptionInfo& option, const std::string& text,
                               const std::string& expected, const BoundsCheck& check) {
  std::vector<double> numbers;
  for (const std::string& word : words_of(text, " ,\t")) {
    const std::optional<double> number = number_of<double>(word);
    if (!number) check.fail(option.name, quoted(text), expected);
    numbers.push_back(*number);
  }
  return numbers;
}

bool flag_of(const OptionInfo& option, const std::string& text, const BoundsCheck& check) {
  if (text != "true" && text != "false") check.fail(option.name, quoted(text), "true or false");
  return text == "true";
}

// The least number of letters that are put in, left out or replaced.
int edits_between(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0]++;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const int replaced = diagonal + (a[i] == b[k] ? 0 : 1);
      diagonal = row[k + 1];
      row[k + 1] = std::min({replaced, row[k] + 1, row[k + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

OptionText& OptionTexts::add(const OptionInfo& option, OptionType type, double low, double high) {
  return options.emplace_back(
      OptionText{option.name, option.help, group_, option.level, type, low, high, 0, {}, {}, {}});
}

template <typename T>
void OptionTexts::add_number(const OptionInfo& option, OptionType type, T& field, T low, T high) {
  OptionText& added = add(option, type, low, high);
  added.get = [&field] { return text_of(field); };
  added.set = [&field, option, low, high, check = BoundsCheck(prefix_)](const std::string& text) {
    std::optional<T> number = number_of<T>(text);
    if (!number)
      check.fail(option.name, quoted(text), std::is_integral_v<T> ? "an integer" : "a number");
    BoundsCheck(check).number(option, *number, low, high);
    field = *number;
  };
}

void OptionTexts::number(const OptionInfo& option, int& field, int low, int high) {
  add_number(option, OptionType::Integer, field, low, high);
}
void OptionTexts::number(const OptionInfo& option, float& field, float low, float high) {
  add_number(option, OptionType::Number, field, low, high);
}
void OptionTexts::number(const OptionInfo& option, double& field, double low, double high) {
  add_number(option, OptionType::Number, field, low, high);
}

void OptionTexts::range(const OptionInfo& option, Range& field, double low, double high) {
  OptionText& added = add(option, OptionType::Range, low, high);
  added.get = [&field] { return text_of(field.low) + " " + text_of(field.high); };
  added.set = [&field, option, low, high, check = BoundsCheck(prefix_)](const std::string& text) {
    const char* const expected = "one number or two, the smaller one first";
    const std::vector<double> ends = numbers_of(option, text, expected, check);
    if (ends.empty() || ends.size() > 2) check.fail(option.name, quoted(text), expected);
    Range given{ends.front(), ends.back()};
    BoundsCheck(check).range(option, given, low, high);
    field = given;
  };
}

void OptionTexts::numbers(const OptionInfo& option, std::vector<double>& field, int count,
                          double low, double high) {
  OptionText& added = add(option, OptionType::Numbers, low, high);
  added.count = count;
  added.get = [&field] { return text_of(field); };
  added.set = [&field, option, count, low, high,
               check = BoundsCheck(prefix_)](const std::string& text) {
    std::vector<double> given =
        numbers_of(option, text, std::to_string(count) + " numbers or none", check);
    BoundsCheck(check).numbers(option, given, count, low, high);
    field = std::move(given);
  };
}

void OptionTexts::add_flag(const OptionInfo& option, bool& field, bool when_true) {
  OptionText& added = add(option, OptionType::Flag);
  added.get = [&field, when_true] { return std::string(field == when_true ? "true" : "false"); };
  added.set = [&field, option, when_true, check = BoundsCheck(prefix_)](const std::string& text) {
    field = flag_of(option, text, check) == when_true;
  };
}

void OptionTexts::flag(const OptionInfo& option, bool& field) { add_flag(option, field, true); }
void OptionTexts::off_flag(const OptionInfo& option, bool& field) {
  add_flag(option, field, false);
}

void OptionTexts::index(const OptionInfo& option, const Index& field,
                        std::span<const char* const> names) {
  OptionText& added = add(option, OptionType::Choice);
  added.words.assign(names.begin(), names.end());
  added.get = [field, words = added.words] { return words[std::size_t(field.get())]; };
  added.set = [field, option, words = added.words,
               check = BoundsCheck(prefix_)](const std::string& text) {
    const auto known = std::ranges::find(words, text);
    if (known == words.end()) {
      std::string expected = "one of ";
      for (const std::string& word : words)
        expected += (&word == &words.front() ? "" : ", ") + word;
      check.fail(option.name, quoted(text), expected);
    }
    field.set(int(known - words.begin()));
  };
}

OptionText& option_named(std::vector<OptionText>& options, const std::string& name,
                         const std::string& prefix) {
  std::string dashed = name;
  std::ranges::replace(dashed, '_', '-');
  const auto known = std::ranges::find(options, dashed, &OptionText::name);
  if (known != options.end()) return *known;
  const auto edits = [&](const OptionText& option) { return edits_between(dashed, option.name); };
  const auto nearest = std::ranges::min_element(options, {}, edits);
  const bool is_near = nearest != options.end() &&
                       3 * edits(*nearest) <= int(std::max<std::size_t>(dashed.size(), 3));
  throw InputError("options", prefix, "no option of the name " + quoted(name),
                   is_near ? nearest->name : "one of its " + std::to_string(options.size()));
}

}  // namespace edgescout
