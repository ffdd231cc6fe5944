// Tests the text of the report of registrations.
#include "host/experiments/registration.h"

#include <gtest/gtest.h>

#include "host/experiments/photographs.h"
#include "host/experiments/trials.h"
#include "tests/io/collected_log.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

// One registration, which is right.
Table registration_in(const std::string& set) {
  return {{},
          trial_columns(),
          {{set, "s00", "part", "part_0", "7", "0.1", "1", "d2co", "1", "0.01", "1", "1", "1", "12",
            "0", "2"}}};
}

// Of the original implementation's six files the data folder has one.
TEST(RegistrationReport, NamesTheOriginalResultsThatAreMissing) {
  const TemporaryFolder data;
  data.write("d2co-starts/original_results/all_methods_l100.csv",
             "start_id,image,object_id,level,method,r00,r01,r02,r10,r11,r12,r20,r21,r22,tx,ty,tz,"
             "ok,cpu_ms\n"
             "7,s00,part_0,1,D2CO,1,0,0,0,1,0,0,0,1,0,0,500,1,60\n");
  ExperimentSettings settings;
  settings.data = data.path();
  const CollectedLog log;
  const std::string text =
      registration_experiment().report(settings, registration_in("d2co-starts")).markdown;
  EXPECT_NE(text.find("with lambda 100, on those of the starts that it ran on"), std::string::npos)
      << text;
  EXPECT_NE(text.find("| original D2CO | 100 %"), std::string::npos) << text;
  ASSERT_EQ(log.messages.size(), 5u);
  for (int i = 0;
       const char* file : {"all_methods_l6.csv", "all_methods_l100_canny.csv", "d2co_l6_full.csv",
                           "d2co_l100_full.csv", "d2co_l100_canny_full.csv"}) {
    const std::string name = std::string("d2co-starts/original_results/") + file;
    EXPECT_NE(text.find("*skipped*, the data folder has no " + name), std::string::npos) << text;
    EXPECT_EQ(log.messages[i].first, LogLevel::Warning);
    EXPECT_NE(log.messages[i].second.find((data.path() / name).string()), std::string::npos)
        << log.messages[i].second;
    ++i;
  }
}

// The report notes samples that are not independent.
TEST(RegistrationReport, NotesThatPhotographsOfOneSceneCountAsIndependent) {
  const auto text_of = [](const char* set) {
    return registration_experiment().report({}, registration_in(set)).markdown;
  };
  EXPECT_NE(text_of("cat").find(PHOTOGRAPHS_COUNT_APART), std::string::npos) << text_of("cat");
  EXPECT_EQ(text_of("rendered").find(PHOTOGRAPHS_COUNT_APART), std::string::npos);
}

}  // namespace
}  // namespace edgescout::test
