#include "host/bindings/python/src/arrays.h"

#include <fmt/format.h>

#include "host/core/pose_matrix.h"
#include "host/io/depth_file.h"
#include "kernels/error.h"

namespace edgescout::python {

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

// Of anything that numpy makes an array of.
template <typename Array>
Array array_like(const py::handle& value, const std::string& name) {
  Array array = Array::ensure(value);
  if (array) return array;
  PyErr_Clear();
  refuse(name, py::str(py::type::of(value).attr("__name__")), "an array of numbers");
}

template <typename Array>
Array rows_of_three(const py::handle& value, const std::string& name) {
  Array rows = array_like<Array>(value, name);
  if (rows.ndim() != 2 || rows.shape(1) != 3) refuse(name, found(rows), "shape (n, 3)");
  return rows;
}

// ITU-R BT.601, as OpenCV weighs colours.
std::uint8_t grey(double red, double green, double blue) {
  return std::uint8_t(0.299 * red + 0.587 * green + 0.114 * blue + 0.5);
}

py::array_t<std::uint8_t> copied(const std::vector<std::uint8_t>& pixels,
                                 std::vector<py::ssize_t> shape) {
  py::array_t<std::uint8_t> array(std::move(shape));
  std::ranges::copy(pixels, array.mutable_data());
  return array;
}

using Rows = std::span<const double, 16>;

}  // namespace

std::string found(const py::array& array) {
  return fmt::format("{} of shape {}", std::string(py::str(array.dtype())),
                     std::string(py::str(py::object(array.attr("shape")))));
}

void refuse(const std::string& name, const std::string& found, const std::string& expected) {
  throw py::value_error(fmt::format("{}: found {}, expected {}", name, found, expected));
}

// Of a sensor's own values.
template <typename Value>
Image deep_image_of(const py::array& array, const ImageOptions& options) {
  const auto packed = py::array_t<Value, py::array::c_style>::ensure(array);
  return grey_image({packed.data(), std::size_t(packed.size())}, int(packed.shape(1)),
                    int(packed.shape(0)), options);
}

Image image_of(const py::array& array, const ImageOptions& options) {
  if (array.ndim() == 2 && array.size() > 0) {
    if (py::isinstance<py::array_t<std::uint16_t>>(array))
      return deep_image_of<std::uint16_t>(array, options);
    if (py::isinstance<py::array_t<float>>(array)) return deep_image_of<float>(array, options);
  }
  const bool is_grey = array.ndim() == 2,
             is_colour = array.ndim() == 3 && (array.shape(2) == 3 || array.shape(2) == 4);
  if (!py::isinstance<py::array_t<std::uint8_t>>(array) || !(is_grey || is_colour))
    refuse("image", found(array),
           "uint8 of shape (height, width) or (height, width, 3), or uint16 or float32 of shape "
           "(height, width)");
  if (array.size() == 0) refuse("image", found(array), "pixels");
  Image image{int(array.shape(1)), int(array.shape(0)), {}};
  image.pixels.resize(std::size_t(image.width) * std::size_t(image.height));
  const auto packed = py::array_t<std::uint8_t, py::array::c_style>::ensure(array);
  const std::uint8_t* const values = packed.data();
  if (is_grey) {
    std::copy_n(values, image.pixels.size(), image.pixels.begin());
    return image;
  }
  const auto channels = std::size_t(packed.shape(2));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const std::uint8_t* const colour = values + channels * i;
    image.pixels[i] = grey(colour[0], colour[1], colour[2]);
  }
  return image;
}

template <typename Value>
DepthImage depth_of_values(const py::array& array, const DepthOptions& options) {
  const auto packed = py::array_t<Value, py::array::c_style>::ensure(array);
  return depth_image(std::span<const Value>(packed.data(), std::size_t(packed.size())),
                     int(packed.shape(1)), int(packed.shape(0)), options);
}

DepthImage depth_of(const py::array& array, const DepthOptions& options) {
  if (array.ndim() == 2 && array.size() > 0) {
    if (py::isinstance<py::array_t<std::uint16_t>>(array))
      return depth_of_values<std::uint16_t>(array, options);
    if (py::isinstance<py::array_t<float>>(array)) return depth_of_values<float>(array, options);
  }
  refuse("depth", found(array), "uint16 (mm) or float32 (m) of shape (height, width)");
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
  const Doubles rows = rows_of_three<Doubles>(value, name);
  std::vector<Eigen::Vector3d> points;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i)
    points.emplace_back(rows.at(i, 0), rows.at(i, 1), rows.at(i, 2));
  return points;
}

std::vector<std::array<int, 3>> triangles_of(const py::handle& value, const std::string& name) {
  const Integers rows = rows_of_three<Integers>(value, name);
  std::vector<std::array<int, 3>> triangles;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    for (py::ssize_t k = 0; k < 3; ++k)
      if (rows.at(i, k) != int(rows.at(i, k)))
        refuse(name, std::to_string(rows.at(i, k)), "an index of a vertex");
    triangles.push_back({int(rows.at(i, 0)), int(rows.at(i, 1)), int(rows.at(i, 2))});
  }
  return triangles;
}

}  // namespace edgescout::python
