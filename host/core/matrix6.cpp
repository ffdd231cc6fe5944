#include "host/core/matrix6.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace edgescout {

Vector6d solve(const Matrix6d& symmetric, const Vector6d& right) {
  return symmetric.ldlt().solve(right);
}

Matrix6d solve(const Matrix6d& symmetric, const Matrix6d& right) {
  return symmetric.ldlt().solve(right);
}

std::optional<Matrix6d> inverse_of_positive(const Matrix6d& symmetric) {
  const Eigen::LDLT<Matrix6d> factor(symmetric);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 0)) return std::nullopt;
  return factor.solve(Matrix6d::Identity());
}

Matrix6d inverse(const Matrix6d& matrix) { return matrix.inverse(); }

double determinant(const Matrix6d& matrix) { return matrix.determinant(); }

Eigenvectors6 eigenvectors(const Matrix6d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace edgescout
