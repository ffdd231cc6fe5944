// A small rendered cell with brackets, and options with which a scout runs in it within seconds.
#pragma once

#include <map>

#include "host/active/scout.h"
#include "host/active/views.h"
#include "host/core/pose_error.h"
#include "host/render/parts.h"
#include "host/render/simulated_cell.h"
#include "kernels/thread_pool.h"
#include "tests/bare_board.h"

namespace edgescout::test {

struct SmallCell {
  Object part;
  ThreadPool pool{2};
  SimulatedScene scene;
  std::vector<Se3> views = hemisphere_views({{0, 0, 0.01}, 0.3, {40, 70}, 8});
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  std::vector<TemplateSet> sets;

  explicit SmallCell(const std::string& name) : SmallCell(1, 0, name) {}
  explicit SmallCell(int objects = 1, double pile = 0, const std::string& name = "l_bracket")
      : part(make_part(name)) {
    RenderOptions options = bare_board(objects);
    options.pile = pile;
    scene = make_scene(std::span(&part, 1), options);
    // The templates of a part are built once a program.
    static std::map<std::string, TemplateSet> built;
    if (!built.contains(name)) built[name] = build_templates(part, near_templates(0.04), *backend);
    sets.push_back(built[name]);
  }

  Camera camera() const { return scene.views[0].camera; }
  SimulatedCell source(const ArmNoise& noise = {}) { return {scene, camera(), views, noise, pool}; }

  // Few of everything, three images. The limit of what is reported is lower than fitted.
  static ScoutOptions options() {
    ScoutOptions o;
    o.pipeline.detect.coarse_poses = 200;
    o.pipeline.detect.candidates = 8;
    o.max_candidates = 12;
    o.particles.count = 60;
    o.combinations.count = 200;
    o.detections.min_probability = 0.1;
    o.min_entropy_nats = 0;
    o.max_views = 3;
    return o;
  }
  Scout scout(const ScoutOptions& o = options()) { return {sets, camera(), views, o, *backend}; }

  // Instances with a detection within 2 mm and 0.05 rad.
  int found(const ScoutState& state) const {
    int count = 0;
    for (const PlacedObject& placed : scene.placed)
      count += std::ranges::any_of(state.detections, [&](const ModeDetection& mode) {
        return pose_error(mode.detection.world_from_object, placed.world_from_object,
                          part.symmetries)
            .passes(0.05, 0.002);
      });
    return count;
  }
};

}  // namespace edgescout::test
