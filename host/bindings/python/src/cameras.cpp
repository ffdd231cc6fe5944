#include "host/bindings/python/src/arrays.h"
#include "host/bindings/python/src/parts.h"
#include "host/io/camera_file.h"

namespace edgescout::python {

namespace {

Camera make_camera(int width, int height, std::array<double, 4> focal_and_centre_px,
                   const std::vector<double>& distortion, LensModel lens) {
  Camera camera{width,
                height,
                focal_and_centre_px[0],
                focal_and_centre_px[1],
                focal_and_centre_px[2],
                focal_and_centre_px[3]};
  if (distortion.size() > camera.distortion.size())
    refuse("distortion", std::to_string(distortion.size()) + " coefficients", "at most 14");
  std::ranges::copy(distortion, camera.distortion.begin());
  camera.lens = lens;
  validate(camera, "camera");
  return camera;
}

std::array<double, 4> intrinsics_of(const py::handle& matrix) {
  const auto k = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(matrix);
  if (!k) throw py::error_already_set();
  if (k.ndim() != 2 || k.shape(0) != 3 || k.shape(1) != 3) refuse("K", found(k), "shape (3, 3)");
  return {k.at(0, 0), k.at(1, 1), k.at(0, 2), k.at(1, 2)};
}

py::array_t<double> intrinsic_matrix(const Camera& c) {
  py::array_t<double> k({3, 3});
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(k.mutable_data()) << c.fx, c.skew, c.cx,
      0, c.fy, c.cy, 0, 0, 1;
  return k;
}

}  // namespace

void add_cameras(py::module_& module) {
  py::enum_<LensModel>(module, "LensModel", "How a lens moves the image of a direction.")
      .value("BROWN_CONRADY", LensModel::BrownConrady, "OpenCV: k1 k2 p1 p2 k3 k4 k5 k6 s1 .. s4")
      .value("MODIFIED_BROWN_CONRADY", LensModel::ModifiedBrownConrady, "RealSense")
      .value("FISHEYE", LensModel::Fisheye, "Kannala-Brandt: k1 .. k6 p1 p2 s1 .. s4")
      .value("THIN_PRISM_FISHEYE", LensModel::ThinPrismFisheye, "COLMAP: k1 k2 p1 p2 k3 k4 s1 s2")
      .value("FIELD_OF_VIEW", LensModel::FieldOfView, "the angle omega, rad");
  py::class_<Camera>(module, "Camera",
                     "A pinhole camera with a lens. Its frame has z forward, x right, y down; "
                     "pixel centres are at integers. Lengths in px.")
      .def(py::init([](int width, int height, const py::object& k,
                       const std::vector<double>& distortion, LensModel lens) {
             return make_camera(width, height, intrinsics_of(k), distortion, lens);
           }),
           py::arg("width"), py::arg("height"), py::arg("K"),
           py::arg("distortion") = std::vector<double>{}, py::arg("lens") = LensModel::BrownConrady,
           "K: (3, 3), px. distortion: at most 14 coefficients in the order of `lens`.")
      .def_readonly("width", &Camera::width)
      .def_readonly("height", &Camera::height)
      .def_property_readonly("K", &intrinsic_matrix, "(3, 3) float64, px.")
      .def_property_readonly(
          "distortion",
          [](const Camera& c) { return py::array_t<double>(14, c.distortion.data()); },
          "(14,) float64, in the order of `lens`.")
      .def_readonly("lens", &Camera::lens)
      .def("undistorted", &undistorted, "The pinhole camera of the undistorted image.")
      .def("scaled", &scaled, py::arg("factor"), "The camera of a resized image.")
      .def("__eq__", &same_camera)
      .def("__repr__", [](const Camera& c) {
        return py::str("Camera({}x{}, fx={:.2f}, fy={:.2f}, cx={:.2f}, cy={:.2f})")
            .format(c.width, c.height, c.fx, c.fy, c.cx, c.cy);
      });
  module.def("load_camera", &load_camera, py::arg("file"), py::arg("name") = "",
             "The camera of a calibration file of ROS, OpenCV, Kalibr, BOP and some fifteen others "
             "(docs/cameras.md). `name` chooses one of several. Its size may be (0, 0): then it "
             "takes that of the image.");
}

}  // namespace edgescout::python
