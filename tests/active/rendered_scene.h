// Separate parts on a bare board, rendered in several views, with models and candidates.
#pragma once

#include <map>
#include <tuple>

#include "host/active/particles.h"
#include "host/pipeline.h"
#include "host/register/object_view.h"
#include "host/render/parts.h"
#include "host/render/renderer.h"
#include "kernels/thread_pool.h"

namespace edgescout::test {

// Rendered once a program.
struct RenderedScene {
  std::vector<Object> parts;
  SimulatedScene scene;
  std::vector<Rendering> renderings;
  std::vector<TemplateSet> sets;
  std::vector<EdgeModel> models;

  RenderedScene(const std::vector<std::string>& names, int objects, int views)
      : RenderedScene(once(names, objects, views)) {}

  Camera camera() const { return scene.views[0].camera; }

  // `camera_from_world`: the pose that the arm reports; absent: the true one.
  ObjectView view(std::size_t index, Backend& backend,
                  std::optional<Se3> camera_from_world = {}) const {
    std::vector<StageSeconds> stages;
    ObjectView prepared = prepare_view(
        renderings[index].image, scene.views[index].camera,
        camera_from_world.value_or(scene.views[index].camera_from_world), backend, {}, &stages);
    add_tensors(prepared, 1.0, backend, {});
    return prepared;
  }
  std::vector<ObjectView> views(Backend& backend) const {
    std::vector<ObjectView> all;
    for (std::size_t v = 0; v < scene.views.size(); ++v) all.push_back(view(v, backend));
    return all;
  }

  // A candidate `distance_m` and `angle_rad` off a part, in a random direction.
  Detection candidate(std::size_t placed, double distance_m, double angle_rad,
                      Random& random) const {
    Detection d;
    d.object = scene.placed[placed].object;
    Vector6d off;
    off << distance_m * random.direction(), angle_rad * random.direction();
    d.world_from_object = retract(scene.placed[placed].world_from_object, off);
    d.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
    d.psi = 0.9;
    return d;
  }
  // Where there is nothing: high above the board.
  Detection false_candidate(int object, const Eigen::Vector3d& at_m, Random& random) const {
    Detection d;
    d.object = object;
    d.world_from_object = {random.rotation(), at_m};
    d.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
    d.psi = 0.7;
    return d;
  }

 private:
  struct New {};
  RenderedScene(New, const std::vector<std::string>& names, int objects, int views) {
    for (const std::string& name : names) parts.push_back(make_part(name));
    RenderOptions options;
    options.width = 480;
    options.height = 360;
    options.focal_px = 600;
    options.objects = objects;
    options.views = views;
    options.clutter = 0;
    options.pile = 0;
    scene = make_scene(parts, options);
    ThreadPool pool(2);
    renderings = render(scene, pool);
    for (const Object& part : parts) sets.push_back(without_views(part));
    for (const TemplateSet& set : sets) models.push_back(set.model);
  }
  static const RenderedScene& once(const std::vector<std::string>& names, int objects, int views) {
    static std::map<std::tuple<std::vector<std::string>, int, int>, RenderedScene> made;
    const std::tuple key{names, objects, views};
    const auto at = made.find(key);
    if (at != made.end()) return at->second;
    return made.emplace(key, RenderedScene(New{}, names, objects, views)).first->second;
  }
};

}  // namespace edgescout::test
