// dcd_sweep alone, on values no distance transform would give (kernels/dcd_sweep.h).
#ifdef EDGESCOUT_VULKAN
#include "kernels/dcd_sweep.h"

#include "kernels/dcd_tensor.h"
#include "kernels/gpu/dcd_sweep.h"
#include "tests/kernels/gpu_fixture.h"

namespace edgescout {
namespace {

// Eqs. 5 and 6 by asking every bin for every other, then the circular Gaussian.
std::vector<std::uint16_t> brute_force(const std::vector<std::uint16_t>& values,
                                       const TensorShape& shape, const TensorOptions& options) {
  const std::vector<std::uint16_t> weights =
      smoothing_weights(options.smoothing_variance, shape.bins);
  const std::uint32_t step = orientation_step(options);
  const int bins = shape.bins, radius = static_cast<int>(weights.size()) - 1;
  std::vector<std::uint16_t> result = values;
  std::vector<std::uint32_t> lowest(bins);
  for (int y = 0; y < shape.height; ++y)
    for (int x = 0; x < shape.tiles_per_row() * int(DCD_TILE); ++x) {
      for (int k = 0; k < bins; ++k) {
        lowest[k] = ~0u;
        for (int j = 0; j < bins; ++j) {
          const auto turns =
              static_cast<std::uint32_t>(std::min(std::abs(k - j), bins - std::abs(k - j)));
          lowest[k] = std::min(lowest[k], values[shape.index(x, y, j)] + step * turns);
        }
      }
      for (int k = 0; k < bins; ++k) {
        std::uint32_t sum = 1u << 14;
        for (int d = -radius; d <= radius; ++d)
          sum += weights[std::abs(d)] * lowest[(k + d + bins) % bins];
        result[shape.index(x, y, k)] = static_cast<std::uint16_t>(sum >> 15);
      }
    }
  return result;
}

struct Case {
  TensorShape shape;
  float lambda, variance;
  std::uint32_t cap;
};

class DcdSweepTest : public test::GpuTest {};

TEST_F(DcdSweepTest, MeetsBruteForce) {
  std::mt19937 rng = test::test_rng();
  gpu::DcdSweep sweep(*device);
  for (const Case& c : std::vector<Case>{{{1, 1, 4}, 100, 1, 15360},
                                         {{7, 5, 60}, 100, 1, 15360},
                                         {{33, 17, 60}, 1, 1, 65280},
                                         {{33, 3, 60}, 0, 1, 65280},
                                         {{33, 3, 60}, 10000, 0, 15360},
                                         {{65, 9, 128}, 7, 16, 2000},
                                         {{40, 11, 4}, 3, 16, 65280},
                                         {{40, 11, 6}, 30, 0.25f, 1}}) {
    SCOPED_TRACE(std::to_string(c.shape.bins) + " bins, lambda " + std::to_string(c.lambda) +
                 ", variance " + std::to_string(c.variance));
    TensorOptions options;
    options.bins = c.shape.bins;
    options.lambda_px_per_rad = c.lambda;
    options.smoothing_variance = c.variance;
    std::vector<std::uint16_t> values(c.shape.size());
    // Mostly at the cap, as in a tensor.
    for (std::uint16_t& v : values)
      v = static_cast<std::uint16_t>(rng() % 4 ? c.cap : rng() % (c.cap + 1));
    const gpu::DeviceTensor tensor(*device, c.shape);
    gpu::Batch batch(*device, "sweep");
    batch.upload<std::uint16_t>(tensor.buffer(), values);
    sweep.record(batch, options, c.cap, tensor);
    batch.run();
    EXPECT_EQ(read<std::uint16_t>(tensor.buffer(), values.size()),
              brute_force(values, c.shape, options));
  }
}

}  // namespace
}  // namespace edgescout
#endif
