#include "host/io/depth_png.h"

#include <gtest/gtest.h>

#include "host/io/depth_file.h"
#include "kernels/error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

TEST(DepthPng, ReadsBackToHalfAUnit) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "depth.png";
  DepthImage depth{20, 16, std::vector<float>(320, 0.5f)};
  depth.z_m[0] = DEPTH_MISSING;
  depth.z_m[1] = 6.5535f;
  depth.z_m[2] = 6.6f;  // too far for 16 bit
  depth.z_m[3] = 0.50004f;
  depth.z_m[21] = 0.7f;
  write_depth_png(depth, 1e-4, file);
  const DepthImage back = load_depth(file, {}, 1e-4);
  ASSERT_EQ(back.width, 20);
  ASSERT_EQ(back.height, 16);
  EXPECT_EQ(back.z_m[0], DEPTH_MISSING);
  EXPECT_EQ(back.z_m[2], DEPTH_MISSING);
  for (const int i : {1, 3, 4, 21}) EXPECT_NEAR(back.z_m[i], depth.z_m[i], 0.500001e-4) << i;
}

TEST(DepthPng, NamesTheFileThatItCannotWrite) {
  const DepthImage depth{2, 1, {1, 1}};
  try {
    write_depth_png(depth, 1e-3, "/proc/depth.png");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/proc/depth.png"), std::string::npos);
  }
  EXPECT_THROW(write_depth_png({2, 2, {1, 1}}, 1e-3, "/proc/depth.png"), LogicError);
}

}  // namespace
}  // namespace edgescout::test
