#include "host/cli/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>
#include <vector>

namespace edgescout {
namespace {

TEST(Progress, WritesALineAtEveryTenthWithoutATerminal) {
  std::ostringstream out;
  {
    Progress progress("build", 1000, out, false);
    for (int i = 0; i < 1000; ++i) progress.step();
  }
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_TRUE(text.starts_with("build: 100/1000"));
  EXPECT_NE(text.find("build: 1000/1000, took"), std::string::npos) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(Progress, WritesEveryStepOfAShortJob) {
  std::ostringstream out;
  Progress progress("image", 3, out, false);
  for (int i = 0; i < 3; ++i) progress.step();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
}

TEST(Progress, DrawsABarOverItselfOnATerminal) {
  std::ostringstream out;
  {
    Progress progress("build", 10, out, true);
    EXPECT_NE(out.str().find("[..............................] 0/10"), std::string::npos);
    progress.move_to(5);
    EXPECT_NE(out.str().find("[###############...............] 5/10"), std::string::npos)
        << out.str();
    progress.move_to(3);  // never backwards
    progress.step(100);   // nor beyond the end
  }
  const std::string text = out.str();
  EXPECT_NE(text.find("[##############################] 10/10, took"), std::string::npos) << text;
  EXPECT_EQ(text.find("3/10"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_EQ(text.back(), '\n');
}

// Of a million half were there before; a hundredth takes 50 ms or more, so that what is left takes
// 2 s at least.
TEST(Progress, EstimatesTheTimeLeftFromThisRun) {
  std::ostringstream out;
  {
    Progress progress("bins", 1000000, out, true, 500000);
    EXPECT_NE(out.str().find("500000/1000000"), std::string::npos) << out.str();
    EXPECT_EQ(out.str().find("left"), std::string::npos) << "nobody knows yet\n" << out.str();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    progress.move_to(510000);
  }
  EXPECT_NE(out.str().find(" s left"), std::string::npos) << out.str();
  EXPECT_EQ(out.str().find(", 0 s left"), std::string::npos) << out.str();
}

TEST(Progress, OfWhatWasDoneBeforeIsAtItsEnd) {
  std::ostringstream out;
  Progress progress("bins", 3, out, false, 3);
  progress.move_to(3);
  EXPECT_NE(out.str().find("bins: 3/3, took 0 s"), std::string::npos) << out.str();
}

TEST(Progress, CountsStepsOfSeveralThreads) {
  std::ostringstream out;
  Progress progress("p", 4000, out, false);
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 1000; ++i) progress.step();
    });
  threads.clear();
  EXPECT_NE(out.str().find("4000/4000"), std::string::npos);
}

TEST(Progress, OfNothingDoesNotDivideByZero) {
  std::ostringstream out;
  Progress progress("p", 0, out, false);
  progress.step();
  EXPECT_NE(out.str().find("1/1"), std::string::npos);
}

}  // namespace
}  // namespace edgescout
