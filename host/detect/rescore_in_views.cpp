#include "host/detect/rescore_in_views.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/detect/support_views.h"
#include "host/detect/template_projection.h"
#include "host/model/viewpoint_index.h"
#include "host/register/occluders.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr std::ptrdiff_t HITS_PER_CALL = 4096;  // 10 MB of points
constexpr double CHANCE_PX = TEMPLATE_SCORE_OUTSIDE / 4.0;

// How much work a rescoring is: points of each template, and distances that are tried, evenly over
// the gap between the distances of two templates.
struct Effort {
  int points, distances;
  // Change of the distance, as a fraction of it.
  double shift(int step, double distance_ratio) const {
    return (distance_ratio - 1) * (step / double(distances - 1) - 0.5);
  }
};
Effort quick(const ScanOptions& options) { return {std::max(1, options.points / 3), 3}; }
Effort full(const ScanOptions& options) { return {options.points, 5}; }

// A template set as any camera sees it: the thinned points of every viewpoint.
struct VisibleTemplates {
  const TemplateSet& set;
  Effort effort;
  ViewpointIndex index;
  std::vector<ThinnedView> views;  // by viewpoint

  VisibleTemplates(const TemplateSet& templates, const Effort& rescoring)
      : set(templates), effort(rescoring), index(templates) {
    for (const TemplateView& view : templates.views) views.emplace_back(view, rescoring.points);
  }
};

// A hit in the camera frame of one of the images, and the line it is moved along.
struct MovableHit {
  Se3 camera_from_object;
  Eigen::Vector3d ray_m;  // from the camera that found it to the object's centre
  Se3 at(double shift) const {
    return {camera_from_object.rotation, camera_from_object.translation_m + shift * ray_m};
  }
};

// How well a hit fits one view: `rank`, as ScanHit::rank, over the points that known objects do not
// hide, and the fraction of points that these are.
struct ViewVote {
  double rank = 1, weight = 1;
};

// Whether known objects hide the points of one tensor's pixels. Tests one pixel of their depth map,
// where Occluders::hide tests nine: one point of sixty on the wrong side changes a rank little.
class OccluderTest {
 public:
  OccluderTest(const Occluders* occluders, const ReducedTensors& level, double tolerance_m)
      : occluders_(occluders), tolerance_m_(float(tolerance_m)) {
    if (occluders_) scale_ = float(occluders_->camera.width) / float(level.camera.width);
  }

  // Moves the visible points to the front; returns their number.
  int keep_visible(const ThinnedView& view, const Pose& camera_from_object,
                   TemplatePoint* points) const {
    if (!occluders_) return view.count();
    int kept = 0;
    for (int i = 0; i < view.count(); ++i)
      if (!hides(points[i], view.depth_m(camera_from_object, i))) points[kept++] = points[i];
    return kept;
  }

 private:
  bool hides(const TemplatePoint& point, float depth_m) const {
    const int x = int((point.dx_px + 0.5f) * scale_), y = int((point.dy_px + 0.5f) * scale_);
    if (point.dx_px < 0 || point.dy_px < 0 || x >= occluders_->camera.width ||
        y >= occluders_->camera.height)
      return false;
    return occluders_
               ->depth_m[std::size_t(y) * std::size_t(occluders_->camera.width) + std::size_t(x)] <
           depth_m - tolerance_m_;
  }

  const Occluders* occluders_;
  float scale_ = 1, tolerance_m_;
};

Pose with_translation(Pose pose, const Eigen::Vector3d& translation_m) {
  for (int i = 0; i < 3; ++i) pose.m[4 * i + 3] = float(translation_m[i]);
  return pose;
}

// Scores hits in one view: all distances of every hit side by side.
class ViewScoring {
 public:
  ViewScoring(const VisibleTemplates& templates, const ObjectView& view, std::size_t level,
              std::size_t hits)
      : templates_(templates),
        level_(view.reduced[level]),
        occluder_test_(view.occluders.get(), level_, occlusion_tolerance_m(templates.set.model)),
        points_(hits * num_distances() * num_points()),
        jobs_(hits * num_distances()),
        visible_(jobs_.size()),
        votes_(jobs_.size()) {}

  // Entry h * distances + step is hits[h] at that step; poses are in the frame of the view's
  // camera.
  std::vector<ViewVote> votes_of(std::span<const MovableHit> hits, Backend& backend) {
    for_each_in_chunks(backend.threads(), hits.size(), 64,
                       [&](std::size_t h) { project_all_distances(hits[h], h); });
    std::vector<TemplateHit> scores(jobs_.size());
    backend.template_score(*level_.salient, points_, jobs_, 1, scores);
    for (std::size_t j = 0; j < jobs_.size(); ++j)
      votes_[j].rank *= visible_[j] > 0 ? scores[j].sum / (4.0 * jobs_[j].point_count) : CHANCE_PX;
    return votes_;
  }

 private:
  std::size_t num_points() const { return std::size_t(templates_.effort.points); }
  std::size_t num_distances() const { return std::size_t(templates_.effort.distances); }

  // One viewpoint serves all distances: at the default ones the direction changes by three degrees
  // at most, and viewpoints stand eleven degrees apart.
  void project_all_distances(const MovableHit& hit, std::size_t h) {
    const Se3& camera_from_object = hit.camera_from_object;
    const ViewpointIndex::Nearest nearest = templates_.index.nearest(camera_from_object);
    const Se3& symmetry = templates_.index.symmetry(nearest.symmetry);
    const Pose camera_from_template = to_pose(camera_from_object * symmetry);
    const Eigen::Vector3d center_m = camera_from_object.rotation * templates_.set.model.center_m,
                          offset_m = camera_from_object.rotation * symmetry.translation_m;
    // One weight for all distances: where nothing is visible, the nearest one would fit best.
    const double size_weight =
        scan_size_weight((camera_from_object.translation_m + center_m).norm());
    for (std::size_t step = 0; step < num_distances(); ++step) {
      const double shift =
          templates_.effort.shift(int(step), templates_.set.options.distance_ratio);
      const std::size_t j = h * num_distances() + step;
      votes_[j].rank = size_weight;
      project(j, templates_.views[nearest.viewpoint],
              with_translation(camera_from_template, hit.at(shift).translation_m + offset_m));
    }
  }

  void project(std::size_t j, const ThinnedView& view, const Pose& camera_from_template) {
    const auto& salient = *level_.salient;
    const TemplateProjectOptions options{salient.intrinsics, salient.shape.bins,
                                         nearest_drawn_m(templates_.set)};
    TemplatePoint* points = points_.data() + j * num_points();
    if (view.count() > 0 && view.project(camera_from_template, options, points)) {
      visible_[j] = occluder_test_.keep_visible(view, camera_from_template, points);
      votes_[j].weight = double(visible_[j]) / view.count();
    }
    if (visible_[j] == 0) points[0] = {};  // a job needs a point; its answer is not read
    jobs_[j] = {
        std::uint32_t(j * num_points()), std::uint32_t(std::max(1, visible_[j])), 0, 0, 1, 1};
  }

  const VisibleTemplates& templates_;
  const ReducedTensors& level_;
  OccluderTest occluder_test_;
  std::vector<TemplatePoint> points_;
  // By hit and distance:
  std::vector<TemplateJob> jobs_;
  std::vector<int> visible_;  // number of points; 0: behind the camera or hidden
  std::vector<ViewVote> votes_;
};

// Weighted sum of the ranks of a hit at one distance over the views so far.
struct RankSum {
  double sum, weight;
  double mean() const { return sum / weight; }
};

// The ranks of all hits at all distances in all views, in the order of ViewScoring::votes_of.
std::vector<RankSum> sum_ranks(const ObjectSearch& search, const VisibleTemplates& templates,
                               std::size_t level, std::span<const ScanHit> hits,
                               std::span<const MovableHit> movable) {
  const std::size_t distances = std::size_t(templates.effort.distances);
  std::vector<RankSum> ranks;
  for (std::size_t i = 0; i < hits.size() * distances; ++i)
    ranks.push_back({hits[i / distances].rank, 1});  // its own view weighs 1
  std::vector<MovableHit> in_other(movable.size());
  for (const ObjectView& other : search.support) {
    const Se3 other_from_own = other.camera_from_world * inverse(search.view.camera_from_world);
    std::ranges::transform(movable, in_other.begin(), [&](const MovableHit& hit) {
      return MovableHit{other_from_own * hit.camera_from_object,
                        other_from_own.rotation * hit.ray_m};
    });
    const std::vector<ViewVote> votes =
        ViewScoring(templates, other, level, in_other.size()).votes_of(in_other, search.backend);
    for (std::size_t i = 0; i < ranks.size(); ++i)
      ranks[i].sum += votes[i].weight * votes[i].rank, ranks[i].weight += votes[i].weight;
  }
  return ranks;
}

// Hits of one scale, in place.
void rescore(const ObjectSearch& search, const VisibleTemplates& templates,
             std::span<ScanHit> hits) {
  const std::size_t level = level_of_scale(search.set, hits[0].scale, search.view);
  const std::size_t distances = std::size_t(templates.effort.distances);
  std::vector<MovableHit> movable;
  for (const ScanHit& hit : hits)
    movable.push_back(
        {hit.pose.world_from_object, hit.pose.world_from_object * search.set.model.center_m});
  const std::vector<RankSum> ranks = sum_ranks(search, templates, level, hits, movable);
  for (std::size_t h = 0; h < hits.size(); ++h) {
    std::size_t best = h * distances + distances / 2;  // unmoved, unless another is better
    for (std::size_t i = h * distances; i < (h + 1) * distances; ++i)
      if (ranks[i].mean() < ranks[best].mean()) best = i;
    hits[h].pose.world_from_object = movable[h].at(
        templates.effort.shift(int(best % distances), search.set.options.distance_ratio));
    hits[h].rank = ranks[best].mean();
  }
}

std::vector<ScanHit> rescored(const ObjectSearch& search, std::span<const ScanHit> hits,
                              const Effort& effort) {
  std::vector<ScanHit> rescored(hits.begin(), hits.end());
  if (search.support.empty()) return rescored;
  const VisibleTemplates templates(search.set, effort);
  for (auto begin = rescored.begin(); begin != rescored.end();) {
    const auto limit = begin + std::min<std::ptrdiff_t>(HITS_PER_CALL, rescored.end() - begin),
               end = std::find_if(begin, limit, [scale = begin->scale](const ScanHit&hit) {
                 return hit.scale != scale;
               });
    rescore(search, templates, {begin, end});
    begin = end;
  }
  return rescored;
}

// An image whose hits are pooled.
struct PooledImage {
  const ObjectView& view;
  std::span<const ScanHit> hits;
  std::vector<ObjectView> support;
  Se3 last_from_own;  // camera frames
  ObjectSearch search(const TemplateSet& set, Backend& backend) const {
    return {set, view, support, backend};
  }
};

std::vector<PooledImage> pooled_images(std::span<const ObjectView> images,
                                       std::span<const std::span<const ScanHit>> hits,
                                       int most_support_views) {
  std::vector<PooledImage> pooled;
  for (std::size_t i = 0; i < images.size(); ++i)
    pooled.push_back({images[i], hits[i],
                      support_views(images[i], all_but(images, i), std::size_t(most_support_views)),
                      images.back().camera_from_world * inverse(images[i].camera_from_world)});
  return pooled;
}

bool is_excluded(const Se3& camera_from_object, const PoolOptions& options) {
  return options.is_excluded && options.is_excluded(camera_from_object);
}

// The highest of the `most` lowest ranks, which it reorders.
double rank_limit(std::vector<double>& ranks, std::size_t most) {
  if (ranks.size() <= most) return std::numeric_limits<double>::max();
  std::ranges::nth_element(ranks, ranks.begin() + std::ptrdiff_t(most - 1));
  return ranks[most - 1];
}

// The hits of each image, as they are, that are among the best `options.most` after a quick
// rescoring. All scales keep the same number.
std::vector<std::vector<ScanHit>> preselect(const TemplateSet& set,
                                            std::span<const PooledImage> images, Backend& backend,
                                            const PoolOptions& options) {
  std::vector<std::vector<double>> ranks(images.size()),
      by_scale(distance_scales(set.options).size());
  for (std::size_t i = 0; i < images.size(); ++i)
    for (const ScanHit& hit :
         rescored(images[i].search(set, backend), images[i].hits, quick(options.scan))) {
      const bool excluded =
          is_excluded(images[i].last_from_own * hit.pose.world_from_object, options);
      ranks[i].push_back(excluded ? INFINITY : hit.rank);
      if (!excluded) by_scale[std::size_t(hit.scale)].push_back(hit.rank);
    }
  std::vector<double> limits;
  for (std::vector<double>& of_scale : by_scale)
    limits.push_back(images.size() > 1 ? rank_limit(of_scale, share_of_scale(options.most, set))
                                       : std::numeric_limits<double>::max());
  std::vector<std::vector<ScanHit>> selected(images.size());
  for (std::size_t i = 0; i < images.size(); ++i)
    for (std::size_t h = 0; h < images[i].hits.size(); ++h)
      if (ranks[i][h] <= limits[std::size_t(images[i].hits[h].scale)])
        selected[i].push_back(images[i].hits[h]);
  return selected;
}

}  // namespace

std::vector<ScanHit> rescore_in_views(const ObjectSearch& search, std::span<const ScanHit> hits,
                                      const ScanOptions& options) {
  return rescored(search, hits, full(options));
}

std::vector<ScanHit> pooled_hits(const TemplateSet& set, std::span<const ObjectView> images,
                                 std::span<const std::span<const ScanHit>> hits, Backend& backend,
                                 const PoolOptions& options) {
  check(options.most >= 1, "pooled_hits: at least one hit");
  const std::vector<PooledImage> pooled = pooled_images(images, hits, options.support_views);
  const std::vector<std::vector<ScanHit>> selected = preselect(set, pooled, backend, options);
  std::vector<ScanHit> found;
  for (std::size_t i = 0; i < images.size(); ++i)
    for (ScanHit hit :
         rescore_in_views(pooled[i].search(set, backend), selected[i], options.scan)) {
      hit.pose.world_from_object = pooled[i].last_from_own * hit.pose.world_from_object;
      if (!is_excluded(hit.pose.world_from_object, options)) found.push_back(hit);
    }
  return found;
}

}  // namespace edgescout
