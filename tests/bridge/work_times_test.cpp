#include "host/bridge/ros2/work_times.h"

#include <gtest/gtest.h>

namespace edgescout::ros2::test {

namespace {

WorkTimes::Time after_s(double seconds) {
  return WorkTimes::Time(std::chrono::duration_cast<WorkTimes::Time::duration>(
      std::chrono::duration<double>(1000 + seconds)));
}

void expect_state(const WorkTimes& times, double seconds, bool is_stale, const std::string& text) {
  const WorkTimes::State state = times.state(after_s(seconds));
  EXPECT_EQ(state.is_stale, is_stale) << seconds;
  EXPECT_EQ(state.text, text) << seconds;
}

TEST(WorkTimes, WithoutAnImageTheNodeIsStale) {
  const WorkTimes times(false, after_s(0));
  expect_state(times, 10, false, "no result yet: no image came for 10 s");
  expect_state(times, 10.1, true, "no result yet: no image came for 10 s");
}

TEST(WorkTimes, TheFirstImageMayTakeLong) {
  WorkTimes times(false, after_s(0));
  times.image_comes(after_s(30));
  times.work_begins("image", after_s(30));
  expect_state(times, 100, false, "no result yet: first image is being worked on (70 s)");
  times.work_ends(true, after_s(101));
  expect_state(times, 102, false, "ok");
}

// As where tf does not know the frame: what is wrong is said elsewhere.
TEST(WorkTimes, WorkWithoutAResultIsNone) {
  WorkTimes times(false, after_s(0));
  times.image_comes(after_s(1));
  times.work_begins("image", after_s(1));
  times.work_ends(false, after_s(2));
  expect_state(times, 4, false, "no result yet: no image came for 3 s");
}

TEST(WorkTimes, OldResultsAreStale) {
  WorkTimes times(false, after_s(0));
  const auto give = [&](double begin, double end) {
    times.image_comes(after_s(begin));
    times.work_begins("image", after_s(begin));
    times.work_ends(true, after_s(end));
  };
  give(0, 1);
  expect_state(times, 11, false, "ok");
  expect_state(times, 12, true, "last result is 11 s old: no image came for 12 s");
  times.image_comes(after_s(12));
  times.work_begins("image", after_s(12));
  expect_state(times, 14, true, "last result is 13 s old: an image is being worked on (2 s)");
  times.work_ends(true, after_s(22));
  expect_state(times, 51, false, "ok");  // the last one took 10 s
  expect_state(times, 53, true, "last result is 31 s old: no image came for 41 s");
}

TEST(WorkTimes, OnRequestNothingIsStale) {
  WorkTimes times(true, after_s(0));
  expect_state(times, 100, false, "no result yet: no request came");
  times.work_begins("request", after_s(100));
  expect_state(times, 103, false, "no result yet: first request is being worked on (3 s)");
  times.work_ends(true, after_s(104));
  expect_state(times, 1000, false, "ok");
}

}  // namespace

}  // namespace edgescout::ros2::test
