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
  Gradient,  // the project's own detector, on whatever device the backend is; curves and low contrast too
  Lsd,       // straight segments, always on the CPU
};

struct EdgesOptions {
  EdgeMethod method = EdgeMethod::Gradient;
  EdgeOptions gradient;
  LsdOptions lsd;
  void validate() const;  // throws InputError naming field and bound
};

// "gradient" or "lsd"; InputError on another word.
EdgeMethod edge_method_from_name(const std::string& name);
std::string name_of(EdgeMethod method);

std::vector<EdgePoint> find_edges(const Image& image, const EdgesOptions& options, Backend& backend);

}  // namespace edgescout
