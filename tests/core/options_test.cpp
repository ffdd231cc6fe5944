// Bounds of options: inclusive, and an error that names the field and both bounds.
#include "host/core/options.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "kernels/error.h"

namespace edgescout {
namespace {

enum class Colour { Red, Green };

struct Options {
  int count = 3;
  double angle_rad = 0.5;
  float scale_px = 1;
  Colour colour = Colour::Red;
  Range width_px{1, 2};
  std::vector<double> corner_m{};
};

void describe(Options& o, OptionVisitor& visit) {
  static constexpr std::array names{"red", "green"};
  visit.number({"max-count", "Count."}, o.count, 1, 5);
  visit.number({"angle", "Angle, rad."}, o.angle_rad, 0.0, 1.0);
  visit.number({"scale", "Scale, px."}, o.scale_px, 0.5f, 2.0f);
  visit.choice({"colour", "Colour."}, o.colour, names);
  visit.range({"width", "Width, px."}, o.width_px, 0.5, 4.0);
  visit.numbers({"corner", "Corner, m."}, o.corner_m, 3, -1.0, 1.0);
}

std::string message_of(const Options& options) {
  try {
    check_bounds(options, "group");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CheckBounds, TakesBothBounds) {
  EXPECT_EQ(message_of({}), "");
  EXPECT_EQ(message_of({1, 0, 0.5f, Colour::Red}), "");
  EXPECT_EQ(message_of({5, 1, 2, Colour::Green}), "");
}

TEST(CheckBounds, NamesTheFieldTheValueAndTheBounds) {
  const std::string message = message_of({6, 0.5, 1, Colour::Red});
  for (const char* part : {"group.max_count", "6.0", "1.0", "to 5.0"})
    EXPECT_NE(message.find(part), std::string::npos) << part << " not in " << message;
}

TEST(CheckBounds, SaysTheUnitAndWhatMillimetresWouldBe) {
  Options options;
  options.corner_m = {0, 0, 350};
  EXPECT_EQ(message_of(options),
            "options: group.corner: found 350.000000, expected -1.000000 to 1.000000 m: 350 mm are "
            "0.35");
  EXPECT_EQ(unit_after_bounds("Corner, m: x y z", 5e6, -1, 1), " m");
  EXPECT_EQ(unit_after_bounds("Corner, m", 5, -1, 1), " m: 5 mm are 0.005");
  EXPECT_EQ(unit_after_bounds("Width, mm, or millimetres", 5, -1, 1), "");
  EXPECT_EQ(message_of({3, 2, 1, Colour::Red}).find(" m"), std::string::npos);
}

TEST(CheckBounds, RefusesEachKindOfFieldAndNaN) {
  EXPECT_NE(message_of({0, 0.5, 1, Colour::Red}).find("max_count"), std::string::npos);
  EXPECT_NE(message_of({3, NAN, 1, Colour::Red}).find("angle"), std::string::npos);
  EXPECT_NE(message_of({3, 0.5, 2.1f, Colour::Red}).find("scale"), std::string::npos);
  EXPECT_NE(message_of({3, 0.5, 1, Colour(2)}).find("colour"), std::string::npos);
}

TEST(CheckBounds, RefusesRangesOutOfBoundsOrWithTheirEndsExchanged) {
  const auto message_of_range = [](double low, double high) {
    Options options;
    options.width_px = {low, high};
    return message_of(options);
  };
  for (const auto& [low, high] : {std::pair{0.5, 4.0}, {3.0, 3.0}})
    EXPECT_EQ(message_of_range(low, high), "");
  for (const auto& [low, high] :
       {std::pair{0.4, 2.0}, {1.0, 4.1}, {3.0, 2.0}, {1.0, double(NAN)}, {double(NAN), 1.0}})
    EXPECT_NE(message_of_range(low, high).find("group.width"), std::string::npos)
        << low << " " << high;
}

TEST(CheckBounds, TakesAllNumbersWithinBoundsOrNone) {
  const auto message_of_corner = [](const std::vector<double>& corner_m) {
    Options options;
    options.corner_m = corner_m;
    return message_of(options);
  };
  EXPECT_EQ(message_of_corner({}), "");
  EXPECT_EQ(message_of_corner({-1, 0, 1}), "");
  EXPECT_EQ(message_of_corner({0, 0}), "options: group.corner: found 2 numbers, expected 3");
  for (const double outside : {1.1, -1.1, double(NAN)})
    EXPECT_NE(message_of_corner({0, 0, outside}).find("group.corner"), std::string::npos)
        << outside;
}

}  // namespace
}  // namespace edgescout
