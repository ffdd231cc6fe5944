// How a shader finds a value of a tensor that is bound in bands (kernels/gpu/tensor.h says why
// there are several).
#ifndef EDGESCOUT_TENSOR_BANDS_H
#define EDGESCOUT_TENSOR_BANDS_H

#include "tensor_layout.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(TENSOR_MAX_BANDS, 4);
// Bands begin at multiples of so many rows: no workgroup spans two, and their offsets are aligned.
EDGESCOUT_CONST(TENSOR_BAND_ROW_STEP, 32);

struct TensorGrid {
  uint width;
  uint height;
  uint bins;
  uint tiles_per_row;
  uint band_rows;  // of every band but the last
};
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
