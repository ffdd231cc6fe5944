#include "host/edge/edges.h"

#include "kernels/backend.h"
#include "kernels/error.h"

namespace edgescout {

void EdgesOptions::validate() const {
  gradient.validate();
  lsd.validate();
}

EdgeMethod edge_method_from_name(const std::string& name) {
  if (name == "gradient") return EdgeMethod::Gradient;
  if (name == "lsd") return EdgeMethod::Lsd;
  throw InputError("options", "edge.method", "\"" + name + "\"", "gradient or lsd");
}

std::string name_of(EdgeMethod method) { return method == EdgeMethod::Lsd ? "lsd" : "gradient"; }

std::vector<EdgePoint> find_edges(const Image& image, const EdgesOptions& options, Backend& backend) {
  options.validate();
  if (options.method == EdgeMethod::Lsd) return lsd_edges(image, options.lsd);
  return backend.detect_edges({image.width, image.height, image.pixels.data()}, options.gradient);
}

}  // namespace edgescout
