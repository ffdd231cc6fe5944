// Computes the visible surface discrepancy of all estimates of an evaluation that BOP looks at.
#pragma once

#include <map>
#include <span>

#include "host/eval/recall.h"

namespace edgescout {

class ThreadPool;

inline constexpr double VSD_DELTA_M = 0.015;  // BOP's tolerance of visibility

// Reads the depth image of every image that has one and fills `vsd`. InputError: a depth image that
// cannot be read or has another size than its camera; an object that is not in `objects`.
void add_vsd(std::span<EvaluationImage> images, const std::map<int, Object>& objects,
             double delta_m, ThreadPool& pool);

}  // namespace edgescout
