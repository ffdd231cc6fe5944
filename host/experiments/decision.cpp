#include "host/experiments/decision.h"

#include "host/active/combinations.h"
#include "host/active/views.h"
#include "host/detect/plausible_pairs.h"
#include "host/experiments/bin_types.h"

namespace edgescout {

namespace {

Detection candidate_near(const BinInstance& instance, const EdgeModel& model, Random& random) {
  Detection candidate;
  candidate.object = instance.object;
  candidate.world_from_object =
      perturbed(instance.world_from_object, Matrix6d::Zero(), model, {0.02, 0.02}, random);
  candidate.psi = random.uniform(0.6, 0.95);
  candidate.probability = random.uniform(0.05, 0.95);
  return candidate;
}

}  // namespace

Bin decision_bin(ThreadPool& pool) {
  return make_bin(bin_types(), ExperimentSettings::full_form(), 2, pool);
}

DecisionWork make_decision_work(const Bin& bin, const DecisionSize& size, Backend& backend) {
  DecisionWork work;
  work.size = size;
  for (const Object& object : bin_types()) work.models.push_back(make_edge_model(object.mesh));
  for (const EdgeModel& model : work.models)
    work.tables.push_back(make_template_table(model, bin_views().radius_m, backend));
  HemisphereOptions hemisphere = bin_views();
  hemisphere.count = size.views + 1;
  work.views = hemisphere_views(hemisphere);
  work.closed.assign(work.views.size(), 0);
  work.closed[0] = 1;
  ObjectView first;
  first.camera = work.camera;
  first.camera_from_world = work.views[0];
  work.real_views.push_back(std::move(first));
  Random random(1);
  for (int i = 0; i < size.candidates; ++i) {
    const BinInstance& instance = bin.instances[static_cast<std::size_t>(i) % bin.instances.size()];
    const EdgeModel& model = work.models[static_cast<std::size_t>(instance.object)];
    work.candidates.push_back(candidate_near(instance, model, random));
  }
  work.particles = draw_particles(work.models, work.candidates, size.particles, {0.02, 0.1},
                                  random.split("particles"));
  return work;
}

int decide(const DecisionWork& work, Backend& backend) {
  CombinationOptions combinations;
  combinations.count = work.size.combinations;
  const BitMatrix sampled = candidate_combinations(
      work.models, work.candidates, true, DEFAULT_PENETRATION_M, combinations, backend.threads());
  const NextViewProblem problem{{work.models, work.real_views, backend},
                                work.tables,
                                work.camera,
                                work.views,
                                work.closed,
                                work.candidates,
                                &sampled,
                                work.particles};
  return best_view(view_information(problem, {})).value_or(-1);
}

}  // namespace edgescout
