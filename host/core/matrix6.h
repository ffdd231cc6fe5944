// Solutions of a pose's 6 x 6 systems.
//
// They are compiled once, in matrix6.cpp: each file that instantiates a decomposition of Eigen
// takes seconds longer to compile.
#pragma once

#include <optional>

#include "host/core/se3.h"

namespace edgescout {

// Returns x of `symmetric` * x = `right`, by LDL^T. Not finite where `symmetric` is singular.
Vector6d solve(const Matrix6d& symmetric, const Vector6d& right);
Matrix6d solve(const Matrix6d& symmetric, const Matrix6d& right);

// Nothing where `symmetric` is not positive definite.
std::optional<Matrix6d> inverse_of_positive(const Matrix6d& symmetric);

Matrix6d inverse(const Matrix6d& matrix);
double determinant(const Matrix6d& matrix);

struct Eigenvectors6 {
  Vector6d values = Vector6d::Zero();   // ascending
  Matrix6d vectors = Matrix6d::Zero();  // columns of length 1
};

Eigenvectors6 eigenvectors(const Matrix6d& symmetric);

}  // namespace edgescout
