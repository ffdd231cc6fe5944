#include "host/detect/edge_claims.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "host/register/visible_in_views.h"
#include "kernels/pose_geometry.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// An edge point of one view's image.
struct ImageEdge {
  std::size_t view;
  const EdgePoint* point;
  bool operator==(const ImageEdge&) const = default;
};
struct ImageEdgeHash {
  std::size_t operator()(const ImageEdge& edge) const {
    return std::hash<const void*>()(edge.point) ^ edge.view;
  }
};

struct ExplainedEdge {
  ImageEdge edge;
  double length_px;  // of the model edge that it matches
};

// The edges of view `v` that the pose explains, one entry per visible model point that has one.
void append_explained(const Scene& scene, const ObjectPose& pose, std::size_t v,
                      const std::vector<ModelPoint>& visible, const EdgeClaimOptions& options,
                      std::vector<ExplainedEdge>& explained) {
  const ObjectView& view = scene.views[v];
  const Pose camera_from_object = to_pose(view.camera_from_world * pose.world_from_object);
  const EdgeReach reach(options.match_px, options.max_turn_rad);
  const double raster_step_m = scene.models[std::size_t(pose.object)].raster_step_m;
  for (const ModelPoint& point : visible) {
    const PosedPoint<float> posed = pose_point<float>(camera_from_object, point);
    if (!can_be_seen(posed.point)) continue;
    const ProjectedEdge<float> edge = project_edge(posed, view.tensor->intrinsics);
    const EdgePoint* match = view.edges->nearest({edge.u, edge.v}, {edge.dx, edge.dy}, reach);
    const double px_per_m = std::hypot(edge.dx, edge.dy) / (posed.point.z * posed.point.z);
    if (match) explained.push_back({{v, match}, raster_step_m * px_per_m});
  }
}

// By pose.
std::vector<std::vector<ExplainedEdge>> explained_edges(const Scene& scene,
                                                        std::span<const ObjectPose> poses,
                                                        const EdgeClaimOptions& options) {
  const Grid<VisibleInView> visible = visible_in_views(scene, poses);
  std::vector<std::vector<ExplainedEdge>> explained(poses.size());
  scene.backend.threads().for_each(poses.size(), [&](std::size_t p) {
    for (std::size_t v = 0; v < scene.views.size(); ++v)
      if (scene.views[v].edges)
        append_explained(scene, poses[p], v, visible(p, v).points, options, explained[p]);
  });
  return explained;
}

class ClaimedEdges {
 public:
  ClaimedEdges(std::span<const ObjectView> views, double match_px)
      : views_(views), match_px_(match_px) {}

  // With their neighbours: an image edge is wider than one point.
  void claim(const std::vector<ExplainedEdge>& explained) {
    for (const auto& [edge, length_px] : explained)
      views_[edge.view].edges->for_each_near(edge.point->x_px, edge.point->y_px, float(match_px_),
                                             [&, view = edge.view](const EdgePoint& point) {
                                               claimed_.insert({view, &point});
                                             });
  }

  double unclaimed_fraction(const std::vector<ExplainedEdge>& explained) const {
    double total_px = 0, unclaimed_px = 0;
    for (const auto& [edge, length_px] : explained) {
      total_px += length_px;
      if (!claimed_.contains(edge)) unclaimed_px += length_px;
    }
    return total_px > 0 ? unclaimed_px / total_px : 0;
  }

 private:
  std::span<const ObjectView> views_;
  double match_px_;
  std::unordered_set<ImageEdge, ImageEdgeHash> claimed_;
};

// A pose that may still be chosen.
struct Competitor {
  EdgeClaim claim;
  std::vector<ExplainedEdge> explained;
  double probability;
  double weighted_probability() const { return claim.unclaimed * probability; }
};

std::vector<Competitor> competitors_of(const Scene& scene, std::span<const PoseEstimate> poses,
                                       const EdgeClaimOptions& options) {
  std::vector<std::size_t> indices;
  std::vector<ObjectPose> competing;
  for (std::size_t p = 0; p < poses.size(); ++p)
    if (poses[p].classification.has_psi_above_chance) {
      indices.push_back(p);
      competing.push_back(poses[p]);
    }
  std::vector<std::vector<ExplainedEdge>> explained = explained_edges(scene, competing, options);
  std::vector<Competitor> competitors;
  for (std::size_t i = 0; i < indices.size(); ++i)
    competitors.push_back(
        {{indices[i], 1}, std::move(explained[i]), poses[indices[i]].classification.probability});
  return competitors;
}

// The first of the best; end() where no probability is above 0.
auto best_of(std::vector<Competitor>& competitors) {
  auto best = competitors.end();
  double highest = 0;
  for (auto it = competitors.begin(); it != competitors.end(); ++it)
    if (const double p = it->weighted_probability(); p > highest) highest = p, best = it;
  return best;
}

}  // namespace

void describe(EdgeClaimOptions& o, OptionVisitor& visit) {
  visit.group("Detection");
  visit.number({"max-claimed",
                "A pose is dropped where better poses claim more than this fraction of the edges "
                "that it explains"},
               o.max_claimed, 0.0, 1.0);
}

void EdgeClaimOptions::validate() const {
  check_bounds(*this, "edge_claims");
  const BoundsCheck in("edge_claims");
  in.require("match", match_px, 0.01, EdgeIndex::MAX_RADIUS_PX);
  in.require("max_turn", max_turn_rad, 0, 3.15);
}

std::vector<EdgeClaim> claim_edges(const Scene& scene, std::span<const PoseEstimate> poses,
                                   const EdgeClaimOptions& options) {
  std::vector<Competitor> competitors = competitors_of(scene, poses, options);
  ClaimedEdges claimed(scene.views, options.match_px);
  std::vector<EdgeClaim> claims;
  for (;;) {
    for (Competitor& competitor : competitors)
      competitor.claim.unclaimed = claimed.unclaimed_fraction(competitor.explained);
    std::erase_if(competitors, [&](const Competitor& competitor) {
      return competitor.claim.unclaimed < 1 - options.max_claimed;
    });
    const auto best = best_of(competitors);
    if (best == competitors.end()) return claims;
    claims.push_back(best->claim);
    claimed.claim(best->explained);
    competitors.erase(best);
  }
}

double claimed_fraction(const Scene& scene, const ObjectPose& pose,
                        std::span<const ObjectPose> claimants, const EdgeClaimOptions& options) {
  const std::vector<ExplainedEdge> explained = explained_edges(scene, {&pose, 1}, options)[0];
  if (explained.empty()) return 0;
  ClaimedEdges claimed(scene.views, options.match_px);
  for (const std::vector<ExplainedEdge>& of_claimant : explained_edges(scene, claimants, options))
    claimed.claim(of_claimant);
  return 1 - claimed.unclaimed_fraction(explained);
}

}  // namespace edgescout
