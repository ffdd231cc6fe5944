// The arguments of the smaller benches.
#pragma once

#include <charconv>
#include <string>

#include "kernels/error.h"

namespace edgescout::bench {

struct Arguments {
  std::string device = "cpu";
  int repetitions = 1;
  bool flag = false;  // whether the one more word that there may be was given
};

// InputError on anything else than --device WORD, --repetitions N and `flag`, where there is one.
inline Arguments parse_arguments(int argc, char** argv, Arguments arguments, const char* flag = nullptr) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (flag && word == flag) {
      arguments.flag = true;
      continue;
    }
    if (word != "--device" && word != "--repetitions")
      throw InputError(
          "command line", "argument", word,
          std::string("--device WORD, --repetitions N") + (flag ? " or " : "") + (flag ? flag : ""));
    if (++i == argc) throw InputError("command line", word, "nothing", "a value");
    const std::string value = argv[i];
    if (word == "--device") {
      arguments.device = value;
      continue;
    }
    const auto [end, error] =
        std::from_chars(value.data(), value.data() + value.size(), arguments.repetitions);
    if (error != std::errc() || *end != '\0' || arguments.repetitions < 1)
      throw InputError("command line", word, value, "a number from 1");
  }
  return arguments;
}

}  // namespace edgescout::bench
