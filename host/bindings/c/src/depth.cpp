#include "host/bindings/c/src/depth.h"

#include "host/bindings/c/src/contents.h"
#include "host/bindings/c/src/images.h"
#include "host/bindings/c/src/poses.h"
#include "host/io/camera_file.h"

namespace edgescout::c {

std::optional<TakenDepth> take_depth(const GivenDepth& given, const std::string& name) {
  if (!given.depth) {
    if (given.depth_camera || given.camera_from_depth)
      refuse(EDGESCOUT_BAD_INPUT, name + ".depth", "NULL beside a depth camera", "its image");
    return {};
  }
  TakenDepth taken{depth_of(given.depth), {}};
  if (given.depth_camera) {
    const DepthImage& stored = taken.stored.image;
    taken.from = DepthCamera{camera_for_image(*shared(given.depth_camera), stored.width,
                                              stored.height, false, "depth_camera"),
                             {}};
    if (given.camera_from_depth)
      taken.from->grey_from_depth =
          pose_of(given.camera_from_depth, (name + ".camera_from_depth").c_str());
  } else if (given.camera_from_depth) {
    refuse(EDGESCOUT_BAD_INPUT, name + ".depth_camera", "NULL beside camera_from_depth",
           "the camera of the depth image");
  }
  return taken;
}

std::shared_ptr<const MeasuredDepth> in_camera(const std::optional<TakenDepth>& taken,
                                               const Camera& camera, ThreadPool& pool) {
  if (!taken) return nullptr;
  return std::make_shared<const MeasuredDepth>(MeasuredDepth{
      in_grey_camera(taken->stored.image, taken->from, camera, pool), taken->stored.noise});
}

}  // namespace edgescout::c
