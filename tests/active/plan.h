// Parts around the origin as candidates and particles, with cameras around them: a problem for the
// choice of the next view.
#pragma once

#include "host/active/combinations.h"
#include "host/active/next_view.h"
#include "host/active/views.h"
#include "host/render/parts.h"

namespace edgescout::test {

inline Camera test_camera() { return {480, 360, 600, 600, 239.5, 179.5, {}}; }

inline ObjectView looked_from(const Se3& camera_from_world) {
  ObjectView view;
  view.camera = test_camera();
  view.camera_from_world = camera_from_world;
  return view;
}

struct Plan {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  std::vector<EdgeModel> models;
  std::vector<TemplateTable> tables;
  std::vector<Se3> views;
  std::vector<ObjectView> real;
  std::vector<Detection> candidates;
  std::vector<Particle> particles;
  BitMatrix combinations;
  std::vector<char> closed;
  NextViewOptions options;

  explicit Plan(int count = 6) {
    options.visibility_exponent = options.view_correlation_angle_rad =
        options.exploration_bonus_nats = 0;
    static const std::vector<EdgeModel> made{make_edge_model(make_part("l_bracket").mesh),
                                             make_edge_model(make_part("bearing_block").mesh)};
    static const std::vector<TemplateTable> made_tables{
        make_template_table(made[0], 0.5, *backend, {3, 300}),
        make_template_table(made[1], 0.5, *backend, {3, 300})};
    models = made;
    tables = made_tables;
    views = hemisphere_views({{0, 0, 0.02}, 0.5, {35, 70}, 10});
    real = {looked_from(views[0])};
    closed.assign(views.size(), 0);
    closed[0] = 1;
    Random random(7);
    for (int i = 0; i < count; ++i) {
      Detection c;
      c.object = i % 2;
      c.world_from_object = {random.rotation(),
                             {0.07 * (i % 3) - 0.07, 0.08 * (i / 3) - 0.04, 0.03}};
      c.psi = 0.6 + 0.05 * i;
      c.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4;
      candidates.push_back(c);
    }
    particles = draw_particles(models, candidates, 24, {0.02, 0.1}, Random(3));
    draw_combinations();
  }
  void draw_combinations() {
    combinations =
        candidate_combinations(models, candidates, false, 0.002, {60, 1, 1}, backend->threads());
  }
  NextViewProblem problem(Backend& device) const {
    return {{models, real, device}, tables,   test_camera(), views, closed, candidates,
            &combinations,          particles};
  }
  std::vector<ViewInformation> information() {
    return view_information(problem(*backend), options);
  }
};

}  // namespace edgescout::test
