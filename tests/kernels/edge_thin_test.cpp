// edge_thin alone: the reference's candidates, pixel by pixel (kernels/edge_stages.h).
#ifdef EDGESCOUT_VULKAN
#include "kernels/edge_thin.h"

#include "kernels/edge_stages.h"
#include "kernels/gpu/edge_detect.h"
#include "tests/kernels/gpu_fixture.h"
#include "tests/kernels/pictures.h"

namespace edgescout {
namespace {

class EdgeThinTest : public test::GpuTest {};

TEST_F(EdgeThinTest, MarksTheCandidatesOfTheReference) {
  std::mt19937 rng = test::test_rng();
  gpu::EdgeDetect detect(*device);
  std::size_t candidates = 0;
  for (const test::Picture& picture : test::random_pictures(rng))
    for (const float low : {0.1f, 2.0f, 60.0f}) {
      SCOPED_TRACE(picture.size() + ", low " + std::to_string(low));
      EdgeOptions options;
      options.low_threshold = low;
      options.high_threshold = 127;
      gpu::Batch batch(*device, "edges");
      detect.record_pixels(batch, picture.view(), options);
      batch.run();
      const auto gradient = edge_gradient_reference(picture.view(), edge_weights(options.sigma_px));
      const auto expected =
          edge_thin_reference(gradient, picture.width, picture.height, edge_threshold(low));
      const auto labels = read<std::uint32_t>(detect.labels(), expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_EQ(labels[i] != EDGE_NO_LABEL, expected[i] != 0) << "pixel " << i;
        candidates += expected[i];
      }
    }
  EXPECT_GT(candidates, 1000u);
}

}  // namespace
}  // namespace edgescout
#endif
