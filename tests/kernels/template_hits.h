// Hits of template_score and template_scan, compared and printed.
#pragma once

#include <ostream>

#include "kernels/template_score.h"

namespace edgescout {

inline bool operator==(const TemplateHit& a, const TemplateHit& b) {
  return a.sum == b.sum && a.x == b.x && a.y == b.y;
}
inline std::ostream& operator<<(std::ostream& out, const TemplateHit& hit) {
  return out << "sum " << hit.sum << " at " << hit.x << ", " << hit.y;
}

}  // namespace edgescout
