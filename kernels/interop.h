// Lets GLSL and C++ read one header: constants and push-constant structs are written once. Only
// 32-bit scalars may stand in a shared struct (a vec3 sits at another offset in std430).
#ifndef EDGESCOUT_INTEROP_H
#define EDGESCOUT_INTEROP_H

#ifdef __cplusplus
#include <cstdint>
#define EDGESCOUT_CONST(name, value) inline constexpr std::uint32_t name = value
namespace edgescout {
using uint = std::uint32_t;
}
#else
#define EDGESCOUT_CONST(name, value) const uint name = value
#endif

#endif
