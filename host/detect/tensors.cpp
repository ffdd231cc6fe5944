#include "host/detect/tensors.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "host/edge/salient_edges.h"
#include "host/register/measured_depth.h"
#include "host/register/occluders.h"
#include "kernels/error.h"

namespace edgescout {

void describe_values(TensorOptions& o, OptionVisitor& visit) {
  visit.number(
      {"smoothing-variance", "Variance of the smoothing over orientation, bins^2. 0: no smoothing"},
      o.smoothing_variance, 0.0f, 16.0f);
  visit.number({"cap", "Largest distance to an edge; larger ones count as this, px"}, o.cap_px,
               1.0f, float(DCD_MAX_CAP_PX));
}

void describe(TensorOptions& o, OptionVisitor& visit) {
  visit.group("Tensor");
  visit.number({"bins", "Number of orientation bins over half a turn; even"}, o.bins, 4,
               int(DCD_MAX_BINS));
  visit.number({"lambda", "Weight of an orientation error against a distance, px/rad"},
               o.lambda_px_per_rad, 0.0f, 10000.0f);
  describe_values(o, visit);
}

namespace {

// The reductions that suit the objects at their scales.
std::set<double> reductions_for(std::span<const TemplateSet> sets, const Camera& camera) {
  check(!sets.empty(), "add_tensors: no templates");
  std::set<double> reductions;
  for (const TemplateSet& set : sets)
    for (const DistanceRange& scale : distance_scales(set.options))
      reductions.insert(
          reduction_for(size_px(set.model.mesh.diameter_m, scale.middle_m(), camera)));
  return reductions;
}

ViewHandle reduced_tensor(std::vector<EdgePoint> edges, const ReducedTensors& level,
                          Backend& backend, TensorOptions options) {
  options.lambda_px_per_rad = float(options.lambda_px_per_rad / level.reduction);
  for (EdgePoint& edge : edges) {
    edge.x_px = float((edge.x_px + 0.5) / level.reduction - 0.5);
    edge.y_px = float((edge.y_px + 0.5) / level.reduction - 0.5);
  }
  return backend.make_view(edges, level.camera.width, level.camera.height, {},
                           intrinsics_of(level.camera), options);
}

void upload_depth(ObjectView& view, Backend& backend) {
  const DepthImage& depth = view.depth->image;
  check(depth.width == view.camera.width && depth.height == view.camera.height,
        "add_tensors: depth and camera differ in size");
  view.depth_values =
      backend.make_depth({depth.z_m, depth.width, depth.height, intrinsics_of(view.camera)});
  view.occluders = make_occluders({}, {}, view, backend);
}

void add_tensors(ObjectView& view, const std::set<double>& reductions, Backend& backend,
                 const TensorOptions& options) {
  check(is_finite(view.camera_from_world), "add_tensors: a camera pose that is not finite");
  check(view.image && view.edges, "add_tensors: a view without an image or without edges");
  const Camera& camera = view.camera;
  const Image& image = *view.image;
  const std::span<const EdgePoint> edges = view.edges->points();
  view.tensor = backend.make_view(edges, camera.width, camera.height,
                                  {image.width, image.height, image.pixels.data()},
                                  intrinsics_of(camera), options);
  if (view.depth) upload_depth(view, backend);
  view.reduced.clear();
  const std::vector<EdgePoint> salient = salient_edges(edges, camera.width, camera.height);
  for (const double reduction : reductions) {
    ReducedTensors& level = view.reduced.emplace_back();
    level.reduction = reduction;
    level.camera = scaled(camera, 1 / reduction);
    level.coarse = reduction == 1
                       ? view.tensor  // the same edges at the same size
                       : reduced_tensor({edges.begin(), edges.end()}, level, backend, options);
    level.salient = reduced_tensor(salient, level, backend, options);
  }
}

}  // namespace

double reduction_for(double size_px) {
  return std::clamp(std::round(size_px / REDUCED_SIZE_PX), 1.0, 8.0);
}

void add_tensors(ObjectView& view, double reduction, Backend& backend,
                 const TensorOptions& options) {
  add_tensors(view, std::set{reduction}, backend, options);
}

void add_tensors(ObjectView& view, std::span<const TemplateSet> sets, Backend& backend,
                 const TensorOptions& options) {
  add_tensors(view, reductions_for(sets, view.camera), backend, options);
}

}  // namespace edgescout
