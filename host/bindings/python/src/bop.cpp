#include "host/io/bop.h"

#include "host/bindings/python/src/arrays.h"
#include "host/bindings/python/src/parts.h"
#include "kernels/error.h"

namespace edgescout::python {

namespace {

// Files may be large: other threads run while they are read and written.
using Unlocked = py::call_guard<py::gil_scoped_release>;

std::vector<std::string> cameras_of_scene(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw InputError(folder.string(), "folder", "none", "a scene in BOP's layout");
  return bop_cameras(folder);
}

void add_scenes(py::module_& module) {
  py::class_<BopTruth>(module, "BopTruth", "A true pose of a BOP scene.")
      .def_readonly("object_id", &BopTruth::object_id, "BOP's obj_id.")
      .def_property_readonly(
          "camera_from_object", [](const BopTruth& t) { return matrix_of(t.camera_from_object); },
          "4x4, metres.")
      .def_readonly("visible_fraction", &BopTruth::visible_fraction,
                    "1 where the scene does not say.");
  py::class_<BopImage>(module, "BopImage", "An image of a BOP scene, not yet read.")
      .def_readonly("image_id", &BopImage::image_id, "BOP's im_id.")
      .def_readonly("file", &BopImage::file, "Of the grey or colour image.")
      .def_readonly(
          "camera", &BopImage::camera,
          "Without a size: that is the image's. Scout and Tracker need Camera.with_size().")
      .def_property_readonly(
          "camera_from_world",
          [](const BopImage& image) -> py::object {
            if (!image.camera_from_world) return py::none();
            return matrix_of(*image.camera_from_world);
          },
          "4x4, metres; None where the scene has no world.");
  py::class_<BopScene>(module, "BopScene", "What one camera saw of a scene in BOP's layout.")
      .def_readonly("scene_id", &BopScene::scene_id, "That of the folder's name.")
      .def_readonly("camera_name", &BopScene::camera_name, "Of a scene with several cameras.")
      .def_readonly("images", &BopScene::images, "In the order of their ids.")
      .def(
          "truth",
          [](const BopScene& scene, int image_id) {
            const auto found = scene.truth.find(image_id);
            return found == scene.truth.end() ? std::vector<BopTruth>{} : found->second;
          },
          py::arg("image_id"), "True poses; empty where the scene has none.");
  module.def("bop_cameras", &cameras_of_scene, Unlocked(), py::arg("folder"),
             "The names of a scene's cameras; \"\" stands for that of scene_camera.json. "
             "InputError: no such folder.");
  module.def("load_bop_scene", &load_bop_scene, Unlocked(), py::arg("folder"),
             py::arg("camera_name") = "",
             "Reads scene_camera.json and, where it is there, scene_gt.json.");
}

void add_results(py::module_& module) {
  py::class_<BopResult>(module, "BopResult", "A row of a BOP results file.")
      .def(py::init([](int scene_id, int image_id, int object_id, double score,
                       const py::object& camera_from_object, double time_s,
                       const std::string& camera_name) {
             return BopResult{scene_id,
                              image_id,
                              object_id,
                              score,
                              pose_of(camera_from_object, "camera_from_object"),
                              time_s,
                              camera_name};
           }),
           py::arg("scene_id"), py::arg("image_id"), py::arg("object_id"), py::arg("score"),
           py::arg("camera_from_object"), py::arg("time_s") = -1.0, py::arg("camera_name") = "",
           "camera_from_object: 4x4, metres. time_s: of all rows of the image; below 0: unknown.")
      .def_readonly("scene_id", &BopResult::scene_id, "BOP's scene_id.")
      .def_readonly("image_id", &BopResult::image_id, "BOP's im_id.")
      .def_readonly("object_id", &BopResult::object_id, "BOP's obj_id.")
      .def_readonly("score", &BopResult::score, "The higher, the surer.")
      .def_property_readonly(
          "camera_from_object",
          [](const BopResult& row) { return matrix_of(row.camera_from_object); },
          "(4, 4) float64, metres.")
      .def_readonly("time_s", &BopResult::time_s, "Of all rows of the image; below 0: unknown.")
      .def_readonly("camera_name", &BopResult::camera_name, "Of a scene with several cameras.");
  module.def("load_bop_results", &load_bop_results, Unlocked(), py::arg("file"),
             "Rows of a results CSV. Those that hold no pose are left out, with a warning.");
  module.def("save_bop_results", &save_bop_results, Unlocked(), py::arg("results"), py::arg("file"),
             "Writes a results CSV, whole or not at all.");
}

}  // namespace

void add_bop(py::module_& module) {
  add_scenes(module);
  add_results(module);
}

}  // namespace edgescout::python
