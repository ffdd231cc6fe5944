// An InputError whose one line holds every one of the given words.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <initializer_list>
#include <string>

#include "kernels/error.h"

namespace edgescout::test {

inline void expect_input_error(const std::function<void()>& action,
                               std::initializer_list<std::string> words) {
  try {
    action();
  } catch (const InputError& error) {
    const std::string message = error.what();
    for (const std::string& word : words)
      EXPECT_NE(message.find(word), std::string::npos) << "no \"" << word << "\" in: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return;
  }
  ADD_FAILURE() << "no InputError";
}

}  // namespace edgescout::test
