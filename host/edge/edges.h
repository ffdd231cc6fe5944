// Image -> edge points, by either method.
#pragma once

#include <string>
#include <vector>

#include "host/core/types.h"
#include "host/edge/lsd_edges.h"
#include "kernels/edge_detect.h"

namespace edgescout {

class Backend;

enum class EdgeMethod {
  Gradient,  // the project's own detector, on whatever device the backend is; curves and low
             // contrast too
  Lsd,       // straight segments, always on the CPU
};

// The gradient detector runs twice: once fine, once on a stronger blur with lower thresholds, where
// only long chains count. The second pass finds faint edges of a grey level or two; its points are
// taken only where the first pass has none near, since blur displaces edges.
struct EdgesOptions {
  EdgeMethod method = EdgeMethod::Gradient;
  EdgeOptions gradient;
  bool faint_edges = true;
  EdgeOptions faint{2.5f, 0.3f, 0.6f, 30};
  float faint_clearance_px = 3;  // from every edge of the first pass
  LsdOptions lsd;
  void validate() const;  // throws InputError naming field and bound
};

// "gradient" or "lsd"; InputError on another word.
EdgeMethod edge_method_from_name(const std::string& name);
std::string name_of(EdgeMethod method);

std::vector<EdgePoint> find_edges(const Image& image, const EdgesOptions& options,
                                  Backend& backend);

}  // namespace edgescout
