#include "host/detect/searched_sizes.h"

#include <gtest/gtest.h>

#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

constexpr double DIAMETER_M = 0.1;

Camera pinhole() { return {640, 480, 500, 700, 319.5, 239.5, {}}; }

TemplateOptions between(double min_m, double max_m) {
  TemplateOptions options;
  options.distance_min_m = min_m, options.distance_max_m = max_m;
  return options;
}

TEST(SearchedSizes, AreThoseAtTheEndsOfTheRange) {
  const SearchedSizes sizes = searched_sizes(DIAMETER_M, between(0.5, 1), pinhole());
  EXPECT_NEAR(sizes.largest_px, 120, 1e-9);  // mean focal length 600
  EXPECT_NEAR(sizes.smallest_px, 60, 1e-9);
}

TEST(SizeWarning, IsOfObjectsMuchSmallerOrLargerThanTheImage) {
  const auto warning = [](double min_m, double max_m) {
    return size_warning("part", DIAMETER_M, between(min_m, max_m), pinhole());
  };
  EXPECT_EQ(warning(0.5, 1), "");
  EXPECT_EQ(warning(2.4, 4), "") << "25 px at the nearest";
  EXPECT_EQ(warning(0.5, 7.4), "");
  EXPECT_NE(warning(0.5, 800), "") << "0.8 m in millimetres";
  const std::string far = warning(2.6, 4);
  EXPECT_NE(far.find("spans 15.0 to 23.1 px at 2.600 to 4.000 m, expected 24 to 640 px"),
            std::string::npos)
      << far;
  EXPECT_NE(far.find("(unit)"), std::string::npos) << far;
  EXPECT_EQ(warning(0.05, 0.1), "");
  EXPECT_NE(warning(0.05, 0.09), "") << "667 px at the farthest";
}

TEST(RequireSearchableSize, RefusesWhatHasNoShapeOrHoldsTheCamera) {
  const auto refused = [](double min_m, double max_m) {
    expect_input_error(
        [&] { require_searchable_size("part", DIAMETER_M, between(min_m, max_m), pinhole()); },
        {"part", "size", "diameter of 100.0 mm", "(unit)", "distance_min"});
  };
  EXPECT_NO_THROW(require_searchable_size("part", DIAMETER_M, between(7.4, 8), pinhole()));
  refused(7.6, 8);  // 7.9 px
  EXPECT_NO_THROW(require_searchable_size("part", DIAMETER_M, between(0.01, 0.051), pinhole()));
  refused(0.01, 0.049);
}

}  // namespace
}  // namespace edgescout::test
