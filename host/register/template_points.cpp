#include "host/register/template_points.h"

#include <algorithm>
#include <limits>

#include "host/model/viewpoint_index.h"
#include "host/register/occluders.h"
#include "host/register/points_in_image.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

ModelPoint transformed(const Se3& to_from_object, const ModelPoint& p) {
  const Eigen::Vector3d position = to_from_object * Eigen::Vector3d(p.x_m, p.y_m, p.z_m),
                        tangent = to_from_object.rotation * Eigen::Vector3d(p.tx, p.ty, p.tz);
  return {float(position.x()), float(position.y()), float(position.z()),
          float(tangent.x()),  float(tangent.y()),  float(tangent.z())};
}

// Which list each pair of a pose and a view shows, and the first pair that shows each list.
struct SharedLists {
  std::vector<std::size_t> of_pair, first_pair;
};

class EdgeLookup {
 public:
  EdgeLookup(const TemplateSet& set, std::span<const ObjectView> views,
             std::span<const ObjectPose> poses, ThreadPool& threads)
      : set_(set),
        views_(views),
        poses_(poses),
        threads_(threads),
        viewpoints_(set),
        nearest_(poses.size() * views.size()) {
    for_each_in_chunks(threads, nearest_.size(), 64, [&](std::size_t pair) {
      nearest_[pair] = viewpoints_.nearest(camera_from_object(pair));
    });
  }

  PointsInViews<ModelPoint> points(const WantedPoints& wanted) const {
    const SharedLists shared = share_lists(wanted.in_image);
    std::vector<std::vector<ModelPoint>> lists(shared.first_pair.size());
    for_each_in_chunks(threads_, lists.size(), 16, [&](std::size_t l) {
      lists[l] = points_of_pair(shared.first_pair[l], wanted);
    });
    JoinedLists<ModelPoint> joined = join_lists(
        lists.size(), [&](std::size_t l) -> const auto& { return lists[l]; }, 0, threads_);
    PointsInViews<ModelPoint> found{std::move(joined.values), {poses_.size(), views_.size()}};
    for (std::size_t pair = 0; pair < nearest_.size(); ++pair)
      found.ranges.values()[pair] = joined.ranges[shared.of_pair[pair]];
    return found;
  }

  Grid<std::size_t> outside(const PointsInViews<ModelPoint>& edges) const {
    Grid<std::size_t> outside(poses_.size(), views_.size());
    for_each_in_chunks(threads_, nearest_.size(), 64, [&](std::size_t pair) {
      const PointRange& range = edges.ranges.values()[pair];
      outside.values()[pair] =
          count_outside(std::span(edges.points).subspan(range.first, range.count), set_.model,
                        view_of(pair).camera, camera_from_object(pair));
    });
    return outside;
  }

 private:
  const ObjectView& view_of(std::size_t pair) const { return views_[pair % views_.size()]; }
  Se3 camera_from_object(std::size_t pair) const {
    return view_of(pair).camera_from_world * poses_[pair / views_.size()].world_from_object;
  }

  // What occluders hide and what lies outside the image differ from pair to pair.
  bool has_own(std::size_t pair, bool in_image) const {
    const ObjectView& view = view_of(pair);
    return view.occluders ||
           (in_image && !is_wholly_in(view.camera, set_.model, camera_from_object(pair)));
  }

  SharedLists share_lists(bool in_image) const {
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> known(set_.views.size() * set_.symmetries.discrete.size(), none);
    SharedLists lists;
    for (std::size_t pair = 0; pair < nearest_.size(); ++pair) {
      std::size_t own = none;
      std::size_t& list =
          has_own(pair, in_image)
              ? own
              : known[nearest_[pair].symmetry * set_.views.size() + nearest_[pair].viewpoint];
      if (list == none) {
        list = lists.first_pair.size();
        lists.first_pair.push_back(pair);
      }
      lists.of_pair.push_back(list);
    }
    return lists;
  }

  std::vector<ModelPoint> points_of_pair(std::size_t pair, const WantedPoints& wanted) const {
    std::vector<ModelPoint> points =
        thinned(set_.views[nearest_[pair].viewpoint].points, wanted.edges);
    for (ModelPoint& point : points)
      point = transformed(viewpoints_.symmetry(nearest_[pair].symmetry), point);
    if (view_of(pair).occluders)
      remove_hidden(points, *view_of(pair).occluders, camera_from_object(pair),
                    occlusion_tolerance_m(set_.model));
    if (wanted.in_image)
      remove_outside(points, set_.model, view_of(pair).camera, camera_from_object(pair));
    return points;
  }

  const TemplateSet& set_;
  std::span<const ObjectView> views_;
  std::span<const ObjectPose> poses_;
  ThreadPool& threads_;
  ViewpointIndex viewpoints_;
  std::vector<ViewpointIndex::Nearest> nearest_;  // by pair
};

// The same of all poses. A beginning of the samples is spread evenly (sample_surface); half of them
// face away.
PointsInViews<SurfacePoint> surface(const EdgeModel& model, std::span<const ObjectView> views,
                                    std::size_t poses, int most) {
  constexpr std::size_t beginning = 120;
  const std::vector<SurfacePoint>& all = model.surface_points;
  const auto first = std::span(all).first(std::min(beginning, all.size()));
  PointsInViews<SurfacePoint> found{Unfilled<SurfacePoint>(thinned_size(first.size(), most)),
                                    {poses, views.size()}};
  thin_into<SurfacePoint>(found.points, first);
  for (std::size_t v = 0; v < views.size(); ++v)
    if (views[v].depth_values)
      for (std::size_t p = 0; p < poses; ++p)
        found.ranges(p, v) = {0, std::uint32_t(found.points.size())};
  return found;
}

}  // namespace

TemplatePoints template_points(const TemplateSet& set, std::span<const ObjectView> views,
                               std::span<const ObjectPose> poses, const WantedPoints& wanted,
                               Backend& backend) {
  const EdgeLookup lookup(set, views, poses, backend.threads());
  TemplatePoints found{
      {lookup.points(wanted), surface(set.model, views, poses.size(), wanted.surface)},
      {poses.size(), views.size()}};
  if (!wanted.in_image) found.outside = lookup.outside(found.visible.edges);
  return found;
}

}  // namespace edgescout
