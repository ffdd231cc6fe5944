// The command lines of the benches, which build without a library for that.
#pragma once

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <variant>

#include "kernels/error.h"

namespace edgescout::bench {

// A word on the command line and what it sets: a text, a count (from 1), a number, or that the word
// was given. One whose name does not begin with "--" is a text, the one word that may stand by
// itself.
struct Argument {
  std::string name;
  std::variant<std::string*, int*, double*, bool*> target;
  bool is_option() const { return name.starts_with("--"); }
  bool takes(const std::string& word) const {
    if (is_option()) return word == name;
    return !word.starts_with("--") && std::get<std::string*>(target)->empty();
  }
};

template <class Number>
void read_number(const Argument& argument, const std::string& text, Number& number,
                 const char* expected) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    throw InputError("command line", argument.name, text, expected);
}

inline void set_value(const Argument& argument, const std::string& text) {
  if (const auto word = std::get_if<std::string*>(&argument.target)) **word = text;
  if (const auto number = std::get_if<double*>(&argument.target))
    read_number(argument, text, **number, "a number");
  if (const auto count = std::get_if<int*>(&argument.target)) {
    read_number(argument, text, **count, "a number from 1");
    if (**count < 1) throw InputError("command line", argument.name, text, "a number from 1");
  }
}

inline const Argument& argument_of(const std::string& word, std::initializer_list<Argument> known) {
  std::string list;
  for (const Argument& argument : known) {
    if (argument.takes(word)) return argument;
    list += (list.empty() ? "" : ", ") + argument.name;
  }
  throw InputError("command line", "argument", word, "one of " + list);
}

inline void print_usage(const char* program, std::initializer_list<Argument> known) {
  std::printf("usage: %s", program);
  for (const Argument& argument : known) {
    const bool is_number = std::holds_alternative<int*>(argument.target) ||
                           std::holds_alternative<double*>(argument.target);
    const bool is_text = std::holds_alternative<std::string*>(argument.target);
    const char* value = is_number ? " NUMBER" : is_text && argument.is_option() ? " TEXT" : "";
    std::printf(" [%s%s]", argument.name.c_str(), value);
  }
  std::printf("\n");
}

// InputError on a word that is none of `known`, and on one without its value. `--help` prints the
// words and ends the program.
inline void read_arguments(int argc, char** argv, std::initializer_list<Argument> known) {
  for (int i = 1; i < argc; ++i) {
    if (argv[i] == std::string("--help")) {
      print_usage(argv[0], known);
      std::exit(0);
    }
    const Argument& argument = argument_of(argv[i], known);
    if (const auto given = std::get_if<bool*>(&argument.target)) {
      **given = true;
      continue;
    }
    if (argument.is_option() && ++i == argc)
      throw InputError("command line", argument.name, "nothing", "a value");
    set_value(argument, argv[i]);
  }
}

}  // namespace edgescout::bench
