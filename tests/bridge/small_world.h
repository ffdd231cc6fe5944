// A rendered part on a board, its templates, and messages of its images.
#pragma once

#include <cmath>
#include <memory>

#include "host/bridge/ros2/bridge.h"
#include "host/bridge/ros2/frames.h"
#include "host/bridge/ros2/image_message.h"
#include "host/io/mesh.h"
#include "host/render/parts.h"
#include "host/render/renderer.h"
#include "kernels/thread_pool.h"
#include "tests/bare_board.h"
#include "tests/examples.h"

namespace edgescout::ros2::test {

// Made once for all tests of a program.
struct SmallWorld {
  std::vector<Object> parts{make_part("l_bracket")};
  SimulatedScene scene = make_scene(parts, edgescout::test::bare_board(1, 2));
  std::vector<Rendering> renderings;
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  std::vector<TemplateSet> sets;

  SmallWorld() {
    ThreadPool pool(2);
    renderings = render(scene, pool);
    TemplateOptions options;
    options.frequency = 3;
    options.in_plane_steps = 12;
    options.distance_min_m = 0.27;
    options.distance_max_m = 0.33;
    const std::string file = edgescout::test::examples() / "parts/obj_000001.ply";
    sets.push_back(
        build_templates({1, load_mesh(file, LengthUnit::Millimetre), {}}, options, *backend));
  }

  const Image& image(std::size_t view = 0) const { return renderings[view].image; }
  Camera camera() const { return scene.views[0].camera; }
  Se3 camera_from_world(std::size_t view = 0) const { return scene.views[view].camera_from_world; }

  // Few hits are followed; where the line of what is reported lies is fitted elsewhere.
  static PipelineOptions pipeline() {
    PipelineOptions options;
    options.detect.coarse_poses = options.detect.coarse_poses_joint = 150;
    options.detect.medium_poses = options.detect.medium_poses_joint = 30;
    options.detect.candidates = 10;
    options.detect.min_probability = 0.01;
    return options;
  }
};

inline SmallWorld& small_world() {
  static SmallWorld world;
  return world;
}

inline msg::Header header_at(double seconds, const std::string& frame = "camera") {
  return {time_of(std::int64_t(seconds * 1e9)), frame};
}

inline msg::Image image_message(const Image& image, double seconds = 1) {
  return message_of(image, header_at(seconds));
}

// What SmallWorld's surfaces are away: 16UC1, mm, of whole rows.
inline msg::Image depth_message(double seconds = 1, std::size_t view = 0) {
  const Camera camera = small_world().camera();
  msg::Image message{.header = header_at(seconds),
                     .height = std::uint32_t(camera.height),
                     .width = std::uint32_t(camera.width),
                     .encoding = "16UC1",
                     .step = std::uint32_t(2 * camera.width)};
  for (const float z_m : small_world().renderings[view].depth_m) {
    const auto mm = std::uint16_t(std::isfinite(z_m) ? std::lround(1000 * z_m) : 0);
    message.data.push_back(std::uint8_t(mm & 0xff));
    message.data.push_back(std::uint8_t(mm >> 8));
  }
  return message;
}

inline msg::CameraInfo info_message(const Camera& camera, double seconds = 1) {
  msg::CameraInfo info;
  info.header = header_at(seconds);
  info.width = std::uint32_t(camera.width);
  info.height = std::uint32_t(camera.height);
  info.distortion_model = "plumb_bob";
  info.d = {0, 0, 0, 0, 0};
  info.k = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.p = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

// As a request gives it.
inline msg::CalibratedImage calibrated(std::size_t view) {
  return {info_message(small_world().camera()),
          message_of(inverse(small_world().camera_from_world(view))),
          image_message(small_world().image(view))};
}

inline msg::TransformStamped transform_message(const std::string& parent, const std::string& child,
                                               const Se3& parent_from_child, double seconds) {
  return {header_at(seconds, parent), child, transform_of(parent_from_child)};
}

}  // namespace edgescout::ros2::test
