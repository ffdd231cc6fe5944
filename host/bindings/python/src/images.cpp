#include "host/bindings/python/src/arrays.h"
#include "host/bindings/python/src/parts.h"

namespace edgescout::python {

namespace {

void save_image(const py::array& array, const std::filesystem::path& file) {
  if (array.ndim() == 2) return save_png(image_of(array), file);
  if (!py::isinstance<py::array_t<std::uint8_t>>(array) || array.ndim() != 3 || array.shape(2) != 3)
    refuse("image", found(array), "uint8 of shape (height, width) or (height, width, 3)");
  const auto packed = py::array_t<std::uint8_t, py::array::c_style>::ensure(array);
  save_png(RgbImage{int(packed.shape(1)),
                    int(packed.shape(0)),
                    {packed.data(), packed.data() + packed.size()}},
           file);
}

}  // namespace

void add_images(py::module_& module) {
  module.def(
      "load_image",
      [](const std::filesystem::path& file, const ImageOptions* options) {
        return array_of(load_image(file, options ? *options : ImageOptions{}));
      },
      py::arg("file"), py::arg("options") = nullptr,
      "A grey image, (height, width) uint8, as `edgescout detect` reads it.");
  module.def(
      "to_grey",
      [](const py::array& image, const ImageOptions* options) {
        return array_of(image_of(image, options ? *options : ImageOptions{}));
      },
      py::arg("image"), py::arg("options") = nullptr,
      "The 8-bit grey image that detection makes of an array, with options of its own.");
  module.def("save_png", &save_image, py::arg("image"), py::arg("file"),
             "image: uint8, (height, width) or (height, width, 3) in the order red, green, blue.");
  module.def(
      "undistort",
      [](const py::array& image, const Camera& camera) {
        return array_of(undistort(image_of(image), camera));
      },
      py::arg("image"), py::arg("camera"), "The image of camera.undistorted(), grey.");
}

}  // namespace edgescout::python
