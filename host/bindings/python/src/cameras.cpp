#include "host/bindings/python/src/arrays.h"
#include "host/bindings/python/src/parts.h"
#include "host/io/camera_file.h"

namespace edgescout::python {

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Numbers in one row or column, as OpenCV's (1, n).
std::vector<double> coefficients_of(const py::handle& distortion) {
  const auto given = array_like<Doubles>(distortion, "distortion");
  const py::ssize_t most = LensCoefficients{}.size();
  const bool is_list =
      given.ndim() == 1 || (given.ndim() == 2 && (given.shape(0) == 1 || given.shape(1) == 1));
  if (!is_list || given.size() > most)
    refuse("distortion", found(given), "a list of at most " + std::to_string(most) + " numbers");
  return {given.data(), given.data() + given.size()};
}

// fx skew cx, 0 fy cy, 0 0 1
void set_intrinsics(Camera& camera, const py::handle& matrix) {
  const auto k = array_like<Doubles>(matrix, "K");
  if (k.ndim() != 2 || k.shape(0) != 3 || k.shape(1) != 3) refuse("K", found(k), "shape (3, 3)");
  if (k.at(1, 0) != 0 || k.at(2, 0) != 0 || k.at(2, 1) != 0 || k.at(2, 2) != 1)
    refuse("K", py::str(k.attr("tolist")()), "fx skew cx, 0 fy cy, 0 0 1");
  camera.fx = k.at(0, 0);
  camera.skew = k.at(0, 1);
  camera.cx = k.at(0, 2);
  camera.fy = k.at(1, 1);
  camera.cy = k.at(1, 2);
}

Camera make_camera(int width, int height, const py::object& k, const py::object& distortion,
                   LensModel lens) {
  Camera camera{width, height};
  set_intrinsics(camera, k);
  std::ranges::copy(coefficients_of(distortion), camera.distortion.begin());
  camera.lens = lens;
  validate(camera, "camera");
  return camera;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

Camera with_size(const Camera& camera, int width, int height) {
  const bool has_size = camera.width != 0 || camera.height != 0;
  if (has_size && (camera.width != width || camera.height != height))
    refuse("size", size_text(width, height),
           "the camera's " + size_text(camera.width, camera.height) + "; scaled() changes it");
  Camera sized = camera;
  sized.width = width;
  sized.height = height;
  validate(sized, "camera");
  return sized;
}

Camera resized(const Camera& camera, double factor) {
  constexpr double most = 1000;
  if (!(factor > 0 && factor <= most))
    refuse("factor", py::str(py::cast(factor)), "a number above 0, at most 1000");
  const Camera result = scaled(camera, factor);
  if (camera.width > 0) validate(result, "camera");
  return result;
}

py::array_t<double> intrinsic_matrix(const Camera& c) {
  py::array_t<double> k({3, 3});
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(k.mutable_data()) << c.fx, c.skew, c.cx,
      0, c.fy, c.cy, 0, 0, 1;
  return k;
}

void add_lens_models(py::module_& module) {
  py::enum_<LensModel>(module, "LensModel", "How a lens moves the image of a direction.")
      .value("BROWN_CONRADY", LensModel::BrownConrady, "OpenCV: k1 k2 p1 p2 k3 k4 k5 k6 s1 .. s4")
      .value("MODIFIED_BROWN_CONRADY", LensModel::ModifiedBrownConrady, "RealSense")
      .value("FISHEYE", LensModel::Fisheye, "Kannala-Brandt: k1 .. k6 p1 p2 s1 .. s4")
      .value("THIN_PRISM_FISHEYE", LensModel::ThinPrismFisheye, "COLMAP: k1 k2 p1 p2 k3 k4 s1 s2")
      .value("FIELD_OF_VIEW", LensModel::FieldOfView, "the angle omega, rad");
}

void add_camera_class(py::module_& module) {
  py::class_<Camera>(module, "Camera",
                     "A pinhole camera with a lens. Its frame has z forward, x right, y down; "
                     "pixel centres are at integers. Lengths in px.")
      .def(py::init(&make_camera), py::arg("width"), py::arg("height"), py::arg("K"),
           py::arg("distortion") = py::tuple(), py::arg("lens") = LensModel::BrownConrady,
           "K: (3, 3), px: fx skew cx, 0 fy cy, 0 0 1. distortion: at most 14 coefficients in the "
           "order of `lens`.")
      .def_readonly("width", &Camera::width, "px; 0: that of the image.")
      .def_readonly("height", &Camera::height, "px; 0: that of the image.")
      .def_property_readonly("K", &intrinsic_matrix, "(3, 3) float64, px, skew included.")
      .def_property_readonly(
          "distortion",
          [](const Camera& c) { return py::array_t<double>(14, c.distortion.data()); },
          "(14,) float64, in the order of `lens`.")
      .def_readonly("lens", &Camera::lens, "The model that the coefficients of distortion are of.")
      .def("undistorted", &undistorted, "The pinhole camera of the undistorted image.")
      .def("scaled", &resized, py::arg("factor"), "The camera of a resized image.")
      .def("with_size", &with_size, py::arg("width"), py::arg("height"),
           "The camera with the size of its images, for one that a file without a size gave.")
      .def("__eq__", &same_camera)
      .def("__repr__", [](const Camera& c) {
        return py::str("Camera({}x{}, fx={:.2f}, fy={:.2f}, cx={:.2f}, cy={:.2f})")
            .format(c.width, c.height, c.fx, c.fy, c.cx, c.cy);
      });
}

}  // namespace

void add_cameras(py::module_& module) {
  add_lens_models(module);
  add_camera_class(module);
  module.def("load_camera", &load_camera, py::arg("file"), py::arg("name") = "",
             "The camera of a calibration file of ROS, OpenCV, Kalibr, BOP and some fifteen others "
             "(docs/cameras.md). `name` chooses one of several. Its size may be (0, 0): then it "
             "takes that of the image. Scout and Tracker need one: with_size().");
}

}  // namespace edgescout::python
