#include "host/detect/joint_scan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/detect/helping_views.h"
#include "host/detect/template_projection.h"
#include "host/register/occluders.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int STEPS = 5;               // distances tried, evenly over the gap between templates
constexpr std::size_t AT_ONCE = 4096;  // hits: 10 MB of points
constexpr double CHANCE_PX = TEMPLATE_SCORE_OUTSIDE / 4.0;

// A viewpoint's points, and which of a pose's equal ones a camera sees them at.
struct SeenTemplate {
  const ThinnedView* view = nullptr;
  const Se3* symmetry = nullptr;
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
          best = {&views_[v], &symmetry};
        }
    }
    return best;
  }

 private:
  const TemplateSet& set_;
  std::vector<ThinnedView> views_;
  std::vector<Eigen::Vector3d> towards_camera_;
};

// What a view says of a hit: `rank`, as ScanHit's, of what known objects leave of it, and how much that is.
struct Say {
  double rank = 1, weight = 1;
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

// What this view says of the poses, in the frame of its camera: STEPS of every hit, side by side.
std::vector<Say> says_of(const Observation& view, const TemplateSet& set, const NearestViews& templates,
                         std::span<const Se3> camera_from_object, Backend& backend,
                         const ScanOptions& options) {
  const auto& salient = *view.salient;
  const std::size_t width = std::size_t(options.points);
  std::vector<TemplatePoint> points(camera_from_object.size() * width);
  std::vector<TemplateJob> jobs(camera_from_object.size());
  std::vector<int> shown(jobs.size());  // points; none: chance, or hidden
  std::vector<Say> says(jobs.size());
  const Hiding hiding(view, occlusion_tolerance_m(set.model));
  const auto look = [&](std::size_t j, const SeenTemplate& seen) {
    const Pose pose = to_pose(camera_from_object[j] * *seen.symmetry);
    TemplatePoint* to = points.data() + j * width;
    if (seen.view->count() > 0 && seen.view->project(pose, salient.intrinsics, 0, 0, salient.shape.bins,
                                                     float(0.1 * set.model.radius_m), to)) {
      shown[j] = hiding.any() ? keep_unhidden(hiding, *seen.view, pose, to) : seen.view->count();
      says[j].weight = double(shown[j]) / seen.view->count();
    }
    if (shown[j] == 0) to[0] = {};  // a job needs a point; its answer is not read
    says[j].rank = std::pow((camera_from_object[j] * set.model.center_m).norm(), SCAN_SIZE_WEIGHT);
    jobs[j] = {std::uint32_t(j * width), std::uint32_t(std::max(1, shown[j])), 0, 0, 1, 1};
  };
  constexpr std::size_t chunk = 64;
  const std::size_t count = jobs.size() / STEPS;
  backend.threads().for_each((count + chunk - 1) / chunk, [&](std::size_t c) {
    for (std::size_t h = c * chunk; h < std::min(count, (c + 1) * chunk); ++h) {
      // three degrees at most between the steps, where viewpoints stand eleven apart
      const SeenTemplate seen = templates.seen_at(camera_from_object[h * STEPS + STEPS / 2]);
      for (int step = 0; step < STEPS; ++step) look(h * STEPS + std::size_t(step), seen);
    }
  });
  std::vector<TemplateHit> hits(jobs.size());
  backend.template_score(salient, points, jobs, 1, hits);
  for (std::size_t j = 0; j < jobs.size(); ++j)
    says[j].rank *= shown[j] > 0 ? hits[j].sum / (4.0 * jobs[j].point_count) : CHANCE_PX;
  return says;
}

// In place.
void judge(const TemplateSet& set, const NearestViews& templates, std::span<ScanHit> hits,
           const Observation& own, std::span<const Observation> others, Backend& backend,
           const ScanOptions& options) {
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
  for (std::size_t h = 0; h < hits.size(); ++h) {
    std::size_t best = h * STEPS;
    for (std::size_t i = best; i < (h + 1) * STEPS; ++i)
      if (sums[i] / weights[i] < sums[best] / weights[best]) best = i;
    hits[h].camera_from_object = moved[best];
    hits[h].rank = sums[best] / weights[best];
  }
}

}  // namespace

std::vector<ScanHit> judged_by_all(const TemplateSet& set, std::span<const ScanHit> hits,
                                   const Observation& own, std::span<const Observation> others,
                                   Backend& backend, const ScanOptions& options) {
  std::vector<ScanHit> judged(hits.begin(), hits.end());
  if (others.empty()) return judged;
  const NearestViews templates(set, options.points);
  for (std::size_t begin = 0; begin < judged.size(); begin += AT_ONCE)
    judge(set, templates, std::span(judged).subspan(begin, std::min(AT_ONCE, judged.size() - begin)), own,
          others, backend, options);
  return judged;
}

std::vector<ScanHit> pooled_hits(const TemplateSet& set, std::span<const Observation> images,
                                 std::span<const std::span<const ScanHit>> hits, int helping,
                                 Backend& backend, const ScanOptions& options) {
  std::vector<ScanHit> pooled;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::vector<Observation> others = all_but(images, i);
    const Se3 last_from_own =
        images.back().view.camera_from_world * inverse(images[i].view.camera_from_world);
    for (ScanHit hit :
         judged_by_all(set, hits[i], images[i], helping_views(images[i], others, std::size_t(helping)),
                       backend, options)) {
      hit.camera_from_object = last_from_own * hit.camera_from_object;
      pooled.push_back(hit);
    }
  }
  return pooled;
}

}  // namespace edgescout
