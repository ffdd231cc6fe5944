// Whether a number is one, by its bits: a driver may take for granted that floats are neither NaN
// nor infinite, so that no comparison of them tells.
bool finite(float v) { return (floatBitsToUint(v) & 0x7f800000u) != 0x7f800000u; }
bool is_nan(float v) { return (floatBitsToUint(v) & 0x7fffffffu) > 0x7f800000u; }
