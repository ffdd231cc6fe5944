#include "host/bindings/python/src/arrays.h"
#include "host/bindings/python/src/parts.h"
#include "host/bindings/python/src/shared_backend.h"
#include "host/io/bop.h"
#include "host/io/mesh.h"
#include "host/model/axis_symmetry.h"
#include "host/model/template_cache.h"
#include "kernels/error.h"

namespace edgescout::python {

namespace {

py::array_t<double> vertices_of(const Mesh& mesh) {
  py::array_t<double> rows({py::ssize_t(mesh.vertices_m.size()), py::ssize_t(3)});
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i)
    Eigen::Map<Eigen::Vector3d>(rows.mutable_data(py::ssize_t(i), 0)) = mesh.vertices_m[i];
  return rows;
}

py::array_t<int> triangles_of(const Mesh& mesh) {
  py::array_t<int> rows({py::ssize_t(mesh.triangles.size()), py::ssize_t(3)});
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    std::ranges::copy(mesh.triangles[i], rows.mutable_data(py::ssize_t(i), 0));
  return rows;
}

Symmetries symmetries_of(const py::object& given, const Mesh& mesh) {
  if (given.is_none()) return {};
  if (py::isinstance<py::str>(given)) {
    const auto words = py::cast<std::vector<std::string>>(given.attr("split")());
    return without_lock([&] { return axis_symmetries(mesh, words); });
  }
  const std::vector<Se3> transforms = poses_of(given, "symmetries");
  return without_lock([&] { return symmetries_of_transforms(transforms); });
}

// Built without the lock or read from the cache.
TemplateSet templates_of(const Object& object, TemplateOptions options,
                         const std::optional<Camera>& camera, const BackendPointer& backend,
                         bool cached) {
  if (camera)
    options = with_default_distances(options, object.mesh.diameter_m, undistorted(*camera));
  else if (!(options.distance_min_m > 0 && options.distance_max_m > 0))
    refuse("distance_min, distance_max", "0",
           "both, or a camera: then all distances at which the object fills a twentieth to all of "
           "the image are searched");
  return on_backend(backend, {}, [&](const TimeLimit& limit, Backend& on) {
    const auto progress = [&](int, int) {
      if (limit.is_cancelled()) throw Interrupted{};
    };
    if (!cached) return build_templates(object, options, on, progress);
    return TemplateCache(TemplateCacheOptions{.program = "python"})
        .get(object, options, on, progress)
        .set;
  });
}

void add_meshes(py::module_& module) {
  py::class_<Mesh>(module, "Mesh", "A triangle mesh in the object frame, in metres.")
      .def(py::init([](const py::object& vertices_m, const py::object& triangles,
                       const std::string& name) {
             auto points = points_of(vertices_m, "vertices_m");
             auto corners = python::triangles_of(triangles, "triangles");
             return without_lock(
                 [&] { return make_mesh(name, std::move(points), std::move(corners)); });
           }),
           py::arg("vertices_m"), py::arg("triangles"), py::arg("name") = "mesh",
           "vertices_m: (n, 3), metres. triangles: (m, 3), counter-clockwise seen from outside. "
           "Defects are repaired as in load_mesh.")
      .def_readonly("name", &Mesh::name, "Of its file, or as given.")
      .def_property_readonly("vertices_m", &vertices_of, "(n, 3) float64, metres; a copy.")
      .def_property_readonly("triangles", &triangles_of, "(m, 3) int32; a copy.")
      .def_readonly("diameter_m", &Mesh::diameter_m,
                    "The largest distance between two of its vertices.")
      .def("__repr__", [](const Mesh& mesh) {
        return py::str("Mesh({}, {} triangles, {:.1f} mm)")
            .format(mesh.name, mesh.triangles.size(), 1e3 * mesh.diameter_m);
      });
  module.def(
      "load_mesh",
      [](const std::filesystem::path& file, const std::string& unit) {
        const LengthUnit given = length_unit(unit);
        return without_lock([&] { return load_mesh(file, given); });
      },
      py::arg("file"), py::arg("unit"),
      "Reads and repairs a mesh. unit: mm, cm, m or in, what one unit of the file is.");
}

using TemplatesClass = py::class_<TemplateSet, std::shared_ptr<TemplateSet>>;

void add_building(TemplatesClass& templates) {
  templates
      .def(py::init([](const Mesh& mesh, const TemplateOptions* options,
                       const std::optional<Camera>& camera, const py::object& symmetries,
                       int object_id, const BackendPointer& backend, bool cached) {
             const Object object{object_id, mesh, symmetries_of(symmetries, mesh)};
             return std::make_shared<TemplateSet>(templates_of(
                 object, options ? *options : TemplateOptions{}, camera, backend, cached));
           }),
           py::arg("mesh"), py::arg("options") = nullptr, py::kw_only(),
           py::arg("camera") = std::nullopt, py::arg("symmetries") = py::none(),
           py::arg("object_id") = 1, py::arg("backend") = nullptr, py::arg("cached") = true,
           "Builds the templates, or reads them where they were built before (cached). Without "
           "distances in the options the camera decides. symmetries: words such as \"z2\" or "
           "\"x4 z4\", or (n, 4, 4) transforms that map the object onto itself.")
      .def_static(
          "without_views",
          [](const Mesh& mesh, const py::object& symmetries, int object_id) {
            const Object object{object_id, mesh, symmetries_of(symmetries, mesh)};
            return without_lock(
                [&] { return std::make_shared<TemplateSet>(without_views(object)); });
          },
          py::arg("mesh"), py::kw_only(), py::arg("symmetries") = py::none(),
          py::arg("object_id") = 1,
          "Of an object that is registered or tracked from given poses: there is nothing to build, "
          "and it cannot be searched for.");
}

void add_files(TemplatesClass& templates) {
  templates
      .def_static(
          "load",
          [](const std::filesystem::path& file) {
            return without_lock(
                [&] { return std::make_shared<TemplateSet>(load_templates(file)); });
          },
          py::arg("file"), "Reads what save() or `edgescout model build` wrote.")
      .def(
          "save",
          [](const TemplateSet& set, const std::filesystem::path& file) {
            without_lock([&] { save_templates(set, file); });
          },
          py::arg("file"), "Writes a file that load() reads, whole or not at all.");
}

void add_contents(TemplatesClass& templates) {
  templates.def_readonly("object_id", &TemplateSet::object_id, "As given; BOP's obj_id.")
      .def_property_readonly(
          "mesh", [](const TemplateSet& set) { return set.model.mesh; }, "Of the object; a copy.")
      .def_property_readonly(
          "symmetries", [](const TemplateSet& set) { return matrices_of(set.symmetries.discrete); },
          "(n, 4, 4) float64; the first is the identity.")
      .def_readonly("options", &TemplateSet::options, "With which they were built.")
      .def("__repr__", [](const TemplateSet& set) {
        return py::str("Templates({}, object {}, {:.3f} to {:.3f} m)")
            .format(set.model.mesh.name, set.object_id, set.options.distance_min_m,
                    set.options.distance_max_m);
      });
}

}  // namespace

void add_models(py::module_& module) {
  add_meshes(module);
  TemplatesClass templates(module, "Templates",
                           "What detection knows of one object: its mesh, symmetries, views.");
  add_building(templates);
  add_files(templates);
  add_contents(templates);
}

}  // namespace edgescout::python
