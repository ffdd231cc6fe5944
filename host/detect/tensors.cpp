#include "host/detect/tensors.h"

#include <algorithm>
#include <cmath>

#include "host/edge/salient_edges.h"
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

// Typical size of an object in the image: at the geometric mean of its distances.
double size_px(const TemplateSet& set, const Camera& camera) {
  return set.model.mesh.diameter_m /
         std::sqrt(set.options.distance_min_m * set.options.distance_max_m) * camera.fx;
}

double smallest_size_px(std::span<const TemplateSet> sets, const Camera& camera) {
  check(!sets.empty(), "pipeline: no templates");
  double smallest = size_px(sets[0], camera);
  for (const TemplateSet& set : sets) smallest = std::min(smallest, size_px(set, camera));
  return smallest;
}

ViewHandle reduced_tensor(std::vector<EdgePoint> edges, const ObjectView& view, Backend& backend,
                          const TensorOptions& options) {
  for (EdgePoint& edge : edges) {
    edge.x_px = float((edge.x_px + 0.5) / view.reduction - 0.5);
    edge.y_px = float((edge.y_px + 0.5) / view.reduction - 0.5);
  }
  return backend.make_view(edges, view.coarse_camera.width, view.coarse_camera.height, {},
                           intrinsics_of(view.coarse_camera), options);
}

}  // namespace

double reduction_for(double size_px) { return std::clamp(std::round(size_px / 48), 1.0, 8.0); }

void add_tensors(ObjectView& view, double reduction, Backend& backend,
                 const TensorOptions& options) {
  check(is_finite(view.camera_from_world), "add_tensors: a camera pose that is not finite");
  check(view.image && view.edges, "add_tensors: a view without an image or without edges");
  const Camera& camera = view.camera;
  const Image& image = *view.image;
  const std::span<const EdgePoint> edges = view.edges->points();
  view.reduction = reduction;
  view.coarse_camera = scaled(camera, 1 / reduction);
  view.tensor = backend.make_view(edges, camera.width, camera.height,
                                  {image.width, image.height, image.pixels.data()},
                                  intrinsics_of(camera), options);
  TensorOptions reduced = options;
  reduced.lambda_px_per_rad = float(options.lambda_px_per_rad / reduction);
  view.coarse = reduced_tensor({edges.begin(), edges.end()}, view, backend, reduced);
  view.salient =
      reduced_tensor(salient_edges(edges, camera.width, camera.height), view, backend, reduced);
}

void add_tensors(ObjectView& view, std::span<const TemplateSet> sets, Backend& backend,
                 const TensorOptions& options) {
  add_tensors(view, reduction_for(smallest_size_px(sets, view.camera)), backend, options);
}

}  // namespace edgescout
