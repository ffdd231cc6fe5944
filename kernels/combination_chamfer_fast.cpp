#include "kernels/combination_chamfer.h"

namespace edgescout {

std::vector<ChamferCell> combination_chamfer_fast(const ChamferView& view, const CombinationBits& combinations,
                                                  const ChamferOptions& options, ThreadPool&) {
  return combination_chamfer_reference(view, combinations, options);
}

}  // namespace edgescout
