#include "host/detect/rescore_in_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/detect/nearest_viewpoint.h"
#include "host/detect/support_views.h"
#include "host/detect/template_projection.h"
#include "host/register/occluders.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr std::size_t AT_ONCE = 4096;  // hits: 10 MB of points
constexpr double CHANCE_PX = TEMPLATE_SCORE_OUTSIDE / 4.0;

// How closely a hit is looked at: points of its template, and distances tried, evenly over the gap
// between templates.
struct Care {
  int points, steps;
  double further(int step, double distance_ratio) const {
    return (distance_ratio - 1) * (step / double(steps - 1) - 0.5);
  }
};
Care quick(const ScanOptions& options) { return {std::max(1, options.points / 3), 3}; }
Care careful(const ScanOptions& options) { return {options.points, 5}; }

// A viewpoint's points, and which of a pose's equal ones a camera sees them at.
struct SeenTemplate {
  const ThinnedView* view = nullptr;
  const Se3* symmetry = nullptr;
};

// A template set as other views see it.
class NearestViews {
 public:
  NearestViews(const TemplateSet& set, int points) : nearest_(set) {
    for (const TemplateView& view : set.views) views_.emplace_back(view, points);
  }
  SeenTemplate seen_at(const Se3& camera_from_object) const {
    const auto [view, symmetry] = nearest_.of(camera_from_object);
    return {&views_[view], symmetry};
  }

 private:
  NearestViewpoint nearest_;
  std::vector<ThinnedView> views_;
};

// A hit in the camera frame of one of the images, and the way it is moved along.
struct MovedHit {
  Se3 camera_from_object;
  Eigen::Vector3d towards_m;  // from its own camera to its middle
  Se3 at(double further) const {
    return {camera_from_object.rotation, camera_from_object.translation_m + further * towards_m};
  }
};

// What a view says of a hit: `rank`, as ScanHit's, of what known objects leave of it, and how much
// that is.
struct Say {
  double rank = 1, weight = 1;
};

// Known objects before the points of one tensor's pixels. One pixel of their map is looked at,
// where Occluders::hide asks nine: a rank over sixty points bears one that falls on the other side.
class Hiding {
 public:
  Hiding(const Observation& view, double tolerance_m)
      : occluders_(view.view.occluders.get()), tolerance_m_(float(tolerance_m)) {
    if (occluders_) scale_ = float(occluders_->camera.width) / float(view.salient->shape.width);
  }
  bool any() const { return occluders_ != nullptr; }
  bool hides(const TemplatePoint& point, float depth_m) const {
    const int x = int((point.dx_px + 0.5f) * scale_), y = int((point.dy_px + 0.5f) * scale_);
    if (point.dx_px < 0 || point.dy_px < 0 || x >= occluders_->camera.width ||
        y >= occluders_->camera.height)
      return false;
    return occluders_
               ->depth_m[std::size_t(y) * std::size_t(occluders_->camera.width) + std::size_t(x)] <
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

Pose moved_to(Pose pose, const Eigen::Vector3d& translation_m) {
  for (int i = 0; i < 3; ++i) pose.m[4 * i + 3] = float(translation_m[i]);
  return pose;
}

// What this view says of the hits, in the frame of its camera: all steps of every one, side by
// side.
std::vector<Say> votes_of(const Observation& view, const TemplateSet& set,
                          const NearestViews& templates, std::span<const MovedHit> moved,
                          Backend& backend, const Care& care) {
  const auto& salient = *view.salient;
  const std::size_t width = std::size_t(care.points), steps = std::size_t(care.steps),
                    count = moved.size() * steps;
  std::vector<TemplatePoint> points(count * width);
  std::vector<TemplateJob> jobs(count);
  std::vector<int> shown(count);  // points; none: chance, or hidden
  std::vector<Say> says(count);
  const Hiding hiding(view, occlusion_tolerance_m(set.model));
  const auto look = [&](std::size_t j, const Pose& pose, const ThinnedView& seen) {
    TemplatePoint* to = points.data() + j * width;
    if (seen.count() > 0 && seen.project(pose, salient.intrinsics, 0, 0, salient.shape.bins,
                                         float(0.1 * set.model.radius_m), to)) {
      shown[j] = hiding.any() ? keep_unhidden(hiding, seen, pose, to) : seen.count();
      says[j].weight = double(shown[j]) / seen.count();
    }
    if (shown[j] == 0) to[0] = {};  // a job needs a point; its answer is not read
    jobs[j] = {std::uint32_t(j * width), std::uint32_t(std::max(1, shown[j])), 0, 0, 1, 1};
  };
  const auto look_all_steps = [&](std::size_t h) {
    // at the default distances three degrees at most between the steps, where viewpoints stand
    // eleven apart
    const SeenTemplate seen = templates.seen_at(moved[h].camera_from_object);
    const Pose turned = to_pose(moved[h].camera_from_object * *seen.symmetry);
    const Eigen::Vector3d middle_m = moved[h].camera_from_object.rotation * set.model.center_m,
                          place_m =
                              moved[h].camera_from_object.rotation * seen.symmetry->translation_m;
    // one weight for all steps, or where nothing shows the step nearest to this camera would fit
    // best
    const double size_weight =
        scan_size_weight((moved[h].camera_from_object.translation_m + middle_m).norm());
    for (std::size_t step = 0; step < steps; ++step) {
      const Eigen::Vector3d at_m =
          moved[h].at(care.further(int(step), set.options.distance_ratio)).translation_m;
      const std::size_t j = h * steps + step;
      says[j].rank = size_weight;
      look(j, moved_to(turned, at_m + place_m), *seen.view);
    }
  };
  constexpr std::size_t chunk = 64;
  backend.threads().for_each((moved.size() + chunk - 1) / chunk, [&](std::size_t c) {
    for (std::size_t h = c * chunk; h < std::min(moved.size(), (c + 1) * chunk); ++h)
      look_all_steps(h);
  });
  std::vector<TemplateHit> hits(count);
  backend.template_score(salient, points, jobs, 1, hits);
  for (std::size_t j = 0; j < count; ++j)
    says[j].rank *= shown[j] > 0 ? hits[j].sum / (4.0 * jobs[j].point_count) : CHANCE_PX;
  return says;
}

// In place.
void judge(const TemplateSet& set, const NearestViews& templates, std::span<ScanHit> hits,
           const Observation& own, std::span<const Observation> others, Backend& backend,
           const Care& care) {
  const std::size_t steps = std::size_t(care.steps);
  std::vector<MovedHit> moved;
  for (const ScanHit& hit : hits)
    moved.push_back({hit.camera_from_object, hit.camera_from_object * set.model.center_m});
  std::vector<double> sums(moved.size() * steps),
      weights(sums.size(), 1);  // its own view's say is whole
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = hits[i / steps].rank;
  std::vector<MovedHit> there(moved.size());
  for (const Observation& other : others) {
    const Se3 other_from_own = other.view.camera_from_world * inverse(own.view.camera_from_world);
    std::ranges::transform(moved, there.begin(), [&](const MovedHit& hit) {
      return MovedHit{other_from_own * hit.camera_from_object,
                      other_from_own.rotation * hit.towards_m};
    });
    const std::vector<Say> says = votes_of(other, set, templates, there, backend, care);
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] += says[i].weight * says[i].rank, weights[i] += says[i].weight;
  }
  for (std::size_t h = 0; h < hits.size(); ++h) {
    std::size_t best = h * steps + steps / 2;  // where it is, unless another is better
    for (std::size_t i = h * steps; i < (h + 1) * steps; ++i)
      if (sums[i] / weights[i] < sums[best] / weights[best]) best = i;
    hits[h].camera_from_object =
        moved[h].at(care.further(int(best % steps), set.options.distance_ratio));
    hits[h].rank = sums[best] / weights[best];
  }
}

// In the order given.
std::vector<ScanHit> judged(const TemplateSet& set, std::span<const ScanHit> hits,
                            const Observation& own, std::span<const Observation> others,
                            Backend& backend, const Care& care) {
  std::vector<ScanHit> judged(hits.begin(), hits.end());
  if (others.empty()) return judged;
  const NearestViews templates(set, care.points);
  for (std::size_t begin = 0; begin < judged.size(); begin += AT_ONCE)
    judge(set, templates,
          std::span(judged).subspan(begin, std::min(AT_ONCE, judged.size() - begin)), own, others,
          backend, care);
  return judged;
}

// What the hits of each image are judged by, and where they lie for the last image.
struct Judges {
  std::vector<std::vector<Observation>> others;
  std::vector<Se3> last_from_own;
  Judges(std::span<const Observation> images, int helping) {
    for (std::size_t i = 0; i < images.size(); ++i) {
      others.push_back(support_views(images[i], all_but(images, i), std::size_t(helping)));
      last_from_own.push_back(images.back().view.camera_from_world *
                              inverse(images[i].view.camera_from_world));
    }
  }
};

// The hits of each image that are among the `most` which a quick look ranks best.
std::vector<std::vector<ScanHit>> worth_judging(const TemplateSet& set,
                                                std::span<const Observation> images,
                                                std::span<const std::span<const ScanHit>> hits,
                                                const Judges& judges, const PoseFilter& excluded,
                                                std::size_t most, Backend& backend,
                                                const ScanOptions& options) {
  std::vector<std::vector<double>> ranks(images.size());
  std::vector<double> all;
  for (std::size_t i = 0; i < images.size(); ++i)
    for (const ScanHit& hit :
         judged(set, hits[i], images[i], judges.others[i], backend, quick(options))) {
      const bool left_out = excluded(judges.last_from_own[i] * hit.camera_from_object);
      ranks[i].push_back(left_out ? INFINITY : hit.rank);
      if (!left_out) all.push_back(hit.rank);
    }
  double limit = std::numeric_limits<double>::max();
  if (images.size() > 1 && all.size() > most) {
    std::ranges::nth_element(all, all.begin() + std::ptrdiff_t(most - 1));
    limit = all[most - 1];
  }
  std::vector<std::vector<ScanHit>> worth(images.size());
  for (std::size_t i = 0; i < images.size(); ++i)
    for (std::size_t h = 0; h < hits[i].size(); ++h)
      if (ranks[i][h] <= limit) worth[i].push_back(hits[i][h]);
  return worth;
}

}  // namespace

std::vector<ScanHit> rescore_in_views(const TemplateSet& set, std::span<const ScanHit> hits,
                                      const Observation& own, std::span<const Observation> others,
                                      Backend& backend, const ScanOptions& options) {
  return judged(set, hits, own, others, backend, careful(options));
}

std::vector<ScanHit> pooled_hits(const TemplateSet& set, std::span<const Observation> images,
                                 std::span<const std::span<const ScanHit>> hits, int helping,
                                 const PoseFilter& excluded, std::size_t most, Backend& backend,
                                 const ScanOptions& options) {
  check(most >= 1, "pooled_hits: at least one hit");
  const Judges judges(images, helping);
  const std::vector<std::vector<ScanHit>> worth =
      worth_judging(set, images, hits, judges, excluded, most, backend, options);
  std::vector<ScanHit> pooled;
  for (std::size_t i = 0; i < images.size(); ++i)
    for (ScanHit hit :
         rescore_in_views(set, worth[i], images[i], judges.others[i], backend, options)) {
      hit.camera_from_object = judges.last_from_own[i] * hit.camera_from_object;
      if (!excluded(hit.camera_from_object)) pooled.push_back(hit);
    }
  return pooled;
}

}  // namespace edgescout
