// Plain scenes keep their bytes: images, poses and cameras that experiments were run on.
#include <gtest/gtest.h>

#include "host/render/parts.h"
#include "host/render/write_bop.h"
#include "kernels/thread_pool.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

// FNV-1a, 64 bit.
template <typename Bytes>
std::uint64_t checksum(const Bytes& bytes, std::uint64_t start = 0xcbf29ce484222325u) {
  for (const auto byte : bytes) start = (start ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
  return start;
}

struct Checksums {
  std::uint64_t images, truth, visibility, cameras;
  bool operator==(const Checksums&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Checksums& sums) {
  return out << std::hex << "{0x" << sums.images << ", 0x" << sums.truth << ", 0x"
             << sums.visibility << ", 0x" << sums.cameras << "}" << std::dec;
}

Checksums checksums_of(const std::vector<std::string>& parts, const RenderOptions& options) {
  std::vector<Object> objects;
  for (const std::string& part : parts) objects.push_back(make_part(part));
  const SimulatedScene scene = make_scene(objects, options);
  ThreadPool pool(2);
  const std::vector<Rendering> renderings = render(scene, pool);
  const TemporaryFolder folder;
  write_bop_scene(scene, renderings, folder.path());
  const auto file = [&](const char* name) { return checksum(content_of(folder.path() / name)); };
  std::uint64_t images = checksum(std::string());
  for (const Rendering& rendering : renderings) images = checksum(rendering.image.pixels, images);
  return {images, file("scene_gt.json"), file("scene_gt_info.json"), file("scene_camera.json")};
}

RenderOptions small(unsigned seed) {
  RenderOptions options;
  options.seed = seed;
  options.width = 160;
  options.height = 120;
  options.focal_px = 190;
  return options;
}

TEST(SameBytes, TwoViewsOfSeveralModels) {
  RenderOptions options = small(3);
  options.objects = 6;
  options.views = 2;
  EXPECT_EQ(
      checksums_of({"l_bracket", "bearing_block", "stepped_shaft"}, options),
      (Checksums{0x67ac5f42ea3902e2, 0xe16b3d90d447405d, 0x8e179a066b948b2d, 0x29f610a52519551c}));
}

TEST(SameBytes, PileWithMuchClutter) {
  RenderOptions options = small(11);
  options.objects = 5;
  options.pile = 0.9;
  options.clutter = 2;
  EXPECT_EQ(
      checksums_of({"hex_nut", "u_channel", "gear_plate"}, options),
      (Checksums{0x20a49fba944d50c2, 0x39c21dcddd120ef7, 0xb8cf00e4512f063b, 0xd7ac5f609925ec36}));
}

TEST(SameBytes, NoShadowsAtAGivenDistance) {
  RenderOptions options = small(7);
  options.objects = 4;
  options.clutter = 0;
  options.pile = 0.3;
  options.min_distance_m = 0.3;
  options.max_distance_m = 0.5;
  options.shadows = false;
  options.supersampling = 1;
  options.blur_px = 0;
  options.noise_grey = 0;
  EXPECT_EQ(
      checksums_of({"l_bracket"}, options),
      (Checksums{0x970bff6d81d478a5, 0x20e9ae518ccdea5c, 0x391328716f1b596f, 0xc963e139d24d521b}));
}

}  // namespace
}  // namespace edgescout::test
