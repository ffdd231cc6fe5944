// C-ICP: Besl and McKay's ICP (A method for registration of 3-D shapes, PAMI 14(2), 1992) with the
// chamfer distance transform's labels as closest points (Borgefors, PAMI 10(6), 1988). Direction
// does not count.
#include <algorithm>
#include <cmath>
#include <memory>

#include "host/baselines/icp.h"
#include "host/baselines/nearest_edge.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct Labels {
  std::vector<EdgePoint> edges;
  NearestEdges nearest;
  const EdgePoint* at(double x_px, double y_px) const {
    const auto x = std::lround(std::clamp(x_px, 0.0, nearest.width - 1.0)),
               y = std::lround(std::clamp(y_px, 0.0, nearest.height - 1.0));
    const std::int32_t index = nearest.index[std::size_t(y) * nearest.width + x];
    return index < 0 ? nullptr : &edges[index];
  }
};

}  // namespace

PoseSolver prepare_c_icp(std::span<const ObjectView> views, const BaselineOptions& options) {
  const auto labels = std::make_shared<std::vector<Labels>>();
  for (const ObjectView& view : views) {
    check(view.edges != nullptr, "c-icp: a view without edge points");
    const std::span<const EdgePoint> edges = view.edges->points_by_cell();
    labels->push_back({{edges.begin(), edges.end()},
                       nearest_edges(edges, view.camera.width, view.camera.height)});
  }
  const Associate associate = [labels](std::size_t v, double x_px, double y_px, double) {
    return (*labels)[v].at(x_px, y_px);
  };
  return [views, options, associate](const Se3& start,
                                     std::span<const std::vector<ModelPoint>> points) {
    return iterate_closest_points(start, views, points, associate, options);
  };
}

}  // namespace edgescout
