#include "host/core/pose_matrix.h"

#include "kernels/error.h"

namespace edgescout {

using RowMajor4d = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Se3 pose_of_rows(std::span<const double, 16> rows, const std::string& name) {
  const Eigen::Map<const RowMajor4d> matrix(rows.data());
  if (!matrix.allFinite())
    throw InputError(name + ": found a value that is not finite, expected finite numbers");
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw InputError(name + ": found another last row, expected 0 0 0 1");
  try {
    return se3_from_matrix(matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>());
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  }
}

void write_rows(const Se3& pose, std::span<double, 16> rows) {
  Eigen::Map<RowMajor4d> matrix(rows.data());
  matrix.setIdentity();
  matrix.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = pose.translation_m;
}

}  // namespace edgescout
