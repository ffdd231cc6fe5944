#include "host/baselines/baseline.h"

#include <utility>

#include "host/baselines/methods.h"
#include "host/baselines/visible_points.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::pair<Method, const char*> method_names[] = {{Method::D2co, "d2co"},
                                                           {Method::DcIcp, "dc-icp"},
                                                           {Method::LmIcp, "lm-icp"},
                                                           {Method::CIcp, "c-icp"},
                                                           {Method::Direct, "direct"}};

// Eq. 8 in one round: the visible points are those of the start.
D2coOptions as_published(const BaselineOptions& options) {
  D2coOptions d2co;
  d2co.rounds = {{LOSS_HUBER, float(options.loss_scale_px), options.inner_iterations, 0}};
  d2co.min_step_m = options.min_step_m;
  d2co.min_step_rad = options.min_step_rad;
  d2co.visibility = options.visibility;
  return d2co;
}

PoseSolver prepare_solver(Method method, std::span<const RegisterView> views,
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

Registrar prepare_method(Method method, std::span<const EdgeModel> models,
                         std::span<const RegisterView> views, Backend& backend,
                         const BaselineOptions& options) {
  options.validate();
  check(!views.empty(), "prepare_method: at least one view");
  if (method == Method::D2co)
    return [models, views, &backend, options](std::span<const ObjectPose> hypotheses) {
      return register_poses(models, hypotheses, views, backend, as_published(options));
    };
  return [models, views, &backend, options,
          solve = prepare_solver(method, views, options)](std::span<const ObjectPose> hypotheses) {
    const std::vector<std::vector<ModelPoint>> points =
        visible_points(models, hypotheses, views, backend, options.visibility);
    std::vector<Registration> results;
    for (std::size_t h = 0; h < hypotheses.size(); ++h)
      results.push_back(
          registration_of(solve(hypotheses[h].world_from_object,
                                std::span(points).subspan(h * views.size(), views.size()))));
    return results;
  };
}

std::vector<Registration> register_with(Method method, std::span<const EdgeModel> models,
                                        std::span<const ObjectPose> hypotheses,
                                        std::span<const RegisterView> views, Backend& backend,
                                        const BaselineOptions& options) {
  return prepare_method(method, models, views, backend, options)(hypotheses);
}

}  // namespace edgescout
