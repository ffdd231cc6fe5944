#include "host/track/edge_follower.h"

#include <opencv2/imgproc.hpp>

#include "host/core/thinned.h"
#include "host/model/visible_edges.h"
#include "host/register/occluders.h"

namespace edgescout {

namespace {

constexpr double near_reach_px = 4;

// Both share one size: odd rows and columns at the end are left out.
Image half_of(const Image& image) {
  Image half{image.width / 2, image.height / 2, {}};
  half.pixels.resize(std::size_t(half.width) * half.height);
  const cv::Mat all(image.height, image.width, CV_8U,
                    const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat into(half.height, half.width, CV_8U, half.pixels.data());
  cv::resize(all(cv::Rect(0, 0, 2 * half.width, 2 * half.height)), into, into.size(), 0, 0,
             cv::INTER_AREA);
  return half;
}

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

std::vector<ModelPoint> EdgeFollower::visible_points(const Se3& camera_from_object) const {
  VisibilityOptions visibility;
  visibility.depth_map_size_px = 96;
  std::vector<ModelPoint> points =
      std::move(visible_edges(model_, {&camera_from_object, 1}, backend_, visibility)[0]);
  if (occluders_)
    remove_hidden(points, *occluders_, camera_from_object, occlusion_tolerance_m(model_));
  return thinned(points, options_.max_points);
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
  std::vector<ModelPoint> points = visible_points(start);
  NormalSearch lines = search(image, start, points, earlier, options_.search_px);
  Se3 pose = fit_to_edges(lines, image.ideal, start, 0.5 * options_.search_px, 5, near(start));
  pose = fit_to_edges(lines, image.ideal, pose, 1.5, 5, near(pose));
  if (has_turned(start, pose)) points = visible_points(pose);
  lines = search(image, pose, points, earlier, near_reach_px);
  pose = fit_to_edges(lines, image.ideal, pose, 1.5, 4, near(pose));
  pose = fit_to_edges(lines, image.ideal, pose, 0.8, 4, near(pose));
  lines = search(image, pose, points, earlier, options_.search_px);
  return {pose, measure_fit(lines, image.ideal, pose)};
}

Se3 EdgeFollower::follow_far(const SearchedImage& half, const Se3& start,
                             const SeenObject* earlier) const {
  const std::vector<ModelPoint> points = visible_points(start);
  const NormalSearch lines = search(half, start, points, earlier, options_.far_search_px);
  const Se3 shifted = shifted_to_edges(lines, half.ideal, start);
  return fit_to_edges(lines, half.ideal, shifted, 6, 6, near(shifted));
}

NormalFit EdgeFollower::measure(const SearchedImage& image, const Se3& camera_from_object,
                                const SeenObject* earlier) const {
  const std::vector<ModelPoint> points = visible_points(camera_from_object);
  return measure_fit(search(image, camera_from_object, points, earlier, options_.search_px),
                     image.ideal, camera_from_object);
}

FollowedPose EdgeFollower::follow(const SearchedImage& image, std::span<const Se3> starts,
                                  const SeenObject* earlier) const {
  FollowedPose best;
  const auto is_tracked = [&](const Se3& start) {
    const FollowedPose found = follow_near(image, start, earlier);
    if (best.fit.points == 0 || found.fit.above_chance() > best.fit.above_chance()) best = found;
    return best.fit.above_chance() >= options_.tracked_above_chance;
  };
  for (const Se3& start : starts)
    if (is_tracked(start)) return best;
  const Image half = half_of(*image.image);
  const SearchedImage reduced{&half, image.camera, image.ideal, 2};
  for (const Se3& start : starts)
    if (is_tracked(follow_far(reduced, start, earlier))) return best;
  return best;
}

}  // namespace edgescout
