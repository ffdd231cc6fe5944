// A stream of its own for every test, from the suite's seed and the test's name.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "host/core/random.h"

namespace edgescout::test {

inline Random test_random() {
  constexpr std::uint64_t suite_seed = 20170419;
  const ::testing::TestInfo& info = *::testing::UnitTest::GetInstance()->current_test_info();
  const std::string name = std::string(info.test_suite_name()) + "." + info.name();
  std::printf("seed %llu, stream %s\n", static_cast<unsigned long long>(suite_seed), name.c_str());
  return Random(suite_seed).split(name);
}

}  // namespace edgescout::test
