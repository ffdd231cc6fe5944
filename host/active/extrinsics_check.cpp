#include "host/active/extrinsics_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/core/log.h"
#include "host/detect/probability.h"
#include "host/detect/probability_over_views.h"

namespace edgescout {

namespace {

// Mean way of the object's visible points in the image from one pose to the other, px.
double moved_px(std::span<const ModelPoint> points, const Camera& camera, const Se3& camera_from_a,
                const Se3& camera_from_b) {
  double sum = 0;
  int count = 0;
  for (const ModelPoint& point : points) {
    const Eigen::Vector3d x(point.x_m, point.y_m, point.z_m), a = camera_from_a * x,
                                                              b = camera_from_b * x;
    if (a.z() <= 0 || b.z() <= 0) continue;
    sum += (project(camera, a) - project(camera, b)).norm();
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

// How the objects, registered over all views, sit in one of them.
struct Judged {
  std::vector<char> shown;       // by object: whether this image alone has it
  std::vector<double> moved_px;  // by object: how far it then lies from where all images have it
  bool bare = false;             // shows not a trace of any
};

Judged judge(std::span<const EdgeModel> models, std::span<const ObjectPose> joint,
             const RegisterView& view, Backend& backend, const ExtrinsicsCheckOptions& options) {
  const std::span<const RegisterView> alone(&view, 1);
  const std::vector<ObjectPose> poses =
      object_poses_of(joint, register_poses(models, joint, alone, backend, options.single));
  const std::vector<PoseFeatures> features =
      pose_features(models, poses, alone, backend, options.score, options.single.visibility);
  Judged judged{{}, std::vector<double>(poses.size(), 0), true};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double probability = pose_probability(features[i]);
    judged.bare = judged.bare && probability < options.absent_probability;
    judged.shown.push_back(probability >= options.min_probability);
    if (!judged.shown[i]) continue;
    const Se3 camera_from_object = view.camera_from_world * poses[i].world_from_object;
    const std::vector<ModelPoint> points =
        visible_edges(models[poses[i].object], std::span(&camera_from_object, 1), backend,
                      options.single.visibility)[0];
    judged.moved_px[i] = moved_px(points, view.camera, camera_from_object,
                                  view.camera_from_world * joint[i].world_from_object);
  }
  return judged;
}

// What one of the views says beside the others. An object that no other view shows is no witness:
// it may be none at all, and this view's chance extrinsics_checks.
ExtrinsicsCheck beside(const Judged& view, std::span<const Judged> all) {
  ExtrinsicsCheck extrinsics_checks;
  std::vector<double> moved;
  for (std::size_t i = 0; i < view.shown.size(); ++i)
    if (view.shown[i] &&
        std::ranges::count_if(all, [i](const Judged& one) { return one.shown[i]; }) >= 2)
      moved.push_back(view.moved_px[i]);
  extrinsics_checks.objects = int(moved.size());
  if (!moved.empty()) extrinsics_checks.residual_px = median(moved);
  return extrinsics_checks;
}

// Objects that `others` together hold, at least two of them with a trace of their own, and that
// `view` should show, before what is known: a wrong pose of its camera must have no say in where
// they are.
int expected_in(std::span<const EdgeModel> models, std::span<const ObjectPose> objects,
                const RegisterView& view, std::span<const RegisterView> others, Backend& backend,
                const ExtrinsicsCheckOptions& options) {
  const std::vector<ObjectPose> poses =
      object_poses_of(objects, register_poses(models, objects, others, backend, options.joint));
  const std::vector<PoseFeatures> by_other = pose_features_by_view(
      models, poses, others, backend, options.score, options.joint.visibility);
  const std::vector<PoseFeatures> here = pose_features(models, poses, std::span(&view, 1), backend,
                                                       options.score, options.joint.visibility);
  int expected = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::span<const PoseFeatures> by_view =
        std::span(by_other).subspan(i * others.size(), others.size());
    const auto traces = std::ranges::count_if(by_view, [&](const PoseFeatures& features) {
      return pose_probability(features) >= options.absent_probability;
    });
    expected += here[i].in_image > 0.5 && traces >= 2 &&
                probability_over_views(by_view) >= options.held_probability;
  }
  return expected;
}

// One a view of `trusted`.
std::vector<ExtrinsicsCheck> judge_all(std::span<const EdgeModel> models,
                                       std::span<const ObjectPose> objects,
                                       std::span<const RegisterView> trusted, Backend& backend,
                                       const ExtrinsicsCheckOptions& options) {
  const std::vector<ObjectPose> joint =
      object_poses_of(objects, register_poses(models, objects, trusted, backend, options.joint));
  std::vector<Judged> judged;
  for (const RegisterView& view : trusted)
    judged.push_back(judge(models, joint, view, backend, options));
  std::vector<ExtrinsicsCheck> extrinsics_checks;
  for (std::size_t v = 0; v < trusted.size(); ++v) {
    extrinsics_checks.push_back(beside(judged[v], judged));
    if (!judged[v].bare || trusted.size() < 3) continue;
    std::vector<RegisterView> others(trusted.begin(), trusted.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(v));
    extrinsics_checks[v].missing =
        expected_in(models, objects, trusted[v], others, backend, options);
  }
  return extrinsics_checks;
}

// The view to distrust among `open`; views.size() where there is none.
std::size_t worst_of(std::span<const std::size_t> open, std::span<ExtrinsicsCheck> views,
                     const ExtrinsicsCheckOptions& options) {
  std::size_t worst = open[0], barest = open[0];
  for (const std::size_t v : open) {
    if (views[v].residual_px > views[worst].residual_px) worst = v;
    if (views[v].missing > views[barest].missing) barest = v;
  }
  // That the others hold what it lacks is said without its say; the residuals are not.
  if (views[barest].missing > options.max_missing) return barest;
  if (views[worst].residual_px > options.max_residual_px) {
    // Two views disagree with each other: the later one was added to a scene that agreed.
    if (open.size() == 2)
      views[open[0]].residual_px = views[open[1]].residual_px = views[worst].residual_px;
    return open.size() == 2 ? open[1] : worst;
  }
  return views.size();
}

void warn(std::size_t view, const ExtrinsicsCheck& found) {
  log(LogLevel::Warning,
      found.missing == 0
          ? fmt::format(
                "the camera pose of image {} disagrees with it: {:.1f} px between what all images "
                "say and what it shows",
                view + 1, found.residual_px)
          : fmt::format(
                "image {} shows none of {} objects that other images show: its camera pose is "
                "wrong, or something unknown hides them",
                view + 1, found.missing));
}

}  // namespace

D2coOptions ExtrinsicsCheckOptions::joint_defaults() {
  D2coOptions options;
  options.rounds = {{LOSS_GEMAN_MCCLURE, 30, 10, 300},
                    {LOSS_GEMAN_MCCLURE, 12, 8, 300},
                    {LOSS_GEMAN_MCCLURE, 5, 8, 400}};
  return options;
}

D2coOptions ExtrinsicsCheckOptions::single_defaults() { return joint_defaults(); }

std::vector<ExtrinsicsCheck> extrinsics_check(std::span<const EdgeModel> models,
                                              std::span<const ObjectPose> objects,
                                              std::span<const RegisterView> views, Backend& backend,
                                              const ExtrinsicsCheckOptions& options) {
  std::vector<ExtrinsicsCheck> extrinsics_checks(views.size());
  std::vector<std::size_t> open;
  for (std::size_t v = 0; v < views.size(); ++v) open.push_back(v);
  while (open.size() >= 2 && !objects.empty()) {
    std::vector<RegisterView> trusted;
    for (const std::size_t v : open) trusted.push_back(views[v]);
    const std::vector<ExtrinsicsCheck> judged =
        judge_all(models, objects, trusted, backend, options);
    for (std::size_t i = 0; i < open.size(); ++i) extrinsics_checks[open[i]] = judged[i];
    const std::size_t worst = worst_of(open, extrinsics_checks, options);
    if (worst == views.size()) break;
    extrinsics_checks[worst].disagrees = true;
    std::erase(open, worst);
  }
  return extrinsics_checks;
}

void keep_flags(std::span<const ExtrinsicsCheck> before, std::span<ExtrinsicsCheck> now) {
  for (std::size_t v = 0; v < before.size(); ++v)
    if (before[v].disagrees && !now[v].disagrees && now[v].objects == 0) now[v] = before[v];
}

void warn_of(std::span<const ExtrinsicsCheck> extrinsics_checks,
             std::span<const ExtrinsicsCheck> before) {
  for (std::size_t v = 0; v < extrinsics_checks.size(); ++v)
    if (extrinsics_checks[v].disagrees && !(v < before.size() && before[v].disagrees))
      warn(v, extrinsics_checks[v]);
}

}  // namespace edgescout
