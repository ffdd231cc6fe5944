// numpy arrays in and out: grey images, poses as 4x4 matrices, vertices.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>
#include <vector>

#include "host/core/depth_image.h"
#include "host/core/types.h"
#include "host/io/depth_options.h"
#include "host/io/image.h"

namespace edgescout::python {

namespace py = pybind11;

// "float64 of shape (480, 640)"
std::string found(const py::array& array);

// ValueError "NAME: found FOUND, expected EXPECTED".
[[noreturn]] void refuse(const std::string& name, const std::string& found,
                         const std::string& expected);

// A grey image of an array of (height, width), or of (height, width, 3 or 4) in the order red,
// green, blue; or of 16 bit or float32, (height, width), scaled to 8 bit by the options. Any
// strides. ValueError: another type or shape.
Image image_of(const py::array& array, const ImageOptions& options = {});

// A depth image of an array of (height, width), uint16 or float32. Any strides. ValueError: another
// type or shape; InputError: depth_image (io/depth_file.h) refuses the values.
DepthImage depth_of(const py::array& array, const DepthOptions& options);

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

// Of shape (n, 3). ValueError: another shape, values that are no numbers.
std::vector<Eigen::Vector3d> points_of(const py::handle& points, const std::string& name);
std::vector<std::array<int, 3>> triangles_of(const py::handle& triangles, const std::string& name);

}  // namespace edgescout::python
