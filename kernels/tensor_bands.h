// How many pieces of a tensor a shader can have bound (kernels/gpu/tensor.h says why).
#ifndef EDGESCOUT_TENSOR_BANDS_H
#define EDGESCOUT_TENSOR_BANDS_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(TENSOR_MAX_BANDS, 4);
EDGESCOUT_CONST(TENSOR_BAND_ROW_STEP,
                32);  // bands begin at multiples of it: no workgroup spans two, offsets are aligned
#ifdef __cplusplus
}  // namespace edgescout
#endif
#endif
