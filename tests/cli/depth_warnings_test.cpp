// When the offsets of poses that depth moved warn of the sensor.
#include "host/cli/depth_warnings.h"

#include <gtest/gtest.h>

namespace edgescout::test {
namespace {

// Offsets in mm about a bias.
std::string warning_of(double bias_mm, std::initializer_list<double> errors_mm) {
  std::vector<DepthOffset> offsets;
  for (const double error_mm : errors_mm) offsets.push_back({1e-3 * (bias_mm + error_mm), 1e-3});
  return bias_warning(offsets);
}

TEST(DepthWarnings, ABiasIsNamedWithItsSide) {
  EXPECT_EQ(warning_of(2, {-0.2, -0.1, 0, 0.1, 0.2}),
            "depth moves poses 2.00 +- 0.08 mm farther from the camera than their edges alone, in "
            "the median of 5: is the sensor biased?");
  EXPECT_NE(warning_of(-2, {-0.2, -0.1, 0, 0.1, 0.2}).find("2.00 +- 0.08 mm nearer to"),
            std::string::npos);
}

TEST(DepthWarnings, WhatFewPosesOrTheirErrorsExplainIsNone) {
  EXPECT_EQ(warning_of(2, {-0.2, -0.1, 0.1, 0.2}), "");  // four poses
  EXPECT_EQ(warning_of(0, {-0.2, -0.1, 0, 0.1, 0.2}), "");
  EXPECT_EQ(warning_of(0.1, {-0.2, -0.1, 0, 0.1, 0.2}), "");  // 1.2 standard errors
  EXPECT_EQ(warning_of(0, {}), "");
  // Many standard errors, and less than the poses' spread.
  const std::initializer_list<double> many = {-2, -2, -2, -1, -1, -1, -1, -1, 0, 0, 0, 0, 0,
                                              0,  0,  1,  1,  1,  1,  1,  2,  2, 2, 0, 0};
  EXPECT_EQ(warning_of(1.3, many), "");
  EXPECT_NE(warning_of(1.6, many), "");
}

// Poses of another object are far off: they move neither the median nor its error much.
TEST(DepthWarnings, AFewOutliersDoNotHideABias) {
  EXPECT_NE(warning_of(2, {-0.2, -0.1, 0, 0.1, 0.2, -40, 30}), "");
  EXPECT_EQ(warning_of(0, {-0.2, -0.1, 0, 0.1, 0.2, 40, 30}), "");
}

}  // namespace
}  // namespace edgescout::test
