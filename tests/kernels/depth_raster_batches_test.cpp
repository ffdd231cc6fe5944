// How many maps a batch draws: a driver may end what takes it too long
// (kernels/gpu/depth_raster.h).
#ifdef EDGESCOUT_VULKAN
#include "kernels/gpu/depth_raster.h"
#include "tests/kernels/gpu_fixture.h"

namespace edgescout {
namespace {

using DepthRasterBatches = test::GpuTest;

TEST_F(DepthRasterBatches, HaveFewerMapsTheMoreTrianglesThereAre) {
  const gpu::DepthRaster raster(*device);
  constexpr std::size_t many = std::size_t{1} << 20;
  EXPECT_EQ(raster.max_jobs(many, 1000, 65), 64u);
  EXPECT_EQ(raster.max_jobs(many, 1000, 66), 32u)
      << "every triangle is set up for two bands of rows";
  EXPECT_EQ(raster.max_jobs(100 * many, 1000, 66), 1u) << "one map is drawn, however long it takes";
}

TEST_F(DepthRasterBatches, HaveFewerMapsTheLargerTheyAre) {
  const gpu::DepthRaster raster(*device);
  EXPECT_EQ(raster.max_jobs(12, 1024, 64), 256u);  // 64 MiB
  EXPECT_EQ(raster.max_jobs(0, 4096, 4096), 1u);
  EXPECT_EQ(raster.max_jobs(0, 1, 1), 32768u);
}

}  // namespace
}  // namespace edgescout
#endif
