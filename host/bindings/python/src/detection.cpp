#include "host/bindings/python/src/arrays.h"
#include "host/bindings/python/src/interrupt.h"
#include "host/bindings/python/src/parts.h"
#include "host/bindings/python/src/shared_backend.h"
#include "host/overlay.h"
#include "host/pipeline.h"

namespace edgescout::python {

namespace {

using SetPointer = std::shared_ptr<TemplateSet>;

// One set or a sequence of them.
std::vector<TemplateSet> sets_of(const py::object& given) {
  std::vector<TemplateSet> sets;
  if (py::isinstance<TemplateSet>(given)) {
    sets.push_back(*py::cast<SetPointer>(given));
    return sets;
  }
  for (const SetPointer& set : py::cast<std::vector<SetPointer>>(given)) sets.push_back(*set);
  if (sets.empty()) refuse("templates", "none", "at least one");
  return sets;
}

// What an image shows, and where it was taken.
struct Shot {
  Image image;
  Camera camera;
  Se3 camera_from_world;
};

Shot shot_of(const py::array& image, const Camera& camera, const Se3& camera_from_world) {
  Shot shot{image_of(image), camera, camera_from_world};
  if (camera.width == 0 && camera.height == 0) {
    shot.camera.width = shot.image.width;
    shot.camera.height = shot.image.height;
  }
  if (shot.image.width != shot.camera.width || shot.image.height != shot.camera.height)
    refuse("image",
           std::to_string(shot.image.width) + "x" + std::to_string(shot.image.height) + " px",
           "the camera's " + std::to_string(camera.width) + "x" + std::to_string(camera.height));
  return shot;
}

// A detection with the identity of its object.
struct FoundObject : Detection {
  int object_id = 1;
  std::string name;
};

struct FoundObjects {
  std::vector<FoundObject> found;
  Completion completion = Completion::Complete;
  std::vector<StageSeconds> stages;
};

FoundObjects named(Detections&& detections, std::span<const TemplateSet> sets) {
  FoundObjects result{{}, detections.completion, std::move(detections.stages)};
  for (Detection& detection : detections.detections) {
    const TemplateSet& set = sets[std::size_t(detection.object)];
    result.found.push_back({std::move(detection), set.object_id, set.model.mesh.name});
  }
  return result;
}

PipelineOptions options_of(const PipelineOptions* given) {
  return given ? *given : PipelineOptions{};
}

FoundObjects detect(const py::array& image, const Camera& camera, const py::object& templates,
                    const PipelineOptions* options, const BackendPointer& backend,
                    std::optional<double> max_seconds) {
  const Shot shot = shot_of(image, camera, Se3{});
  const std::vector<TemplateSet> sets = sets_of(templates);
  PipelineOptions used = options_of(options);
  const BackendPointer on = backend_or_usual(backend);
  return named(without_lock(max_seconds,
                            [&](const TimeLimit& limit) {
                              used.limit = limit;
                              return on->use([&](Backend& b) {
                                return detect_objects(
                                    prepare_view(shot.image, shot.camera, Se3{}, b, used), sets, b,
                                    used);
                              });
                            }),
               sets);
}

FoundObjects detect_in_all(const std::vector<py::array>& images, const Camera& camera,
                           const py::object& camera_from_world, const py::object& templates,
                           const PipelineOptions* options, const BackendPointer& backend,
                           std::optional<double> max_seconds) {
  const std::vector<Se3> poses = poses_of(camera_from_world, "camera_from_world");
  if (poses.size() != images.size() || poses.empty())
    refuse("camera_from_world", std::to_string(poses.size()) + " poses",
           "one an image of " + std::to_string(images.size()));
  std::vector<Shot> shots;
  for (std::size_t i = 0; i < images.size(); ++i)
    shots.push_back(shot_of(images[i], camera, poses[i]));
  const std::vector<TemplateSet> sets = sets_of(templates);
  PipelineOptions used = options_of(options);
  const BackendPointer on = backend_or_usual(backend);
  const auto work = [&](const TimeLimit& limit) {
    used.limit = limit;
    return on->use([&](Backend& b) {
      std::vector<ObjectView> views;
      for (const Shot& shot : shots)
        views.push_back(prepare_view(shot.image, shot.camera, shot.camera_from_world, b, used));
      return detect_jointly(views, sets, b, used);
    });
  };
  return named(without_lock(max_seconds, work), sets);
}

py::array_t<std::uint8_t> overlay(const py::array& image, const Camera& camera,
                                  const std::vector<FoundObject>& found,
                                  const py::object& templates,
                                  const py::object& camera_from_world,
                                  const BackendPointer& backend) {
  const Se3 camera_pose = camera_from_world.is_none() ? Se3{}
                                                      : pose_of(camera_from_world,
                                                                "camera_from_world");
  const Shot shot = shot_of(image, camera, camera_pose);
  const std::vector<TemplateSet> sets = sets_of(templates);
  std::vector<OverlayPose> poses;
  for (const FoundObject& each : found) {
    if (each.object < 0 || std::size_t(each.object) >= sets.size())
      refuse("detections", "object " + std::to_string(each.object),
             "one of " + std::to_string(sets.size()) + " templates");
    poses.push_back({each.object, camera_pose * each.world_from_object, each.probability, ""});
  }
  const BackendPointer on = backend_or_usual(backend);
  const std::vector<EdgeModel> models = models_of(sets);
  return array_of(without_lock({}, [&](const TimeLimit&) {
    return on->use([&](Backend& b) {
      const ObjectView view = prepare_view(shot.image, shot.camera, camera_pose, b, {});
      return draw_overlay(*view.image, view.camera, poses, models, view.edges.get(), b);
    });
  }));
}

void add_results(py::module_& module) {
  py::class_<AlternativePose>(module, "Alternative", "Another pose that explains the same edges.")
      .def_property_readonly(
          "world_from_object",
          [](const AlternativePose& a) { return matrix_of(a.world_from_object); })
      .def_readonly("probability", &AlternativePose::probability);
  py::class_<FoundObject>(module, "Detection", "One object that was found.")
      .def_readonly("object", &FoundObject::object, "Index into the templates that were given.")
      .def_readonly("object_id", &FoundObject::object_id)
      .def_readonly("name", &FoundObject::name, "Of its mesh.")
      .def_property_readonly(
          "world_from_object",
          [](const FoundObject& d) { return matrix_of(d.world_from_object); },
          "(4, 4) float64, metres. With one image the world is the camera frame.")
      .def_property_readonly(
          "covariance", [](const FoundObject& d) { return array_of(d.covariance); },
          "(6, 6) float64 of [translation m, rotation rad] in the world.")
      .def_readonly("probability", &FoundObject::probability, "That the pose is right, [0, 1].")
      .def_readonly("psi", &FoundObject::psi)
      .def_readonly("psi_z_score", &FoundObject::psi_z_score)
      .def_readonly("cost_px", &FoundObject::cost_px)
      .def_readonly("matched_fraction", &FoundObject::matched_fraction)
      .def_readonly("unexplained_grey", &FoundObject::unexplained_grey)
      .def_readonly("convergence", &FoundObject::convergence)
      .def_readonly("alternatives", &FoundObject::alternatives, "Most probable first.")
      .def("__repr__", [](const FoundObject& d) {
        const Eigen::Vector3d& t = d.world_from_object.translation_m;
        return py::str("Detection({}, probability {:.3f}, at [{:.4f}, {:.4f}, {:.4f}] m)")
            .format(d.name, d.probability, t.x(), t.y(), t.z());
      });
  py::class_<FoundObjects>(module, "Detections", "A sequence of Detection, most probable first.")
      .def("__len__", [](const FoundObjects& f) { return f.found.size(); })
      .def("__getitem__",
           [](const FoundObjects& f, py::ssize_t i) {
             const auto size = py::ssize_t(f.found.size());
             if (i < -size || i >= size) throw py::index_error();
             return f.found[std::size_t(i < 0 ? i + size : i)];
           })
      .def_property_readonly(
          "is_complete", [](const FoundObjects& f) { return f.completion == Completion::Complete; },
          "False where max_seconds were over: poses may be missing or not refined.")
      .def_property_readonly(
          "seconds",
          [](const FoundObjects& f) {
            py::dict seconds;
            for (const StageSeconds& stage : f.stages)
              seconds[py::str(stage.name)] = stage.seconds;
            return seconds;
          },
          "Of each stage, by name.");
}

}  // namespace

void add_detection(py::module_& module) {
  add_results(module);
  module.def("detect", &detect, py::arg("image"), py::arg("camera"), py::arg("templates"),
             py::arg("options") = nullptr, py::kw_only(), py::arg("backend") = nullptr,
             py::arg("max_seconds") = std::nullopt,
             "Finds objects in one image.\n\nimage: uint8, (height, width) or (height, width, 3) "
             "in the order red, green, blue. templates: one or several. The world of the poses is "
             "the camera frame. Ctrl-C ends it.");
  module.def("detect_jointly", &detect_in_all, py::arg("images"), py::arg("camera"),
             py::arg("camera_from_world"), py::arg("templates"), py::arg("options") = nullptr,
             py::kw_only(), py::arg("backend") = nullptr, py::arg("max_seconds") = std::nullopt,
             "Finds objects in several images of one static scene.\n\ncamera_from_world: "
             "(n, 4, 4), metres, one an image.");
  module.def("overlay", &overlay, py::arg("image"), py::arg("camera"), py::arg("detections"),
             py::arg("templates"), py::kw_only(), py::arg("camera_from_world") = py::none(),
             py::arg("backend") = nullptr,
             "The image with the edges and axes of the detections: (height, width, 3) uint8, red, "
             "green, blue. Green edges are in the image, orange ones are not.");
}

}  // namespace edgescout::python
