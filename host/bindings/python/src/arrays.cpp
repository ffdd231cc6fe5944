#include "host/bindings/python/src/arrays.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "host/core/pose_matrix.h"

namespace edgescout::python {

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

Doubles rows_of_three(const py::handle& value, const std::string& name) {
  Doubles rows = array_like<Doubles>(value, name);
  if (rows.ndim() != 2 || rows.shape(1) != 3) refuse(name, found(rows), "shape (n, 3)");
  return rows;
}

py::array_t<std::uint8_t> copied(const std::vector<std::uint8_t>& pixels,
                                 std::vector<py::ssize_t> shape) {
  py::array_t<std::uint8_t> array(std::move(shape));
  std::ranges::copy(pixels, array.mutable_data());
  return array;
}

using Rows = std::span<const double, 16>;

bool is_index(double value) {
  return value >= std::numeric_limits<int>::min() && value <= std::numeric_limits<int>::max() &&
         value == std::trunc(value);
}

}  // namespace

std::string found(const py::array& array) {
  return fmt::format("{} of shape {}", std::string(py::str(array.dtype())),
                     std::string(py::str(py::object(array.attr("shape")))));
}

void refuse(const std::string& name, const std::string& found, const std::string& expected) {
  throw py::value_error(fmt::format("{}: found {}, expected {}", name, found, expected));
}

std::string type_name(const py::handle& value) {
  return py::str(py::type::of(value).attr("__name__"));
}

void refuse_no_array(const py::handle& value, const std::string& name) {
  refuse(name, type_name(value), "an array of numbers");
}

py::array_t<std::uint8_t> array_of(const Image& image) {
  return copied(image.pixels, {image.height, image.width});
}

py::array_t<std::uint8_t> array_of(const RgbImage& image) {
  return copied(image.pixels, {image.height, image.width, 3});
}

Se3 pose_of(const py::handle& value, const std::string& name) {
  const Doubles matrix = array_like<Doubles>(value, name);
  if (matrix.ndim() != 2 || matrix.shape(0) != 4 || matrix.shape(1) != 4)
    refuse(name, found(matrix), "shape (4, 4)");
  return pose_of_rows(Rows(matrix.data(), 16), name);
}

std::vector<Se3> poses_of(const py::handle& value, const std::string& name) {
  const Doubles matrices = array_like<Doubles>(value, name);
  if (matrices.ndim() != 3 || matrices.shape(1) != 4 || matrices.shape(2) != 4)
    refuse(name, found(matrices), "shape (n, 4, 4)");
  std::vector<Se3> poses;
  for (py::ssize_t i = 0; i < matrices.shape(0); ++i)
    poses.push_back(pose_of_rows(Rows(matrices.data(i, 0, 0), 16), fmt::format("{}[{}]", name, i)));
  return poses;
}

py::array_t<double> matrix_of(const Se3& pose) {
  py::array_t<double> matrix({4, 4});
  write_rows(pose, std::span<double, 16>(matrix.mutable_data(), 16));
  return matrix;
}

py::array_t<double> matrices_of(const std::vector<Se3>& poses) {
  py::array_t<double> matrices({py::ssize_t(poses.size()), py::ssize_t(4), py::ssize_t(4)});
  for (std::size_t i = 0; i < poses.size(); ++i)
    write_rows(poses[i], std::span<double, 16>(matrices.mutable_data(py::ssize_t(i), 0, 0), 16));
  return matrices;
}

py::array_t<double> array_of(const Matrix6d& matrix) {
  py::array_t<double> array({6, 6});
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(array.mutable_data()) = matrix;
  return array;
}

py::array_t<double> array_of(const Eigen::Vector3d& vector) {
  py::array_t<double> array(3);
  Eigen::Map<Eigen::Vector3d>(array.mutable_data()) = vector;
  return array;
}

std::vector<Eigen::Vector3d> points_of(const py::handle& value, const std::string& name) {
  const Doubles rows = rows_of_three(value, name);
  std::vector<Eigen::Vector3d> points;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i)
    points.emplace_back(rows.at(i, 0), rows.at(i, 1), rows.at(i, 2));
  return points;
}

std::vector<std::array<int, 3>> triangles_of(const py::handle& value, const std::string& name) {
  const Doubles rows = rows_of_three(value, name);
  std::vector<std::array<int, 3>> triangles;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    for (py::ssize_t k = 0; k < 3; ++k)
      if (!is_index(rows.at(i, k)))
        refuse(name, fmt::format("{}", rows.at(i, k)), "an index of a vertex");
    triangles.push_back({int(rows.at(i, 0)), int(rows.at(i, 1)), int(rows.at(i, 2))});
  }
  return triangles;
}

}  // namespace edgescout::python
