#include "host/track/reduced_image.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/test_random.h"

namespace edgescout::test {
namespace {

TEST(ReducedImage, HoldsTheMeansOfWholeSquares) {
  Random random = test_random();
  Image image{37, 23, {}};
  for (int i = 0; i < image.width * image.height; ++i)
    image.pixels.push_back(std::uint8_t(random.uniform(0, 256)));
  for (const int factor : {1, 2, 3, 5}) {
    const Image small = reduced(image, factor);
    ASSERT_EQ(small.width, image.width / factor);
    ASSERT_EQ(small.height, image.height / factor);
    for (int y = 0; y < small.height; ++y)
      for (int x = 0; x < small.width; ++x) {
        double sum = 0;
        for (int v = 0; v < factor; ++v)
          for (int u = 0; u < factor; ++u) sum += image.at(factor * x + u, factor * y + v);
        EXPECT_NEAR(small.at(x, y), sum / (factor * factor), 0.5 + 1e-9) << factor;
      }
  }
}

}  // namespace
}  // namespace edgescout::test
