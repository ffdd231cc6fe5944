// A bearing block that moves before a camera, in flat images, and what it is tracked with.
#pragma once

#include <gtest/gtest.h>

#include "host/core/pose_error.h"
#include "host/render/parts.h"
#include "host/track/tracker.h"
#include "kernels/thread_pool.h"
#include "tests/track/flat_images.h"

namespace edgescout::test {

inline const Object block = make_part("bearing_block");
// Goes to the right and turns: some 4 px and 0.03 rad per frame.
inline Se3 pose_at(int frame) {
  return {so3_exp({0.5 + 0.01 * frame, -0.4 + 0.025 * frame, 0.3}),
          {-0.06 + 0.004 * frame, 0.01, 0.4 + 0.002 * frame}};
}

class TrackerTest : public testing::Test {
 protected:
  TrackFrame frame(int number, int stripes_px = 0) {
    return {std::make_shared<const Image>(flat_of(pose_at(number), stripes_px)), 0.1 * number};
  }
  TrackFrame empty(int number) const {
    return {std::make_shared<const Image>(
                Image{camera.width, camera.height, std::vector<std::uint8_t>(320 * 240, 35)}),
            0.1 * number};
  }
  Image flat_of(const Se3& pose, int stripes_px = 0) {
    return flat_image(block.mesh, pose, pool, camera, stripes_px);
  }
  static double error(const Track& track, const Se3& truth) {
    return mssd_m(track.world_from_object, truth, block) / block.mesh.diameter_m;
  }

  ThreadPool pool{2};
  Camera camera = flat_camera();
  std::unique_ptr<Backend> backend = make_backend("cpu");
  std::vector<TemplateSet> sets{without_views(block)};
};

}  // namespace edgescout::test
