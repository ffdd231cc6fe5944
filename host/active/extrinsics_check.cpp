#include "host/active/extrinsics_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/core/log.h"
#include "host/register/pose_classifier.h"

namespace edgescout {

namespace {

// How far the object's visible points move in the image from one pose to the other: mean, px.
double mean_motion_px(std::span<const ModelPoint> points, const Camera& camera,
                      const Se3& camera_from_a, const Se3& camera_from_b) {
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

// The objects in one view: registered on it alone, starting from the joint registration.
struct SingleView {
  std::vector<char> shown;        // by object: whether this image alone shows it
  std::vector<double> motion_px;  // by object: between its joint and its single registration
  bool shows_nothing = false;     // of any object
};

SingleView register_in_view(const Scene& scene, std::span<const ObjectPose> joint,
                            const ObjectView& view, const ExtrinsicsCheckOptions& options) {
  const Scene alone{scene.models, {&view, 1}, scene.backend};
  const std::vector<ObjectPose> poses = object_poses(register_poses(alone, joint, options.single));
  const std::vector<PoseFeatures> features =
      pooled_features(alone, poses, {options.score, options.single.visibility});
  SingleView single{{}, std::vector<double>(poses.size(), 0), true};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double probability = PoseClassifier::probability(features[i]);
    single.shows_nothing = single.shows_nothing && probability < options.absent_probability;
    single.shown.push_back(probability >= options.min_probability);
    if (!single.shown[i]) continue;
    const Se3 camera_from_object = view.camera_from_world * poses[i].world_from_object;
    const std::vector<ModelPoint> points =
        visible_edges(scene.models[poses[i].object], std::span(&camera_from_object, 1),
                      scene.backend, options.single.visibility)[0];
    single.motion_px[i] = mean_motion_px(points, view.camera, camera_from_object,
                                         view.camera_from_world * joint[i].world_from_object);
  }
  return single;
}

// The check of one of all views. An object that no other view shows does not count: it may not
// exist, and agree with this view by chance.
ExtrinsicsCheck compare(const SingleView& view, std::span<const SingleView> all) {
  ExtrinsicsCheck check;
  std::vector<double> motion_px;
  for (std::size_t i = 0; i < view.shown.size(); ++i)
    if (view.shown[i] &&
        std::ranges::count_if(all, [i](const SingleView& one) { return one.shown[i]; }) >= 2)
      motion_px.push_back(view.motion_px[i]);
  check.objects = int(motion_px.size());
  if (!motion_px.empty()) check.residual_px = median(motion_px);
  return check;
}

// How many objects `view` should show: by the joint pose of the other views of the scene, at least
// two of which show something of the object. `view` itself has no part in the poses, as its camera
// pose may be wrong.
int count_expected(const Scene& others, std::span<const ObjectPose> objects, const ObjectView& view,
                   const ExtrinsicsCheckOptions& options) {
  const FeatureOptions measure{options.score, options.joint.visibility};
  const std::vector<ObjectPose> poses =
      object_poses(register_poses(others, objects, options.joint));
  const Grid<PoseFeatures> in_others = features_by_view(others, poses, measure);
  const std::vector<PoseFeatures> here =
      pooled_features({others.models, {&view, 1}, others.backend}, poses, measure);
  int expected = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto showing = std::ranges::count_if(in_others.row(i), [&](const PoseFeatures& features) {
      return PoseClassifier::probability(features) >= options.absent_probability;
    });
    expected += here[i].in_image > 0.5 && showing >= 2 &&
                PoseClassifier::probability(in_others.row(i)) >= options.held_probability;
  }
  return expected;
}

// One result per view of the scene; none is flagged yet.
std::vector<ExtrinsicsCheck> check_all(const Scene& scene, std::span<const ObjectPose> objects,
                                       const ExtrinsicsCheckOptions& options) {
  const std::vector<ObjectPose> joint = object_poses(register_poses(scene, objects, options.joint));
  std::vector<SingleView> single;
  for (const ObjectView& view : scene.views)
    single.push_back(register_in_view(scene, joint, view, options));
  std::vector<ExtrinsicsCheck> checks;
  for (std::size_t v = 0; v < scene.views.size(); ++v) {
    checks.push_back(compare(single[v], single));
    if (!single[v].shows_nothing || scene.views.size() < 3) continue;
    std::vector<ObjectView> others(scene.views.begin(), scene.views.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(v));
    checks[v].missing =
        count_expected({scene.models, others, scene.backend}, objects, scene.views[v], options);
  }
  return checks;
}

// The view to flag next, one of the `trusted`; checks.size() where there is none.
std::size_t find_disagreeing(std::span<const std::size_t> trusted,
                             std::span<ExtrinsicsCheck> checks,
                             const ExtrinsicsCheckOptions& options) {
  std::size_t largest = trusted[0], emptiest = trusted[0];
  for (const std::size_t v : trusted) {
    if (checks[v].residual_px > checks[largest].residual_px) largest = v;
    if (checks[v].missing > checks[emptiest].missing) emptiest = v;
  }
  // `missing` comes first: it does not depend on the view's own pose, as the residuals do.
  if (checks[emptiest].missing > options.max_missing) return emptiest;
  if (checks[largest].residual_px > options.max_residual_px) {
    if (trusted.size() > 2) return largest;
    // Two views disagree with each other: the later one was added to a scene that agreed.
    checks[trusted[0]].residual_px = checks[trusted[1]].residual_px = checks[largest].residual_px;
    return trusted[1];
  }
  return checks.size();
}

void log_disagreement(std::size_t view, const ExtrinsicsCheck& check) {
  log(LogLevel::Warning,
      check.missing == 0
          ? fmt::format(
                "the camera pose of image {} disagrees with it: {:.1f} px between what all images "
                "say and what it shows",
                view + 1, check.residual_px)
          : fmt::format(
                "image {} shows none of {} objects that other images show: its camera pose is "
                "wrong, or something unknown hides them",
                view + 1, check.missing));
}

}  // namespace

std::vector<ExtrinsicsCheck> extrinsics_check(const Scene& scene,
                                              std::span<const ObjectPose> objects,
                                              const ExtrinsicsCheckOptions& options) {
  std::vector<ExtrinsicsCheck> checks(scene.views.size());
  std::vector<std::size_t> trusted;
  for (std::size_t v = 0; v < scene.views.size(); ++v) trusted.push_back(v);
  while (trusted.size() >= 2 && !objects.empty()) {
    std::vector<ObjectView> views;
    for (const std::size_t v : trusted) views.push_back(scene.views[v]);
    const std::vector<ExtrinsicsCheck> found =
        check_all({scene.models, views, scene.backend}, objects, options);
    for (std::size_t i = 0; i < trusted.size(); ++i) checks[trusted[i]] = found[i];
    const std::size_t disagreeing = find_disagreeing(trusted, checks, options);
    if (disagreeing == checks.size()) break;
    checks[disagreeing].disagrees = true;
    std::erase(trusted, disagreeing);
  }
  return checks;
}

void keep_unrefuted_flags(std::span<const ExtrinsicsCheck> before, std::span<ExtrinsicsCheck> now) {
  for (std::size_t v = 0; v < before.size(); ++v)
    if (before[v].disagrees && !now[v].disagrees && now[v].objects == 0) now[v] = before[v];
}

void log_disagreements(std::span<const ExtrinsicsCheck> checks,
                       std::span<const ExtrinsicsCheck> before) {
  for (std::size_t v = 0; v < checks.size(); ++v)
    if (checks[v].disagrees && !(v < before.size() && before[v].disagrees))
      log_disagreement(v, checks[v]);
}

}  // namespace edgescout
