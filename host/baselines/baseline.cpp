#include "host/baselines/baseline.h"

#include <utility>

#include "host/baselines/methods.h"
#include "host/register/d2co.h"
#include "host/register/visible_in_views.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::pair<Method, const char*> method_names[] = {{Method::D2co, "d2co"},
                                                           {Method::DcIcp, "dc-icp"},
                                                           {Method::LmIcp, "lm-icp"},
                                                           {Method::CIcp, "c-icp"},
                                                           {Method::Direct, "direct"}};

// Eq. 8 in one round, so with the visible points of the start.
D2coOptions as_published(const BaselineOptions& options) {
  D2coOptions d2co;
  d2co.rounds = {{LOSS_HUBER, float(options.loss_scale_px), options.inner_iterations, 0}};
  d2co.min_step_m = options.min_step_m;
  d2co.min_step_rad = options.min_step_rad;
  d2co.visibility = options.visibility;
  return d2co;
}

PoseSolver prepare_solver(Method method, std::span<const ObjectView> views,
                          const BaselineOptions& options) {
  switch (method) {
    case Method::DcIcp:
      return prepare_dc_icp(views, options);
    case Method::LmIcp:
      return prepare_lm_icp(views, options);
    case Method::CIcp:
      return prepare_c_icp(views, options);
    case Method::Direct:
      return prepare_direct(views, options);
    case Method::D2co:
      break;
  }
  throw LogicError("no method that works point by point");
}

}  // namespace

std::vector<Method> all_methods() {
  std::vector<Method> methods;
  for (const auto& [method, name] : method_names) methods.push_back(method);
  return methods;
}

std::string to_string(Method method) {
  for (const auto& [known, name] : method_names)
    if (known == method) return name;
  throw LogicError("unknown registration method");
}

Method method_from(const std::string& name) {
  std::string names;
  for (const auto& [method, known] : method_names) {
    if (name == known) return method;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw InputError("registration", "method", "\"" + name + "\"", "one of " + names);
}

void BaselineOptions::validate() const {
  const auto refuse = [](const char* field, double found, const char* bound) {
    throw InputError("options", std::string("baselines.") + field, std::to_string(found), bound);
  };
  if (outer_iterations < 1 || outer_iterations > 1000)
    refuse("outer_iterations", outer_iterations, "a number in [1, 1000]");
  if (inner_iterations < 1 || inner_iterations > 1000)
    refuse("inner_iterations", inner_iterations, "a number in [1, 1000]");
  if (!(min_step_m >= 0 && min_step_m <= 1))
    refuse("min_step_m", min_step_m, "a length in [0, 1] m");
  if (!(min_step_rad >= 0 && min_step_rad <= 1))
    refuse("min_step_rad", min_step_rad, "an angle in [0, 1] rad");
  if (!(loss_scale_px > 0 && loss_scale_px <= 1000))
    refuse("loss_scale_px", loss_scale_px, "a loss scale in (0, 1000] px");
  if (pyramid_levels < 1 || pyramid_levels > 8)
    refuse("pyramid_levels", pyramid_levels, "a number in [1, 8]");
}

Registrar prepare_method(Method method, const Scene& scene, const BaselineOptions& options) {
  options.validate();
  check(!scene.views.empty(), "prepare_method: at least one view");
  if (method == Method::D2co)
    return [scene, options](std::span<const ObjectPose> starts) {
      return register_poses(scene, starts, as_published(options));
    };
  return [scene, options, solve = prepare_solver(method, scene.views, options)](
             std::span<const ObjectPose> starts) {
    const Grid<std::vector<ModelPoint>> points = visible_points(scene, starts, options.visibility);
    std::vector<PoseEstimate> results;
    for (std::size_t i = 0; i < starts.size(); ++i)
      results.push_back(
          estimate_of(solve(starts[i].world_from_object, points.row(i)), starts[i].object));
    return results;
  };
}

std::vector<PoseEstimate> register_with(Method method, const Scene& scene,
                                        std::span<const ObjectPose> starts,
                                        const BaselineOptions& options) {
  return prepare_method(method, scene, options)(starts);
}

}  // namespace edgescout
