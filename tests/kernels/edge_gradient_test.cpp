// edge_gradient alone: exact integers (kernels/edge_stages.h).
#ifdef EDGESCOUT_VULKAN
#include "kernels/gpu/edge_detect.h"

#include "kernels/edge_stages.h"
#include "tests/kernels/gpu_fixture.h"
#include "tests/kernels/pictures.h"

namespace edgescout {
namespace {

class EdgeGradientTest : public test::GpuTest {};

TEST_F(EdgeGradientTest, EqualsTheReference) {
  std::mt19937 rng = test::test_rng();
  gpu::EdgeDetect detect(*device);
  for (const test::Picture& picture : test::random_pictures(rng))
    for (const float sigma : {0.3f, 1.0f, 8.0f}) {
      SCOPED_TRACE(picture.size() + ", sigma " + std::to_string(sigma));
      EdgeOptions options;
      options.sigma_px = sigma;
      gpu::Batch batch(*device, "edges");
      detect.record_pixels(batch, picture.view(), options);
      batch.run();
      EXPECT_EQ(read<std::int16_t>(detect.gradient(), 2 * picture.pixels.size()),
                edge_gradient_reference(picture.view(), edge_weights(sigma)));
    }
}

}  // namespace
}  // namespace edgescout
#endif
