// numpy arrays in and out: poses as 4x4 matrices, vertices; images out (in: array_pixels.h).
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>
#include <vector>

#include "host/core/types.h"
#include "host/io/image.h"

namespace edgescout::python {

namespace py = pybind11;

// "float64 of shape (480, 640)"
std::string found(const py::array& array);

// ValueError "NAME: found FOUND, expected EXPECTED".
[[noreturn]] void refuse(const std::string& name, const std::string& found,
                         const std::string& expected);

// "Mesh"
std::string type_name(const py::handle& value);

// refuse() of what numpy makes no array of.
[[noreturn]] void refuse_no_array(const py::handle& value, const std::string& name);

// What numpy makes an array of. ValueError naming `name`: anything else.
template <typename Array>
Array array_like(const py::handle& value, const std::string& name) {
  Array array = Array::ensure(value);
  if (!array) refuse_no_array(value, name);
  return array;
}

// (height, width) and (height, width, 3); they own their memory.
py::array_t<std::uint8_t> array_of(const Image& image);
py::array_t<std::uint8_t> array_of(const RgbImage& image);

// A homogeneous matrix of 4x4. ValueError naming `name`: another shape, a last row other than
// 0 0 0 1, a rotation that is none.
Se3 pose_of(const py::handle& matrix, const std::string& name);
std::vector<Se3> poses_of(const py::handle& matrices, const std::string& name);
py::array_t<double> matrix_of(const Se3& pose);
py::array_t<double> matrices_of(const std::vector<Se3>& poses);

py::array_t<double> array_of(const Matrix6d& matrix);
py::array_t<double> array_of(const Eigen::Vector3d& vector);

// Of shape (n, 3). ValueError: another shape, values that are no numbers, or no whole ones.
std::vector<Eigen::Vector3d> points_of(const py::handle& points, const std::string& name);
std::vector<std::array<int, 3>> triangles_of(const py::handle& triangles, const std::string& name);

}  // namespace edgescout::python
