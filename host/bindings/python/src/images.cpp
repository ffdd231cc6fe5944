#include "host/bindings/python/src/array_pixels.h"
#include "host/bindings/python/src/found_objects.h"
#include "host/bindings/python/src/interrupt.h"
#include "host/bindings/python/src/parts.h"

namespace edgescout::python {

namespace {

template <typename Picture>
void save_as(const py::array_t<std::uint8_t>& packed, const std::filesystem::path& file) {
  const Picture picture{
      int(packed.shape(1)), int(packed.shape(0)), {packed.data(), packed.data() + packed.size()}};
  without_lock([&] { save_png(picture, file); });
}

void save_image(const py::object& image, const std::filesystem::path& file) {
  const auto array = array_like<py::array>(image, "image");
  const bool is_grey = array.ndim() == 2, is_colour = array.ndim() == 3 && array.shape(2) == 3;
  if (!py::isinstance<py::array_t<std::uint8_t>>(array) || array.size() == 0 ||
      !(is_grey || is_colour))
    refuse("image", found(array), "pixels, uint8 of shape (height, width) or (height, width, 3)");
  const py::array_t<std::uint8_t> packed =
      py::array_t<std::uint8_t, py::array::c_style>::ensure(array);
  if (is_grey) return save_as<Image>(packed, file);
  save_as<RgbImage>(packed, file);
}

Image undistorted_image(const py::object& image, const Camera& camera) {
  const TakenImage taken = taken_image(image, camera, Se3{});
  return without_lock([&] { return undistort(taken.image, taken.camera); });
}

}  // namespace

void add_images(py::module_& module) {
  module.def(
      "load_image",
      [](const std::filesystem::path& file, const ImageOptions* options) {
        const ImageOptions used = options ? *options : ImageOptions{};
        return array_of(without_lock([&] { return load_image(file, used); }));
      },
      py::arg("file"), py::arg("options") = nullptr,
      "A grey image, (height, width) uint8, as `edgescout detect` reads it.");
  module.def(
      "to_grey",
      [](const py::object& image, const ImageOptions* options) {
        return array_of(image_of(image, options ? *options : ImageOptions{}));
      },
      py::arg("image"), py::arg("options") = nullptr,
      "The 8-bit grey image that detection makes of an array, with options of its own: what "
      "load_image makes of a file of the same pixels. image: uint8 or uint16, (height, width) or "
      "(height, width, 3 or 4) in the order red, green, blue; or float32, (height, width).");
  module.def("save_png", &save_image, py::arg("image"), py::arg("file"),
             "image: uint8, (height, width) or (height, width, 3) in the order red, green, blue.");
  module.def(
      "undistort",
      [](const py::object& image, const Camera& camera) {
        return array_of(undistorted_image(image, camera));
      },
      py::arg("image"), py::arg("camera"), "The image of camera.undistorted(), grey.");
}

}  // namespace edgescout::python
