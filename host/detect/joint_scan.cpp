#include "host/detect/joint_scan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/detect/template_projection.h"
#include "host/register/occluders.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int STEPS = 5;  // distances tried, evenly over the gap between templates
constexpr double CHANCE_PX = TEMPLATE_SCORE_OUTSIDE / 4.0;

// A viewpoint's points, and the pose at which they are what a camera sees.
struct SeenTemplate {
  const ThinnedView* view = nullptr;
  Se3 camera_from_object;
};

// A template set as other views see it: the points of the viewpoint nearest to theirs. A set holds viewpoints
// modulo symmetry: the nearest may belong to another of the object's equal poses.
class NearestViews {
 public:
  NearestViews(const TemplateSet& set, int points) : set_(set) {
    for (const TemplateView& view : set.views) {
      views_.emplace_back(view, points);
      towards_camera_.push_back(view.camera_from_object.inverse() * -Eigen::Vector3d::UnitZ());
    }
  }
  SeenTemplate seen_at(const Se3& camera_from_object) const {
    SeenTemplate best;
    double largest = -2;
    for (const Se3& symmetry : set_.symmetries.discrete) {
      const Se3 equal = camera_from_object * symmetry;
      const Eigen::Vector3d to_camera = (inverse(equal).translation_m - set_.model.center_m).normalized();
      for (std::size_t v = 0; v < views_.size(); ++v)
        if (const double cosine = towards_camera_[v].dot(to_camera); cosine > largest) {
          largest = cosine;
          best = {&views_[v], equal};
        }
    }
    return best;
  }

 private:
  const TemplateSet& set_;
  std::vector<ThinnedView> views_;
  std::vector<Eigen::Vector3d> towards_camera_;
};

double rank_of(double mean_px, double distance_m) { return mean_px * std::pow(distance_m, SCAN_SIZE_WEIGHT); }

// What a view says of a hit: `rank`, as ScanHit's, of what known objects leave of it, and how much that is.
struct Say {
  double rank = 0, weight = 1;
};

// Known objects before the points of one tensor's pixels. One pixel of their map is looked at, where
// Occluders::hide asks nine: a rank over sixty points bears one that falls on the other side.
class Hiding {
 public:
  Hiding(const Observation& view, double tolerance_m)
      : occluders_(view.view.occluders.get()), tolerance_m_(float(tolerance_m)) {
    if (occluders_) scale_ = float(occluders_->camera.width) / float(view.salient->shape.width);
  }
  bool any() const { return occluders_ != nullptr; }
  bool hides(const TemplatePoint& point, float depth_m) const {
    const int x = int((point.dx_px + 0.5f) * scale_), y = int((point.dy_px + 0.5f) * scale_);
    if (point.dx_px < 0 || point.dy_px < 0 || x >= occluders_->camera.width || y >= occluders_->camera.height)
      return false;
    return occluders_->depth_m[std::size_t(y) * std::size_t(occluders_->camera.width) + std::size_t(x)] <
           depth_m - tolerance_m_;
  }

 private:
  const Occluders* occluders_;
  float scale_ = 1, tolerance_m_;
};

// Moves what is not hidden to the front; how many they are.
int keep_unhidden(const Hiding& hiding, const ThinnedView& seen, const Pose& camera_from_object,
                  TemplatePoint* points) {
  int kept = 0;
  for (int i = 0; i < seen.count(); ++i)
    if (!hiding.hides(points[i], seen.depth_m(camera_from_object, i))) points[kept++] = points[i];
  return kept;
}

// What this view says of the poses, in the frame of its camera.
std::vector<Say> says_of(const Observation& view, const TemplateSet& set, const NearestViews& templates,
                         std::span<const Se3> camera_from_object, Backend& backend,
                         const ScanOptions& options) {
  const auto& salient = *view.salient;
  const std::size_t width = std::size_t(options.points);
  std::vector<TemplatePoint> points(camera_from_object.size() * width);
  std::vector<TemplateJob> jobs(camera_from_object.size());
  std::vector<int> shown(jobs.size());  // points; none: chance, or hidden
  std::vector<double> weights(jobs.size(), 1);
  const Hiding hiding(view, occlusion_tolerance_m(set.model));
  constexpr std::size_t chunk = 256;
  backend.threads().for_each((jobs.size() + chunk - 1) / chunk, [&](std::size_t c) {
    for (std::size_t j = c * chunk; j < std::min(jobs.size(), (c + 1) * chunk); ++j) {
      const auto [seen, pose] = templates.seen_at(camera_from_object[j]);
      TemplatePoint* to = points.data() + j * width;
      if (seen->count() > 0 && seen->project(to_pose(pose), salient.intrinsics, 0, 0, salient.shape.bins,
                                             float(0.1 * set.model.radius_m), to)) {
        shown[j] = hiding.any() ? keep_unhidden(hiding, *seen, to_pose(pose), to) : seen->count();
        weights[j] = double(shown[j]) / seen->count();
      }
      if (shown[j] == 0) to[0] = {};  // a job needs a point; its answer is not read
      jobs[j] = {std::uint32_t(j * width), std::uint32_t(std::max(1, shown[j])), 0, 0, 1, 1};
    }
  });
  std::vector<TemplateHit> hits(jobs.size());
  backend.template_score(salient, points, jobs, 1, hits);
  std::vector<Say> says;
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    const double mean_px = shown[j] > 0 ? hits[j].sum / (4.0 * jobs[j].point_count) : CHANCE_PX;
    says.push_back({rank_of(mean_px, (camera_from_object[j] * set.model.center_m).norm()), weights[j]});
  }
  return says;
}

}  // namespace

std::vector<ScanHit> judged_by_all(const TemplateSet& set, std::span<const ScanHit> hits,
                                   const Observation& own, std::span<const Observation> others,
                                   Backend& backend, const ScanOptions& options) {
  std::vector<ScanHit> judged(hits.begin(), hits.end());
  if (others.empty()) return judged;
  const NearestViews templates(set, options.points);
  std::vector<Se3> moved;
  for (const ScanHit& hit : hits)
    for (int step = 0; step < STEPS; ++step) {
      const double further = (set.options.distance_ratio - 1) * (step / double(STEPS - 1) - 0.5);
      moved.push_back(
          {hit.camera_from_object.rotation,
           hit.camera_from_object.translation_m + further * (hit.camera_from_object * set.model.center_m)});
    }
  std::vector<double> sums(moved.size()), weights(moved.size(), 1);  // its own view's say is whole
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = hits[i / STEPS].rank;
  std::vector<Se3> poses(moved.size());
  for (const Observation& other : others) {
    const Se3 other_from_own = other.view.camera_from_world * inverse(own.view.camera_from_world);
    std::ranges::transform(moved, poses.begin(), [&](const Se3& pose) { return other_from_own * pose; });
    const std::vector<Say> says = says_of(other, set, templates, poses, backend, options);
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] += says[i].weight * says[i].rank, weights[i] += says[i].weight;
  }
  for (std::size_t h = 0; h < judged.size(); ++h) {
    std::size_t best = h * STEPS;
    for (std::size_t i = best; i < (h + 1) * STEPS; ++i)
      if (sums[i] / weights[i] < sums[best] / weights[best]) best = i;
    judged[h].camera_from_object = moved[best];
    judged[h].rank = sums[best] / weights[best];
  }
  return judged;
}

}  // namespace edgescout
