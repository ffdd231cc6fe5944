#include "host/experiments/trials.h"

#include <fmt/ranges.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <set>

#include "host/baselines/baseline.h"
#include "host/core/pose_error.h"
#include "host/core/random.h"
#include "host/experiments/rates.h"
#include "host/register/refine.h"

namespace edgescout {

namespace {

constexpr const char* EDGESCOUT = "edgescout";

// On a CPU the CPU time of this thread, so that other work on the machine does not count. On a
// device the wall-clock time.
double seconds_now(const Backend& backend) {
  if (backend.is_gpu())
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Registrar prepare_edgescout(const Scene& scene) {
  return [scene, options = RefineOptions{}](std::span<const ObjectPose> starts) {
    return refine_poses(scene, starts, options);
  };
}

TensorOptions tensor_of(const Trial& trial, const ExperimentSettings& settings) {
  TensorOptions tensor = with_lambda(
      settings.tensor, trial.method == EDGESCOUT ? OWN_LAMBDA_PX_PER_RAD : trial.lambda_px_per_rad);
  tensor.smoothing_variance = trial.smoothing_variance.value_or(tensor.smoothing_variance);
  return tensor;
}

// Makes the views with every tensor that the trials need, each once.
class TrialViews {
 public:
  TrialViews(const KnownScene& scene, const ExperimentSettings& settings, Backend& backend)
      : scene_(scene),
        settings_(settings),
        backend_(backend),
        edges_(edges_of(scene, backend, settings.edges)) {}
  std::span<const ObjectView> of(const Trial& trial) {
    const TensorOptions tensor = tensor_of(trial, settings_);
    std::vector<ObjectView>& views = made_[{tensor.lambda_px_per_rad, tensor.smoothing_variance}];
    if (views.empty()) views = register_views(scene_, edges_, tensor, backend_);
    return views;
  }

 private:
  const KnownScene& scene_;
  const ExperimentSettings& settings_;
  Backend& backend_;
  SceneEdges edges_;
  std::map<std::pair<float, float>, std::vector<ObjectView>> made_;  // by lambda and smoothing
};

struct TimedRegistrations {
  std::vector<PoseEstimate> estimates;  // one per start
  double ms = 0;                        // of one registration
};

std::vector<ObjectPose> poses_in_world(const KnownScene& known, const std::vector<Start>& starts) {
  const Se3& camera_from_world = known.images[0].camera_from_world;
  std::vector<ObjectPose> poses;
  for (const Start& start : starts)
    poses.push_back({known.instances[start.instance].object,
                     inverse(camera_from_world) * start.camera_from_object});
  return poses;
}

// All starts of one call are of one object, so that every method works on batches of equal kind.
TimedRegistrations run_trial(const Trial& trial, const Scene& scene,
                             std::span<const ObjectPose> starts, const BaselineOptions& options) {
  const Registrar registrar = trial.method == EDGESCOUT
                                  ? prepare_edgescout(scene)
                                  : prepare_method(method_from(trial.method), scene, options);
  const double begin = seconds_now(scene.backend);
  TimedRegistrations result;
  result.estimates = registrar(starts);
  result.ms = 1000 * (seconds_now(scene.backend) - begin) / static_cast<double>(starts.size());
  return result;
}

std::vector<std::string> row_of(const KnownScene& scene, const Start& start, const Trial& trial,
                                const PoseEstimate& found, const std::string& ms) {
  const KnownInstance& instance = scene.instances[start.instance];
  const Object& object = scene.objects[instance.object];
  const Se3 truth = scene.images[0].camera_from_world * instance.world_from_object,
            pose = scene.images[0].camera_from_world * found.world_from_object;
  const PoseError error = pose_error(pose, truth, object.symmetries);
  return {scene.set,
          scene.name,
          object.mesh.name,
          instance.name,
          std::to_string(start.number),
          number_text(start.distance_rad),
          number_text(instance.visible),
          trial.name(),
          std::to_string(trial.views),
          number_text(error.angle_rad),
          number_text(1000 * error.distance_m),
          number_text(mspd_px(pose, truth, object, scene.images[0].camera)),
          error.passes() ? "1" : "0",
          std::to_string(found.iterations),
          found.convergence == Convergence::IterationLimit ? "1" : "0",
          ms};
}

std::vector<std::vector<Start>> by_object(const KnownScene& scene,
                                          const std::vector<Start>& starts) {
  std::vector<std::vector<Start>> groups(scene.objects.size());
  for (const Start& start : starts) groups[scene.instances[start.instance].object].push_back(start);
  std::erase_if(groups, [](const std::vector<Start>& group) { return group.empty(); });
  return groups;
}

struct Offset {
  double turn_rad = 0, shift_m = 0;
};

Se3 nearest_equal(const Se3& truth, const Symmetries& symmetries, const Se3& pose) {
  return truth * *std::ranges::min_element(symmetries.discrete, {}, [&](const Se3& symmetry) {
           return angle_between_rad(pose, truth * symmetry);
         });
}

// Moves the truth by `step`. The angle of the step is kept between the result and the nearest pose
// that looks like the truth: a turn about the axis of a shaft changes nothing, so the direction
// comes from the remaining part of the turn.
Se3 moved_off(Se3 truth, const Symmetries& symmetries, Vector6d step) {
  constexpr int corrections = 10;
  const double turn_rad = step.tail<3>().norm();
  Se3 start = retract(truth, step);
  for (int i = 0; i < corrections && symmetries.discrete.size() > 1; ++i) {
    truth = nearest_equal(truth, symmetries, start);
    step.tail<3>() = turn_rad * local_coordinates(truth, start).tail<3>().normalized();
    start = retract(truth, step);
  }
  return start;
}

// Makes starts in random directions from every instance. `offset_of` gives their distance from the
// truth, the start's number and a source of random numbers.
std::vector<Start> starts_off(const KnownScene& scene, int count, const Random& seed,
                              const std::function<Offset(const Se3&, int, Random&)>& offset_of) {
  std::vector<Start> starts;
  const Random scene_random = seed.split(scene.set).split(scene.name);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    Random random = scene_random.split(scene.instances[i].name);
    const Object& object = scene.objects[static_cast<std::size_t>(scene.instances[i].object)];
    const Se3 truth = scene.images[0].camera_from_world * scene.instances[i].world_from_object;
    for (int k = 0; k < count; ++k) {
      const Offset offset = offset_of(truth, k, random);
      Vector6d step;
      step << offset.shift_m * random.direction(), offset.turn_rad * random.direction();
      starts.push_back({static_cast<int>(starts.size()), static_cast<int>(i), offset.turn_rad,
                        moved_off(truth, object.symmetries, step)});
    }
  }
  return starts;
}

}  // namespace

std::vector<Start> as_starts(const std::vector<RecordedStart>& recorded) {
  std::vector<Start> starts;
  for (const RecordedStart& start : recorded)
    starts.push_back(
        {start.id, start.instance, LEVELS_RAD[start.level - 1], start.camera_from_object});
  return starts;
}

std::string Trial::name() const {
  std::vector<std::string> others;
  if (lambda_px_per_rad != PAPER_LAMBDA_PX_PER_RAD)
    others.push_back("lambda " + number_text(lambda_px_per_rad));
  if (smoothing_variance) others.push_back("smoothing " + number_text(*smoothing_variance));
  return others.empty() ? method : fmt::format("{} ({})", method, fmt::join(others, " and "));
}

std::vector<Start> starts_around(const KnownScene& scene, int count, unsigned seed) {
  return starts_off(scene, count, Random(seed), [count](const Se3&, int k, Random& random) {
    const double distance_rad = FARTHEST_START_RAD * (k + 1 - random.uniform()) / count;
    return Offset{distance_rad, METRES_PER_RADIAN * distance_rad};
  });
}

std::vector<Start> starts_by_distance(const KnownScene& scene, int count, unsigned seed) {
  return starts_off(scene, count, Random(seed).split("by distance"),
                    [](const Se3& truth, int, Random&) {
                      return Offset{0.1, 0.02 * truth.translation_m.norm()};
                    });
}

std::vector<std::string> trial_columns() {
  return {"set",     "image",  "object",  "instance",  "start",       "distance_rad",
          "visible", "method", "views",   "angle_rad", "distance_mm", "mspd_px",
          "right",   "steps",  "cut_off", "ms"};
}

Notes trial_notes(const ExperimentSettings& s) {
  return {lambda_note(),
          {"edges", name_of(s.edges)},
          {"smoothing_variance", number_text(s.tensor.smoothing_variance)},
          {"cap_px", number_text(s.tensor.cap_px)},
          {"associations", std::to_string(s.methods.outer_iterations)},
          {"solve_steps", std::to_string(s.methods.inner_iterations)},
          {"loss_scale_px", number_text(s.methods.loss_scale_px)}};
}

Table run_trials(const KnownScene& scene, const std::vector<Start>& starts,
                 const std::vector<Trial>& trials, const ExperimentSettings& settings,
                 Backend& backend) {
  std::vector<EdgeModel> models;
  for (const Object& object : scene.objects) models.push_back(make_edge_model(object.mesh));
  TrialViews trial_views(scene, settings, backend);
  Table table{{}, trial_columns(), {}};
  for (const std::vector<Start>& group : by_object(scene, starts)) {
    const std::vector<ObjectPose> poses = poses_in_world(scene, group);
    for (const Trial& trial : trials) {
      const std::span<const ObjectView> views = trial_views.of(trial);
      if (trial.views > static_cast<int>(views.size())) continue;
      const TimedRegistrations found =
          run_trial(trial, {models, views.first(trial.views), backend}, poses, settings.methods);
      for (std::size_t i = 0; i < group.size(); ++i)
        table.rows.push_back(row_of(scene, group[i], trial, found.estimates[i],
                                    settings.times ? number_text(found.ms) : ""));
    }
  }
  return table;
}

}  // namespace edgescout
