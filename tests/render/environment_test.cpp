#include "host/render/environment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/core/random.h"
#include "host/render/room.h"
#include "tests/render/lights.h"

namespace edgescout::test {
namespace {

// Irradiance of a horizontal surface, by random directions.
double irradiance_of(const Environment& environment) {
  Random random(1);
  double sum = 0;
  constexpr int SAMPLES = 20000;
  for (int i = 0; i < SAMPLES; ++i) {
    Eigen::Vector3d direction = random.direction();
    direction.z() = std::abs(direction.z());
    sum += 2 * direction.z() * environment.light(direction, 1e-6);  // pdf 1 / (2 pi), over pi
  }
  return sum / SAMPLES;
}

TEST(Environment, HasTheIrradianceThatIsAskedFor) {
  const Environment environment(bright_east(), 0.7, {});
  EXPECT_NEAR(environment.irradiance(), 0.7, 1e-6);
  EXPECT_NEAR(irradiance_of(environment), 0.7, 0.01);
  EXPECT_NEAR(environment.light({0.6, 0, 0.8}, 1e-6) / environment.light({-0.6, 0, 0.8}, 1e-6), 3,
              1e-3);
}

TEST(Environment, ALampAddsItsIrradianceInItsDirection) {
  for (const double half_angle : {0.001, 0.05, 0.2}) {
    const Eigen::Vector3d direction = Eigen::Vector3d(0.3, -0.2, 0.9).normalized();
    const FarLamp lamp{direction, half_angle, 0.5};
    const Environment environment(bright_east(), 0.2, std::vector{lamp});
    EXPECT_NEAR(environment.irradiance(), 0.2 + 0.5 * direction.z(), 0.01) << half_angle;
    EXPECT_GT(environment.light(direction, 1e-6), 5) << half_angle;
    EXPECT_LT(environment.light({-0.6, 0, 0.8}, 1e-6), 1) << half_angle;
  }
}

TEST(Environment, AWideConeSeesTheMean) {
  const Environment environment(bright_east(), 2, {});
  const double narrow = environment.light({0.05, 0, 1}, 1e-5),
               wide = environment.light({0.05, 0, 1}, 2);
  EXPECT_NEAR(narrow, 3, 0.05);
  EXPECT_NEAR(wide, 2, 0.3);
}

TEST(Environment, BelowTheHorizonIsTheHorizon) {
  const Environment environment(bright_east(), 2, {});
  EXPECT_NEAR(environment.light(Eigen::Vector3d(1, 0, -0.5).normalized(), 1e-5), 3, 0.05);
}

// A photograph with one bright corner has its light there.
TEST(PhotographOverhead, ShowsEachPartOfThePhotograph) {
  Image photograph{32, 32, std::vector<std::uint8_t>(32 * 32, 50)};
  for (int y = 20; y < 32; ++y)
    for (int x = 20; x < 32; ++x) photograph.pixels[static_cast<std::size_t>(y) * 32 + x] = 250;
  const FarLight light = photograph_overhead(photograph);
  EXPECT_GT(light(Eigen::Vector3d(1, 1, 0.7).normalized()),
            10 * light(Eigen::Vector3d(-1, 1, 0.7).normalized()));
}

TEST(RandomRoom, HasBrightAndDarkPlacesAndDependsOnTheSeed) {
  int differing = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const FarLight room = random_room(Random(seed)), again = random_room(Random(seed)),
                   other = random_room(Random(seed + 100));
    double low = 1e9, high = 0;
    Random random(3);
    for (int i = 0; i < 3000; ++i) {
      Eigen::Vector3d direction = random.direction();
      direction.z() = std::abs(direction.z());
      const double light = room(direction);
      EXPECT_EQ(light, again(direction));
      differing += light != other(direction);
      low = std::min(low, light);
      high = std::max(high, light);
    }
    EXPECT_GT(low, 0);
    EXPECT_GT(high, 1.3 * low) << seed;
  }
  EXPECT_GT(differing, 10000);
}

}  // namespace
}  // namespace edgescout::test
