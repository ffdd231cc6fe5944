#include "host/track/edge_follower.h"

#include "host/core/thinned.h"
#include "host/model/visible_edges.h"
#include "host/register/depth_evidence.h"
#include "host/register/measured_depth.h"
#include "host/register/occluders.h"
#include "host/track/reduced_image.h"

namespace edgescout {

namespace {

constexpr double near_reach_px = 4;
constexpr int most_surface_samples = 200;
// Of a pose from its start. Edges that come before the object turn its pose further: a bar did so
// by 0.3 to 0.9 rad, where 815 right poses of three rendered parts were turned by 0.24 rad at most.
constexpr double most_turn_rad = 0.25;

// Whether the object turned so far, seen from the camera, that other edges may be visible.
bool has_turned(const Se3& from, const Se3& to) {
  constexpr double most_rad = 0.02;
  return angle_between_rad(from, to) > most_rad;
}

// A round moves a pose by a few hundredths of its distance and a tenth of a radian. Without a bound
// small objects go off along the line of sight, where edges hardly determine them.
PosePrior near(const Se3& pose) {
  constexpr double sigma_of_distance = 0.02, sigma_rad = 0.1;
  return {pose, sigma_of_distance * pose.translation_m.norm(), sigma_rad};
}

}  // namespace

bool is_on_object(const NormalFit& fit, const TrackOptions& options) {
  return fit.above_chance() >= options.tracked_above_chance && !is_contradicted(fit.depth);
}

bool is_better(const NormalFit& fit, const NormalFit& than) {
  const bool is_excluded = is_contradicted(fit.depth),
             than_is_excluded = is_contradicted(than.depth);
  if (is_excluded != than_is_excluded) return than_is_excluded;
  return fit.above_chance() > than.above_chance();
}

VisibleObject EdgeFollower::visible_at(const SearchedImage& image,
                                       const Se3& camera_from_object) const {
  VisibilityOptions visibility;
  visibility.depth_map_size_px = 96;
  VisibleObject visible;
  VisibleSurfaces surfaces;
  std::vector<ModelPoint> edges =
      std::move(visible_edges(model_, {&camera_from_object, 1}, backend_, visibility, nullptr,
                              image.depth ? &surfaces : nullptr)[0]);
  const double tolerance_m = occlusion_tolerance_m(model_);
  if (occluders_) remove_hidden(edges, *occluders_, camera_from_object, tolerance_m);
  if (image.depth) {
    remove_hidden(edges, *image.depth, image.ideal, camera_from_object, tolerance_m);
    visible.surface.emplace(*image.depth, image.ideal, model_,
                            thinned(surfaces[0], most_surface_samples), backend_.threads());
  }
  visible.edges = thinned(edges, options_.max_points);
  return visible;
}

NormalSearch EdgeFollower::search(const SearchedImage& image, const Se3& pose,
                                  std::span<const ModelPoint> points, const SeenObject* earlier,
                                  double reach_px) const {
  std::vector<float> expected;
  if (earlier) expected = contrasts_at(earlier->image, earlier->camera_from_object, points);
  return search_normals(image, pose, points, expected, {reach_px, float(options_.min_contrast)});
}

FollowedPose EdgeFollower::follow_near(const SearchedImage& image, const Se3& start,
                                       const SeenObject* earlier) const {
  VisibleObject seen = visible_at(image, start);
  const auto fitted = [&](const NormalSearch& lines, const Se3& pose, const FitRound& round) {
    return fit_to_edges(lines, image.ideal, pose, round, near(pose), seen.measured());
  };
  NormalSearch lines = search(image, start, seen.edges, earlier, options_.search_px);
  Se3 pose = fitted(lines, start, {0.5 * options_.search_px, 5, 10});
  pose = fitted(lines, pose, {1.5, 5, 5});
  if (has_turned(start, pose)) seen = visible_at(image, pose);
  lines = search(image, pose, seen.edges, earlier, near_reach_px);
  pose = fitted(lines, pose, {1.5, 4, 3});
  pose = fitted(lines, pose, {0.8, 4, 3});
  lines = search(image, pose, seen.edges, earlier, options_.search_px);
  return {pose, measure_fit(lines, image.ideal, pose, seen.measured())};
}

Se3 EdgeFollower::follow_far(const SearchedImage& half, const Se3& start,
                             const SeenObject* earlier) const {
  const VisibleObject seen = visible_at(half, start);
  const NormalSearch lines = search(half, start, seen.edges, earlier, options_.far_search_px);
  const Se3 shifted = shifted_to_edges(lines, half.ideal, start);
  return fit_to_edges(lines, half.ideal, shifted, {6, 6, 20}, near(shifted), seen.measured());
}

NormalFit EdgeFollower::measure(const SearchedImage& image, const Se3& camera_from_object,
                                const SeenObject* earlier) const {
  const VisibleObject seen = visible_at(image, camera_from_object);
  return measure_fit(search(image, camera_from_object, seen.edges, earlier, options_.search_px),
                     image.ideal, camera_from_object, seen.measured());
}

FollowedPose EdgeFollower::follow(const SearchedImage& image, std::span<const Se3> starts,
                                  const SeenObject* earlier) const {
  FollowedPose best;
  // `near` is the start or what was found from it.
  const auto is_tracked = [&](const Se3& start, const Se3& near) {
    FollowedPose found = follow_near(image, near, earlier);
    if (angle_between_rad(start, found.camera_from_object) > most_turn_rad)
      found = {start, measure(image, start, earlier)};
    if (best.fit.points == 0 || is_better(found.fit, best.fit)) best = found;
    return is_on_object(best.fit, options_);
  };
  for (const Se3& start : starts)
    if (is_tracked(start, start)) return best;
  const Image half = reduced(*image.image, 2);
  const SearchedImage coarse{&half, image.camera, image.ideal, 2, image.depth};
  for (const Se3& start : starts)
    if (is_tracked(start, follow_far(coarse, start, earlier))) return best;
  return best;
}

}  // namespace edgescout
