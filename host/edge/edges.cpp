#include "host/edge/edges.h"

#include "host/edge/edge_index.h"
#include "kernels/backend.h"
#include "kernels/error.h"

namespace edgescout {

void EdgesOptions::validate() const {
  gradient.validate();
  faint.validate();
  if (!(faint_clearance_px >= 0 && faint_clearance_px <= EdgeIndex::CELL_PX))
    throw InputError("options", "edge.faint_clearance", std::to_string(faint_clearance_px),
                     "0 to " + std::to_string(EdgeIndex::CELL_PX) + " px");
  lsd.validate();
}

EdgeMethod edge_method_from_name(const std::string& name) {
  if (name == "gradient") return EdgeMethod::Gradient;
  if (name == "lsd") return EdgeMethod::Lsd;
  throw InputError("options", "edge.method", "\"" + name + "\"", "gradient or lsd");
}

std::string name_of(EdgeMethod method) { return method == EdgeMethod::Lsd ? "lsd" : "gradient"; }

std::vector<EdgePoint> find_edges(const Image& image, const EdgesOptions& options,
                                  Backend& backend) {
  options.validate();
  if (options.method == EdgeMethod::Lsd) return lsd_edges(image, options.lsd);
  const ImageView view{image.width, image.height, image.pixels.data()};
  std::vector<EdgePoint> edges = backend.detect_edges(view, options.gradient);
  if (!options.faint_edges) return edges;
  constexpr float any_direction = 4;
  const EdgeIndex fine(edges, image.width, image.height);
  for (const EdgePoint& edge : backend.detect_edges(view, options.faint))
    if (!fine.nearest(edge.x_px, edge.y_px, edge.theta_rad, options.faint_clearance_px,
                      any_direction))
      edges.push_back(edge);
  return edges;
}

}  // namespace edgescout
