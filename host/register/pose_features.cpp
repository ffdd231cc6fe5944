#include "host/register/pose_features.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/register/odds_weights.h"
#include "host/register/visible_in_views.h"
#include "kernels/error.h"
#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

// A raster point stands for raster_step of edge, seen at an angle; end-on edges are short in the
// image.
double length_in_image_px(const EdgeModel& model, const Se3& camera_from_object,
                          const BackendView& view, std::span<const ModelPoint> points) {
  const Pose pose = to_pose(camera_from_object);
  double length = 0;
  for (const ModelPoint& point : points) {
    const PosedPoint<float> posed = pose_point<float>(pose, point);
    if (!can_be_seen(posed.point)) continue;
    const ProjectedEdge<float> edge = project_edge(posed, view.intrinsics);
    if (!on_image(edge, view.shape.width, view.shape.height)) continue;
    length += std::hypot(edge.dx, edge.dy) / (posed.point.z * posed.point.z);
  }
  return length * model.raster_step_m;
}

constexpr int BACKGROUND_COPIES = 8;  // directions in which a pose is moved aside
constexpr double BACKGROUND_SHIFT =
    0.05;  // of the diameter: further than edges are wide, in the same surroundings
constexpr int BACKGROUND_POINTS = 150;  // enough for a mean

// Poses with their points, as the kernel takes them.
struct Problems {
  std::vector<ModelPoint> points;
  std::vector<PoseProblem> list;

  void add(const Se3& camera_from_object, std::size_t view, const std::vector<ModelPoint>& seen) {
    add_one(camera_from_object, view, seen.size());
    points.insert(points.end(), seen.begin(), seen.end());
  }

  // Those beside it, moved along the image plane.
  void add_background(const Se3& camera_from_object, double diameter_m, std::size_t view,
                      const std::vector<ModelPoint>& seen) {
    const std::vector<ModelPoint> some = thinned(seen, BACKGROUND_POINTS);
    for (int i = 0; i < BACKGROUND_COPIES; ++i) {
      const double angle = 2 * std::numbers::pi * i / BACKGROUND_COPIES;
      Se3 beside = camera_from_object;
      beside.translation_m +=
          BACKGROUND_SHIFT * diameter_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
      add_one(beside, view, some.size());
    }
    points.insert(points.end(), some.begin(), some.end());
  }

 private:
  void add_one(const Se3& camera_from_object, std::size_t view, std::size_t count) {
    list.push_back({to_pose(camera_from_object), std::uint32_t(points.size()), std::uint32_t(count),
                    std::uint32_t(view)});
  }
};

double standard_errors(const PoseFeatures& features, double of_psi) {
  constexpr double spread = 0.308;      // of |cos| of unrelated directions
  constexpr double independent_px = 5;  // neighbouring edge points agree or not together
  return of_psi / spread * std::sqrt(features.length_px / independent_px);
}

double mean_psi(std::span<const PoseScore> scores) {
  double sum = 0, points = 0;
  for (const PoseScore& score : scores) sum += score.psi * score.points, points += score.points;
  return points > 0 ? sum / points : 0;
}

std::vector<PoseFeatures> features_by_view(std::span<const EdgeModel> models,
                                           std::span<const ObjectPose> poses,
                                           std::span<const RegisterView> views, Backend& backend,
                                           const PoseScoreOptions& options,
                                           const VisibilityOptions& visibility,
                                           bool with_background) {
  std::vector<PoseFeatures> features(poses.size() * views.size());
  Problems problems;
  const std::size_t of_one = with_background ? 1 + BACKGROUND_COPIES : 1;
  for (const VisibleInView& seen : visible_in_views(models, poses, views, backend, visibility)) {
    const std::size_t slot = problems.list.size() / of_one, v = slot % views.size();
    const ObjectPose& pose = poses[slot / views.size()];
    const Se3 camera_from_object = views[v].camera_from_world * pose.world_from_object;
    features[slot].visible = double(seen.unoccluded);
    const EdgeModel& model = models[std::size_t(pose.object)];
    features[slot].length_px =
        length_in_image_px(model, camera_from_object, *views[v].view, seen.points);
    problems.add(camera_from_object, v, seen.points);
    if (with_background)
      problems.add_background(camera_from_object, model.mesh.diameter_m, v, seen.points);
  }
  std::vector<ViewHandle> handles;
  for (const RegisterView& view : views) handles.push_back(view.view);
  std::vector<PoseScore> scores(problems.list.size());
  backend.pose_score(handles, problems.points, problems.list, options, scores);
  for (std::size_t i = 0; i < features.size(); ++i) {
    PoseFeatures& f = features[i];
    const PoseScore* of_pose = &scores[i * of_one];
    f.psi = of_pose->psi;
    f.background_psi = mean_psi({of_pose + 1, of_one - 1});
    f.mean_px = of_pose->points > 0 ? of_pose->mean_px : options.cap_px;
    f.matched = of_pose->matched;
    f.points = of_pose->points;
    f.in_image = f.visible > 0 ? f.points / f.visible : 0;
  }
  const std::vector<Shading> shadings = shading(models, poses, views, backend);
  for (std::size_t i = 0; i < features.size(); ++i) features[i].shading = shadings[i];
  return features;
}

}  // namespace

double psi_z_score(const PoseFeatures& features) {
  return standard_errors(features, features.psi - CHANCE_PSI);
}

double background_psi_z_score(const PoseFeatures& features) {
  return standard_errors(features, features.psi - features.background_psi);
}

double weighted_odds(const PoseFeatures& features, const OddsWeights& w) {
  constexpr double min_psi_z_score = 0.5;  // below that all poses are as bad
  return w.bias +
         w.by_log_psi_z_score * std::log(std::max(psi_z_score(features), min_psi_z_score)) +
         w.by_mean_px * features.mean_px +
         w.by_unexplained_grey * unexplained_grey(features.shading);
}

double log_odds(const PoseFeatures& features) {
  return weighted_odds(features, {-5.036, 4.105, -0.382, -6.012});
}

std::vector<PoseFeatures> pose_features_by_view(std::span<const EdgeModel> models,
                                                std::span<const ObjectPose> poses,
                                                std::span<const RegisterView> views,
                                                Backend& backend, const PoseScoreOptions& options,
                                                const VisibilityOptions& visibility) {
  return features_by_view(models, poses, views, backend, options, visibility, views.size() > 1);
}

PoseFeatures pool_over_views(std::span<const PoseFeatures> by_view) {
  check(!by_view.empty(), "together: features of at least one view");
  PoseFeatures sum;
  for (const PoseFeatures& f : by_view) {
    sum.psi += f.psi * f.points;
    sum.background_psi += f.background_psi * f.points;
    sum.mean_px += f.mean_px * f.points;
    sum.matched += f.matched * f.points;
    sum.points += f.points;
    sum.length_px += f.length_px;
    sum.visible += f.visible;
    add(sum.shading, f.shading);
  }
  if (sum.points > 0) {
    sum.psi /= sum.points, sum.background_psi /= sum.points, sum.mean_px /= sum.points,
        sum.matched /= sum.points;
  } else {
    sum.mean_px = by_view[0].mean_px;
  }
  if (sum.visible > 0) sum.in_image = sum.points / sum.visible;
  return sum;
}

std::vector<PoseFeatures> pose_features(std::span<const EdgeModel> models,
                                        std::span<const ObjectPose> poses,
                                        std::span<const RegisterView> views, Backend& backend,
                                        const PoseScoreOptions& options,
                                        const VisibilityOptions& visibility) {
  const std::vector<PoseFeatures> by_view =
      features_by_view(models, poses, views, backend, options, visibility, false);
  std::vector<PoseFeatures> features;
  for (std::size_t p = 0; p < poses.size(); ++p)
    features.push_back(pool_over_views(std::span(by_view).subspan(p * views.size(), views.size())));
  return features;
}

}  // namespace edgescout
