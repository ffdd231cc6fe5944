#include "host/edge/edges.h"

#include "host/edge/edge_index.h"
#include "kernels/backend.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr const char* METHODS[] = {"gradient", "lsd"};  // in the order of EdgeMethod

}  // namespace

void describe(EdgesOptions& o, OptionVisitor& visit) {
  visit.group("Edges");
  visit.choice({"edges", "Edge detector: gradient or lsd"}, o.method, METHODS);
  visit.number(
      {"edge-sigma", "Standard deviation of the blur before the image is differentiated, px"},
      o.gradient.sigma_px, 0.3f, 8.0f);
  visit.number({"edge-low", "Pixels with a lower gradient are no edge, grey levels per px"},
               o.gradient.low_threshold, 0.1f, 127.0f);
  visit.number({"edge-high",
                "A chain of edge pixels needs at least one of this gradient, grey levels per px"},
               o.gradient.high_threshold, 0.1f, 127.0f);
  visit.number({"edge-min-length", "Shortest chain of edge pixels that is kept, px"},
               o.gradient.min_length_px, 1, 10000);
  visit.flag({"faint-edges", "Also find long faint edges, at a coarser scale (default)"},
             o.faint_edges);
}

void EdgesOptions::validate() const {
  gradient.validate();
  faint.validate();
  check_bounds(*this, "edge");
  BoundsCheck("edge").require("faint_clearance", faint_clearance_px, 0, EdgeIndex::MAX_RADIUS_PX);
  lsd.validate();
}

EdgeMethod edge_method_from_name(const std::string& name) {
  for (const EdgeMethod method : {EdgeMethod::Gradient, EdgeMethod::Lsd})
    if (name == name_of(method)) return method;
  throw InputError("options", "edge.method", "\"" + name + "\"", "gradient or lsd");
}

std::string name_of(EdgeMethod method) { return METHODS[int(method)]; }

std::vector<EdgePoint> find_edges(const Image& image, const EdgesOptions& options,
                                  Backend& backend) {
  options.validate();
  if (options.method == EdgeMethod::Lsd) return lsd_edges(image, options.lsd);
  const ImageView view{image.width, image.height, image.pixels.data()};
  std::vector<EdgePoint> edges = backend.detect_edges(view, options.gradient);
  if (!options.faint_edges) return edges;
  constexpr float any_turn = 4;
  const EdgeReach near(options.faint_clearance_px, any_turn);
  const EdgeIndex fine(edges, image.width, image.height);
  for (const EdgePoint& edge : backend.detect_edges(view, options.faint))
    if (!fine.nearest({edge.x_px, edge.y_px}, Eigen::Vector2f::UnitX(), near))
      edges.push_back(edge);
  return edges;
}

}  // namespace edgescout
