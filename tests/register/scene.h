// Parts at known poses in front of known cameras, given as the edge points of an ideal detector.
#pragma once

#include <vector>

#include "host/core/random.h"
#include "host/edge/edge_index.h"
#include "host/register/d2co.h"
#include "host/register/lm_state.h"
#include "host/render/parts.h"
#include "tests/register/linear_tensor.h"

namespace edgescout::test {

inline Camera scene_camera() { return {480, 360, 700, 700, 239.5, 179.5, {}}; }

inline EdgeModel part_model(const std::string& part, double raster_step_m = 0) {
  EdgeModelOptions options;
  options.raster_step_m = raster_step_m;
  return make_edge_model(make_part(part).mesh, options);
}

// Edge points a third of a pixel apart or closer.
inline std::vector<EdgePoint> ideal_edges(const EdgeModel& dense, const Camera& camera,
                                          const Se3& camera_from_object, Backend& backend) {
  std::vector<EdgePoint> edges;
  const Intrinsics k = intrinsics_of(camera);
  const std::vector<ModelPoint> visible =
      visible_edges(dense, std::span(&camera_from_object, 1), backend)[0];
  for (const ModelPoint& point : visible) {
    const Landing at = land(k, camera_from_object, point);
    edges.push_back({float(at.u), float(at.v), float(at.theta), 1});
  }
  return edges;
}

inline ObjectView view_of(const EdgeModel& dense, const Se3& world_from_object,
                          const Se3& camera_from_world, Backend& backend,
                          const TensorOptions& options = {}) {
  const Camera camera = scene_camera();
  const std::vector<EdgePoint> edges =
      ideal_edges(dense, camera, camera_from_world * world_from_object, backend);
  ObjectView view;
  view.camera = camera;
  view.camera_from_world = camera_from_world;
  view.tensor =
      backend.make_view(edges, camera.width, camera.height, {}, intrinsics_of(camera), options);
  return view;
}

inline D2coOptions one_round(std::uint32_t loss, float scale_px, int iterations) {
  D2coOptions options;
  options.rounds = {{loss, scale_px, iterations, 0}};
  return options;
}

// A camera that looks at `target_m` from `eye_m`.
inline Se3 camera_looking_at(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& target_m) {
  const Eigen::Vector3d z = (target_m - eye_m).normalized(), x = z.unitOrthogonal(), y = z.cross(x);
  Eigen::Matrix3d camera_from_world;
  camera_from_world << x.transpose(), y.transpose(), z.transpose();
  return se3_from_matrix(camera_from_world, -camera_from_world * eye_m);
}

// One part seen from `view_count` random directions 0.35 m away, and a start 4 mm and 0.05 rad off
// the truth.
struct PartScene {
  EdgeModel model;
  Se3 truth;
  std::vector<ObjectView> views;
  ObjectPose start;

  PartScene(const std::string& part, int view_count, Random& random, Backend& backend,
            const TensorOptions& options = {})
      : model(part_model(part)), truth{random.rotation(), {1, 2, 0.5}} {
    const EdgeModel dense = part_model(part, 2e-4);
    for (int v = 0; v < view_count; ++v) {
      const Eigen::Vector3d eye = truth.translation_m + 0.35 * random.direction();
      views.push_back(
          view_of(dense, truth, camera_looking_at(eye, truth.translation_m), backend, options));
    }
    Vector6d off;
    off << 0.004 * random.direction(), 0.05 * random.direction();
    start = {0, retract(truth, off)};
  }

  Scene on(Backend& backend) const { return {{&model, 1}, views, backend}; }
};

// The scene's system at a pose, summed here from visible points (at most `most` per view, evenly
// thinned; 0: all) and the kernel.
inline WorldSystem system_at(const PartScene& scene, const Se3& world_from_object,
                             const PoseLoss& loss, std::size_t most, Backend& backend) {
  WorldSystem system;
  for (const ObjectView& view : scene.views) {
    const Se3 pose = view.camera_from_world * world_from_object;
    std::vector<ModelPoint> points = visible_edges(scene.model, std::span(&pose, 1), backend)[0];
    if (most > 0) {
      std::vector<ModelPoint> kept;
      for (std::size_t i = 0; i < most; ++i) kept.push_back(points[i * points.size() / most]);
      points = kept;
    }
    const PoseProblem problem{to_pose(pose), 0, std::uint32_t(points.size()), 0};
    NormalEquations out;
    backend.pose_normal_equations(std::span(&view.tensor, 1), points, std::span(&problem, 1), loss,
                                  std::span(&out, 1));
    add_view(system, out, view.camera_from_world);
  }
  return system;
}

}  // namespace edgescout::test
