#include "host/baselines/candidate_scores.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>
#include <opencv2/rgbd/linemod.hpp>

#include "host/core/thinned.h"
#include "host/register/d2co.h"
#include "host/register/visible_in_views.h"
#include "kernels/error.h"
#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

constexpr int directions = 8;  // of linemod, over pi
constexpr int margin_px = 8;   // around a template: the reach of blur, Sobel and neighbours' votes

// A template and the patch of the image that it is compared with. Features are relative to the
// patch's corner.
struct PlacedTemplate {
  cv::linemod::Template features;  // inside the image
  cv::Rect patch;
  int feature_count = 0;  // inside the image or not
};

// Gradients are perpendicular to the edge. Polarity does not count.
int label_of(double edge_rad) {
  return static_cast<int>(
             std::lround((edge_rad + 0.5 * std::numbers::pi) / (std::numbers::pi / directions))) %
         directions;
}

// Both sides are multiples of the spread. Rows begin at multiples of 16 bytes, which linemod's
// vector code requires.
cv::Size patch_size(const cv::Rect& box, int spread_px) {
  const auto whole = [](int length_px, int unit) {
    return (length_px + 2 * margin_px + unit - 1) / unit * unit;
  };
  return {whole(box.width, 16 * spread_px), whole(box.height, spread_px)};
}

PlacedTemplate place_template(std::span<const ModelPoint> points, const Se3& camera_from_object,
                              const ObjectView& view, int spread_px) {
  const Pose pose = to_pose(camera_from_object);
  PlacedTemplate placed;
  placed.feature_count = static_cast<int>(points.size());
  std::vector<cv::Point> places;
  for (const ModelPoint& model : points) {
    const PosedPoint<double> posed = pose_point<double>(pose, model);
    if (!can_be_seen(posed.point)) continue;
    const ProjectedEdge<double> at = project_edge(posed, view.tensor->intrinsics);
    if (!(at.u >= 0 && at.v >= 0 && at.u <= view.camera.width - 1 &&
          at.v <= view.camera.height - 1))
      continue;
    // linemod spreads a direction to the pixels left of and above it. A shift back by half of the
    // spread makes that even.
    const cv::Point place(int(std::lround(at.u)) - spread_px / 2,
                          int(std::lround(at.v)) - spread_px / 2);
    places.push_back(place);
    placed.features.features.emplace_back(place.x, place.y, label_of(orientation(at.dx, at.dy)));
  }
  if (places.empty()) return placed;
  const cv::Rect box = cv::boundingRect(places);
  placed.patch = {box.tl() - cv::Point(margin_px, margin_px), patch_size(box, spread_px)};
  for (cv::linemod::Feature& feature : placed.features.features)
    feature.x -= placed.patch.x, feature.y -= placed.patch.y;
  placed.features.width = placed.patch.width;
  placed.features.height = placed.patch.height;
  placed.features.pyramid_level = 0;
  return placed;
}

// A patch of the image. Beyond the image its border is repeated.
cv::Mat patch_of(const cv::Mat& image, const cv::Rect& patch) {
  const cv::Rect inside = patch & cv::Rect(0, 0, image.cols, image.rows);
  cv::Mat filled;
  cv::copyMakeBorder(image(inside), filled, inside.y - patch.y, patch.br().y - inside.br().y,
                     inside.x - patch.x, patch.br().x - inside.br().x, cv::BORDER_REPLICATE);
  return filled;
}

double similarity(const PlacedTemplate& placed, const cv::Mat& image,
                  const Line2dOptions& options) {
  const std::vector<cv::linemod::Feature>& features = placed.features.features;
  if (features.empty()) return 0;
  // A patch of the template's own size holds it at one place only.
  cv::linemod::Detector detector(
      {cv::linemod::ColorGradient::create(options.weak_gradient, features.size(),
                                          options.weak_gradient)},
      {options.spread_px});
  detector.addSyntheticTemplate({placed.features}, "candidate");
  // linemod counts its threshold from half the largest similarity on. This value accepts all.
  constexpr float no_threshold = -100;
  std::vector<cv::linemod::Match> matches;
  detector.match({patch_of(image, placed.patch)}, no_threshold, matches);
  check(matches.size() <= 1, "line2d: more than one place");
  // linemod adds half a per cent, as if to round.
  return matches.empty()
             ? 0
             : (matches[0].similarity - 0.5) * double(features.size()) / placed.feature_count;
}

}  // namespace

void Line2dOptions::validate() const {
  const auto refuse = [](const char* field, double found, const char* bound) {
    throw InputError("options", std::string("line2d.") + field, std::to_string(found), bound);
  };
  if (features < 1 || features > 63) refuse("features", features, "a number in [1, 63]");
  if (spread_px < 1 || spread_px > 15 || spread_px % 2 == 0)
    refuse("spread_px", spread_px, "an odd number in [1, 15]");
  if (!(weak_gradient >= 0)) refuse("weak_gradient", weak_gradient, "a gradient of 0 or more");
}

std::vector<double> line2d_scores(const Scene& scene, std::span<const ObjectPose> candidates,
                                  const Line2dOptions& options) {
  options.validate();
  check(scene.views.size() == 1, "line2d: exactly one view");
  const ObjectView& view = scene.views[0];
  check(view.image != nullptr, "line2d: a view without its image");
  cv::Mat image;  // linemod takes colour
  cv::cvtColor(cv::Mat(view.image->height, view.image->width, CV_8UC1,
                       const_cast<std::uint8_t*>(view.image->pixels.data())),
               image, cv::COLOR_GRAY2BGR);
  const Grid<std::vector<ModelPoint>> visible =
      visible_points(scene, candidates, options.visibility);
  std::vector<double> scores;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Se3 camera_from_object = view.camera_from_world * candidates[i].world_from_object;
    const std::vector<ModelPoint> points = thinned(visible(i, 0), options.features);
    scores.push_back(similarity(place_template(points, camera_from_object, view, options.spread_px),
                                image, options));
  }
  return scores;
}

}  // namespace edgescout
