#include "host/baselines/candidate_scores.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>
#include <opencv2/rgbd/linemod.hpp>

#include "host/baselines/visible_points.h"
#include "kernels/error.h"
#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

constexpr int directions = 8;  // of linemod, over pi
constexpr int margin_px =
    8;  // around a template: what blur, Sobel and the vote of neighbours reach

// A template in the image, its features relative to the corner of the patch that it is compared
// with.
struct PlacedTemplate {
  cv::linemod::Template features;
  cv::Rect patch;
  int asked =
      0;  // features that the candidate has; those outside the image are not among `features`
};

// Gradients point across the edge, polarity does not count.
int label_of(double edge_rad) {
  return static_cast<int>(
             std::lround((edge_rad + 0.5 * std::numbers::pi) / (std::numbers::pi / directions))) %
         directions;
}

// Whole steps of the spread either way; rows that all begin at a multiple of 16 bytes, as linemod's
// vector code takes for granted.
cv::Size patch_size(const cv::Rect& box, int spread_px) {
  const auto whole = [](int length_px, int unit) {
    return (length_px + 2 * margin_px + unit - 1) / unit * unit;
  };
  return {whole(box.width, 16 * spread_px), whole(box.height, spread_px)};
}

PlacedTemplate place_template(std::span<const ModelPoint> points, const Se3& camera_from_object,
                              const RegisterView& view, int spread_px) {
  const Pose pose = to_pose(camera_from_object);
  PlacedTemplate placed;
  placed.asked = static_cast<int>(points.size());
  std::vector<cv::Point> places;
  for (const ModelPoint& model : points) {
    const PosedPoint<double> posed = pose_point<double>(pose, model);
    if (!can_be_seen(posed.point)) continue;
    const ProjectedEdge<double> at = project_edge(posed, view.view->intrinsics);
    if (!(at.u >= 0 && at.v >= 0 && at.u <= view.camera.width - 1 &&
          at.v <= view.camera.height - 1))
      continue;
    // linemod spreads a direction to the pixels left of and above it: half of that back, and it is
    // spread evenly.
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

// A patch of the image, its border continued where the patch reaches beyond.
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
  // A patch of the template's own size has room for it at one place only.
  cv::linemod::Detector detector(
      {cv::linemod::ColorGradient::create(options.weak_gradient, features.size(),
                                          options.weak_gradient)},
      {options.spread_px});
  detector.addSyntheticTemplate({placed.features}, "candidate");
  // linemod counts its threshold from half the largest similarity on, which is what chance gives:
  // this is none.
  constexpr float no_threshold = -100;
  std::vector<cv::linemod::Match> matches;
  detector.match({patch_of(image, placed.patch)}, no_threshold, matches);
  check(matches.size() <= 1, "line2d: more than one place");
  // It adds half a per cent, as if to round.
  return matches.empty() ? 0
                         : (matches[0].similarity - 0.5) * double(features.size()) / placed.asked;
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

std::vector<double> line2d_scores(std::span<const EdgeModel> models,
                                  std::span<const Candidate> candidates, const RegisterView& view,
                                  Backend& backend, const Line2dOptions& options) {
  options.validate();
  check(view.image != nullptr, "line2d: a view without its image");
  cv::Mat image;  // linemod takes colour
  cv::cvtColor(cv::Mat(view.image->height, view.image->width, CV_8UC1,
                       const_cast<std::uint8_t*>(view.image->pixels.data())),
               image, cv::COLOR_GRAY2BGR);
  std::vector<double> scores;
  for (const std::vector<ModelPoint>& points :
       visible_points(models, candidates, view, backend, options.visibility))
    scores.push_back(similarity(
        place_template(thinned(points, options.features),
                       candidates[scores.size()].camera_from_object, view, options.spread_px),
        image, options));
  return scores;
}

}  // namespace edgescout
