// Finds the edge points of an image by one of two methods.
//
// Public header.
#pragma once

#include <string>
#include <vector>

#include "host/core/options.h"
#include "host/core/types.h"
#include "host/edge/lsd_edges.h"
#include "kernels/edge_detect.h"

namespace edgescout {

class Backend;

enum class EdgeMethod {
  Gradient,  // the project's own detector on the backend's device; also finds curves and edges of
             // low contrast
  Lsd,       // straight segments, always on the CPU
};

// The gradient detector runs twice. The first pass is fine. The second one uses a stronger blur and
// lower thresholds and keeps long chains only: it finds faint edges of one or two grey levels. Blur
// displaces edges, so points of the second pass count only where the first pass has none near.
struct EdgesOptions {
  EdgeMethod method = EdgeMethod::Gradient;
  EdgeOptions gradient;
  bool faint_edges = true;
  EdgeOptions faint{2.5f, 0.3f, 0.6f, 30};
  float faint_clearance_px = 3;  // from every edge of the first pass
  LsdOptions lsd;
  void validate() const;  // InputError naming the field and the violated bound
};

void describe(EdgesOptions& options, OptionVisitor& visit);

// Returns the method named "gradient" or "lsd"; InputError on another word.
EdgeMethod edge_method_from_name(const std::string& name);
std::string name_of(EdgeMethod method);

std::vector<EdgePoint> find_edges(const Image& image, const EdgesOptions& options,
                                  Backend& backend);

}  // namespace edgescout
