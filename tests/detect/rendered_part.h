// Rendered parts of known pose on a bare board, with their templates.
#pragma once

#include <map>
#include <tuple>

#include "host/core/pose_error.h"
#include "host/pipeline.h"
#include "host/render/parts.h"
#include "host/render/renderer.h"
#include "kernels/thread_pool.h"
#include "tests/bare_board.h"

namespace edgescout::test {

// `count` parts on a bare board, from `views` places, 0.3 m away unless another distance is given.
// Rendered once a program.
struct RenderedPart {
  Object part;
  SimulatedScene scene;
  std::vector<Rendering> renderings;
  std::vector<TemplateSet> sets;

  explicit RenderedPart(const std::string& name, int views = 1, int count = 1,
                        double distance_m = 0.3)
      : RenderedPart(once(name, views, count, distance_m)) {}
  // The threshold of reported poses is fitted elsewhere; here the best one counts. The few
  // templates have few hits that matter.
  static PipelineOptions options() {
    PipelineOptions all;
    all.detect.min_probability = 0.02;
    all.detect.coarse_poses = all.detect.coarse_poses_joint = 1000;
    all.detect.medium_poses = all.detect.medium_poses_joint = 200;
    all.detect.candidates = 20;
    return all;
  }
  Se3 world_truth() const { return scene.placed[0].world_from_object; }
  Se3 truth_in(std::size_t view, std::size_t placed = 0) const {
    return scene.views[view].camera_from_world * scene.placed[placed].world_from_object;
  }
  ObjectView prepared(std::size_t view, const Se3& camera_from_world, Backend& backend) const {
    std::vector<StageSeconds> stages;
    return prepare_view(renderings[view].image, scene.views[view].camera, camera_from_world,
                        backend, options(), &stages);
  }
  ObjectView with_tensors(std::size_t view, Backend& backend) const {
    ObjectView built = prepared(view, scene.views[view].camera_from_world, backend);
    add_tensors(built, sets, backend, options().tensor);
    return built;
  }
  Detections detect(std::size_t view, Backend& backend,
                    const PipelineOptions& with = options()) const {
    return detect_objects(prepared(view, Se3{}, backend), sets, backend, with);
  }
  Detections detect_in_all(Backend& backend) const {
    std::vector<ObjectView> views;
    for (std::size_t v = 0; v < scene.views.size(); ++v)
      views.push_back(prepared(v, scene.views[v].camera_from_world, backend));
    return detect_jointly(views, sets, backend, options());
  }
  PoseError error(const Se3& found, const Se3& truth) const {
    return pose_error(found, truth, part.symmetries);
  }

 private:
  struct New {};
  RenderedPart(New, const std::string& name, int views, int count, double distance_m)
      : part(make_part(name)) {
    RenderOptions board = bare_board(count, views);
    board.min_distance_m = board.max_distance_m = distance_m;
    scene = make_scene(std::span(&part, 1), board);
    ThreadPool pool(2);
    renderings = render(scene, pool);
    sets.push_back(build_templates(part, near_templates(0.03), *make_cpu_backend(2)));
  }
  static const RenderedPart& once(const std::string& name, int views, int count,
                                  double distance_m) {
    static std::map<std::tuple<std::string, int, int, double>, RenderedPart> made;
    const std::tuple key{name, views, count, distance_m};
    const auto at = made.find(key);
    if (at != made.end()) return at->second;
    return made.emplace(key, RenderedPart(New{}, name, views, count, distance_m)).first->second;
  }
};

}  // namespace edgescout::test
