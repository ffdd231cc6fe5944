// Poses as homogeneous matrices of 16 numbers, row by row: how other languages hold them.
//
// Public header.
#pragma once

#include <span>
#include <string>

#include "host/core/se3.h"

namespace edgescout {

// Returns the pose of a 4 x 4 matrix, given by row. InputError "NAME: found X, expected Y": a
// number that is not finite, a last row other than 0 0 0 1, a rotation that is none.
Se3 pose_of_rows(std::span<const double, 16> rows, const std::string& name);

void write_rows(const Se3& pose, std::span<double, 16> rows);

}  // namespace edgescout
