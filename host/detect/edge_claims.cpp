#include "host/detect/edge_claims.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "host/core/option_bounds.h"
#include "host/detect/probability_over_views.h"
#include "host/register/visible_in_views.h"
#include "kernels/error.h"
#include "kernels/pose_geometry.h"

namespace edgescout {

namespace {

// An image edge point, by view.
struct EdgeKey {
  std::size_t view;
  const EdgePoint* edge;
  bool operator==(const EdgeKey&) const = default;
};
struct EdgeKeyHash {
  std::size_t operator()(const EdgeKey& key) const {
    return std::hash<const void*>()(key.edge) ^ key.view;
  }
};

struct Explained {
  EdgeKey key;
  double length_px;  // of the model edge it matches
};

// The image edges a pose explains, one entry a visible model point.
std::vector<Explained> explained_edges(const EdgeModel& model, const ObjectPose& pose,
                                       std::span<const RegisterView> views,
                                       std::span<const VisibleInView> seen,
                                       const EdgeClaimOptions& options) {
  std::vector<Explained> explained;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!views[v].edges) continue;
    const Pose transform = to_pose(views[v].camera_from_world * pose.world_from_object);
    for (const ModelPoint& point : seen[v].points) {
      const PosedPoint<float> posed = pose_point<float>(transform, point);
      if (!can_be_seen(posed.point)) continue;
      const ProjectedEdge<float> edge = project_edge(posed, views[v].view->intrinsics);
      const EdgePoint* match = views[v].edges->nearest(
          edge.u, edge.v, orientation(edge.dx, edge.dy), options.match_px, options.max_turn_rad);
      const double px_per_m = std::hypot(edge.dx, edge.dy) / (posed.point.z * posed.point.z);
      if (match) explained.push_back({{v, match}, model.raster_step_m * px_per_m});
    }
  }
  return explained;
}

class ClaimedEdges {
 public:
  explicit ClaimedEdges(std::span<const RegisterView> views) : views_(views) {}
  bool contains(const EdgeKey& key) const { return claimed_.contains(key); }
  void claim(const std::vector<Explained>& explained, const EdgeClaimOptions& options) {
    for (const Explained& e : explained)
      views_[e.key.view].edges->for_each_near(e.key.edge->x_px, e.key.edge->y_px, options.match_px,
                                              [&](const EdgePoint& edge) {
                                                claimed_.insert({e.key.view, &edge});
                                              });
  }

 private:
  std::span<const RegisterView> views_;
  std::unordered_set<EdgeKey, EdgeKeyHash> claimed_;
};

double unclaimed_fraction(const std::vector<Explained>& explained, const ClaimedEdges& claimed) {
  double total = 0, unclaimed = 0;
  for (const Explained& e : explained) {
    total += e.length_px;
    if (!claimed.contains(e.key)) unclaimed += e.length_px;
  }
  return total > 0 ? unclaimed / total : 0;
}

// More than chance in all views together, or clearly so in two of them: others may hide it from the
// rest.
bool exceeds_chance(std::span<const PoseFeatures> by_view) {
  constexpr double clearly = 2;  // standard errors
  return psi_z_score(pool_over_views(by_view)) > 0 ||
         std::ranges::count_if(by_view,
                               [](const PoseFeatures& f) { return psi_z_score(f) > clearly; }) > 1;
}

}  // namespace

void EdgeClaimOptions::validate() const {
  const OptionBounds in("edge_claims");
  in("match", match_px, 0.01, EdgeIndex::CELL_PX);
  in("max_turn", max_turn_rad, 0, 3.15);
  in("max_claimed", max_claimed, 0, 1);
}

std::vector<EdgeClaim> claim_edges(std::span<const EdgeModel> models,
                                   std::span<const ObjectPose> poses,
                                   std::span<const std::vector<PoseFeatures>> features,
                                   std::span<const RegisterView> views, Backend& backend,
                                   const EdgeClaimOptions& options) {
  check(features.size() == poses.size(), "claim_edges: as many features as poses");
  std::vector<std::vector<Explained>> explained(poses.size());
  for (std::size_t p = 0; p < poses.size(); ++p) {
    const std::vector<VisibleInView> seen =
        visible_in_views(models, poses.subspan(p, 1), views, backend);
    explained[p] = explained_edges(models[poses[p].object], poses[p], views, seen, options);
  }
  ClaimedEdges claimed(views);
  std::vector<EdgeClaim> chosen;
  std::vector<bool> open(poses.size(), true);
  for (;;) {
    std::size_t best = poses.size();
    double most_worth = 0;
    for (std::size_t p = 0; p < poses.size(); ++p) {
      if (!open[p]) continue;
      const double unclaimed = unclaimed_fraction(explained[p], claimed);
      if (unclaimed < 1 - options.max_claimed || !exceeds_chance(features[p])) {
        open[p] = false;
        continue;
      }
      const double worth = unclaimed / (1 + std::exp(-merit(features[p])));
      if (worth > most_worth) most_worth = worth, best = p;
    }
    if (best == poses.size()) return chosen;
    chosen.push_back({best, unclaimed_fraction(explained[best], claimed)});
    claimed.claim(explained[best], options);
    open[best] = false;
  }
}

}  // namespace edgescout
