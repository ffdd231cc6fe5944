#include "host/bindings/python/src/found_objects.h"
#include "host/bindings/python/src/interrupt.h"
#include "host/bindings/python/src/parts.h"
#include "host/bindings/python/src/shared_backend.h"
#include "host/overlay.h"
#include "host/register_objects.h"

namespace edgescout::python {

namespace {

// Where a call works, and for how long.
struct Running {
  const BackendPointer& backend;
  std::optional<double> max_seconds;
};

PipelineOptions options_of(const PipelineOptions* given) {
  return given ? *given : PipelineOptions{};
}

std::vector<ObjectView> prepared(std::span<const TakenImage> images, Backend& backend,
                                 const PipelineOptions& options) {
  std::vector<ObjectView> views;
  for (const TakenImage& taken : images) {
    views.push_back(
        prepare_view(taken.image, taken.camera, taken.camera_from_world, backend, options));
    if (taken.depth) add_depth(views.back(), *taken.depth, taken.camera, taken.depth_noise);
  }
  return views;
}

TakenImage image_with_depth(const py::object& image, const Camera& camera,
                            const GivenDepth& depth) {
  TakenImage taken = taken_image(image, camera, Se3{});
  give_depth(taken, depth);
  return taken;
}

std::vector<TakenImage> images_with_depth(const py::object& images, const py::object& camera,
                                          const py::object& camera_from_world,
                                          const GivenDepth& depth) {
  std::vector<TakenImage> taken = taken_images(images, camera, camera_from_world);
  give_depth(std::span(taken), depth);
  return taken;
}

FoundObjects detect_in_one(const TakenImage& taken, const GivenSets& given, PipelineOptions options,
                           const Running& running) {
  const std::span<const TemplateSet> sets = given.sets();
  const auto work = [&](const TimeLimit& limit, Backend& on) {
    options.limit = limit;
    return detect_objects(prepared({&taken, 1}, on, options)[0], sets, on, options);
  };
  return named(on_backend(running.backend, running.max_seconds, work), sets);
}

FoundObjects detect_in_all(const std::vector<TakenImage>& taken, const GivenSets& given,
                           PipelineOptions options, const Running& running) {
  const std::span<const TemplateSet> sets = given.sets();
  const auto work = [&](const TimeLimit& limit, Backend& on) {
    options.limit = limit;
    return detect_jointly(prepared(taken, on, options), sets, on, options);
  };
  return named(on_backend(running.backend, running.max_seconds, work), sets);
}

// Poses to start from, of the given objects or all of the only one.
std::vector<ObjectPose> starts_of(const py::object& poses, const char* name,
                                  const std::optional<std::vector<int>>& objects,
                                  std::size_t sets) {
  const std::vector<Se3> given = poses_of(poses, name);
  if (objects ? objects->size() != given.size() : sets != 1)
    refuse("objects", objects ? std::to_string(objects->size()) : "none",
           "the index of the templates of each of " + std::to_string(given.size()) + " poses");
  std::vector<ObjectPose> starts;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const int object = objects ? (*objects)[i] : 0;
    if (object < 0 || std::size_t(object) >= sets)
      refuse("objects", std::to_string(object), "one of " + std::to_string(sets) + " templates");
    starts.push_back({object, given[i]});
  }
  return starts;
}

// `given_options` null: the defaults.
FoundObjects register_in(std::span<const TakenImage> taken, const GivenSets& given,
                         const std::vector<ObjectPose>& starts,
                         const RegistrationOptions* given_options, const Running& running) {
  const std::span<const TemplateSet> sets = given.sets();
  const std::vector<EdgeModel> models = models_of(sets);
  RegistrationOptions options = given_options ? *given_options : RegistrationOptions{};
  PipelineOptions preparing;
  preparing.edges = options.edges;
  const auto work = [&](const TimeLimit& limit, Backend& on) {
    options.work.limit = limit;
    return register_objects(prepared(taken, on, preparing), models, starts, on, options.work);
  };
  return named(on_backend(running.backend, running.max_seconds, work), sets);
}

py::array_t<std::uint8_t> overlay(const py::object& image, const Camera& camera,
                                  const std::vector<FoundObject>& found,
                                  const py::object& templates, const py::object& camera_from_world,
                                  const BackendPointer& backend) {
  const Se3 camera_pose =
      camera_from_world.is_none() ? Se3{} : pose_of(camera_from_world, "camera_from_world");
  const TakenImage taken = taken_image(image, camera, camera_pose);
  const GivenSets given(templates);
  const std::span<const TemplateSet> sets = given.sets();
  std::vector<OverlayPose> poses;
  for (const FoundObject& each : found) {
    if (each.object < 0 || std::size_t(each.object) >= sets.size())
      refuse("detections", "object " + std::to_string(each.object),
             "one of " + std::to_string(sets.size()) + " templates");
    poses.push_back({each.object, camera_pose * each.world_from_object, each.probability, ""});
  }
  const std::vector<EdgeModel> models = models_of(sets);
  return array_of(on_backend(backend, {}, [&](const TimeLimit&, Backend& on) {
    const ObjectView view = prepared({&taken, 1}, on, {})[0];
    return draw_overlay(*view.image, view.camera, poses, models, view.edges.get(), on);
  }));
}

void add_detect(py::module_& module) {
  module.def(
      "detect",
      [](const py::object& image, const Camera& camera, const py::object& templates,
         const PipelineOptions* options, const py::object& depth, const DepthOptions* depth_options,
         const BackendPointer& backend, std::optional<double> max_seconds) {
        const TakenImage taken = image_with_depth(image, camera, {depth, depth_options});
        return detect_in_one(taken, GivenSets(templates), options_of(options),
                             {backend, max_seconds});
      },
      py::arg("image"), py::arg("camera"), py::arg("templates"), py::arg("options") = nullptr,
      py::kw_only(), py::arg("depth") = py::none(), py::arg("depth_options") = nullptr,
      py::arg("backend") = nullptr, py::arg("max_seconds") = std::nullopt,
      "Finds objects in one image.\n\nimage: uint8 or uint16, (height, width) or "
      "(height, width, 3 or 4) in the order red, green, blue; or float32, (height, width); "
      "deeper values are scaled to 8 bit (to_grey()). templates: one or several. The world of the "
      "poses is the camera frame. Ctrl-C ends it. max_seconds: then it ends with the poses found "
      "so far, and is_complete is False. depth: of the same camera and size, (height, width), "
      "uint16, uint32 or float32, or None; depth_options say its unit and noise.");
}

void add_detect_jointly(py::module_& module) {
  module.def(
      "detect_jointly",
      [](const py::object& images, const py::object& camera, const py::object& camera_from_world,
         const py::object& templates, const PipelineOptions* options, const py::object& depth,
         const DepthOptions* depth_options, const BackendPointer& backend,
         std::optional<double> max_seconds) {
        const std::vector<TakenImage> taken =
            images_with_depth(images, camera, camera_from_world, {depth, depth_options});
        return detect_in_all(taken, GivenSets(templates), options_of(options),
                             {backend, max_seconds});
      },
      py::arg("images"), py::arg("camera"), py::arg("camera_from_world"), py::arg("templates"),
      py::arg("options") = nullptr, py::kw_only(), py::arg("depth") = py::none(),
      py::arg("depth_options") = nullptr, py::arg("backend") = nullptr,
      py::arg("max_seconds") = std::nullopt,
      "Finds objects in several images of one static scene.\n\nimages: each as that of detect(). "
      "camera: one for all, or one an image. camera_from_world: (n, 4, 4), metres, one an image. "
      "depth: of each image, or None. max_seconds: as that of detect().");
}

void add_register(py::module_& module) {
  module.def(
      "register",
      [](const py::object& image, const Camera& camera, const py::object& templates,
         const py::object& camera_from_object, const std::optional<std::vector<int>>& objects,
         const RegistrationOptions* options, const py::object& depth,
         const DepthOptions* depth_options, const BackendPointer& backend,
         std::optional<double> max_seconds) {
        const GivenSets given(templates);
        const TakenImage taken = image_with_depth(image, camera, {depth, depth_options});
        return register_in(
            {&taken, 1}, given,
            starts_of(camera_from_object, "camera_from_object", objects, given.sets().size()),
            options, {backend, max_seconds});
      },
      py::arg("image"), py::arg("camera"), py::arg("templates"), py::arg("camera_from_object"),
      py::arg("objects") = std::nullopt, py::kw_only(), py::arg("options") = nullptr,
      py::arg("depth") = py::none(), py::arg("depth_options") = nullptr,
      py::arg("backend") = nullptr, py::arg("max_seconds") = std::nullopt,
      "Refines given poses in one image.\n\ncamera_from_object: (n, 4, 4), metres, within some "
      "0.3 rad and a tenth of the object's size. objects: of each, the index of its templates; "
      "needed where there are several. The result is in the order of the poses. image, depth, "
      "max_seconds: as those of detect().");
}

void add_register_jointly(py::module_& module) {
  module.def(
      "register_jointly",
      [](const py::object& images, const py::object& camera, const py::object& camera_from_world,
         const py::object& templates, const py::object& world_from_object,
         const std::optional<std::vector<int>>& objects, const RegistrationOptions* options,
         const py::object& depth, const DepthOptions* depth_options, const BackendPointer& backend,
         std::optional<double> max_seconds) {
        const GivenSets given(templates);
        return register_in(
            images_with_depth(images, camera, camera_from_world, {depth, depth_options}), given,
            starts_of(world_from_object, "world_from_object", objects, given.sets().size()),
            options, {backend, max_seconds});
      },
      py::arg("images"), py::arg("camera"), py::arg("camera_from_world"), py::arg("templates"),
      py::arg("world_from_object"), py::arg("objects") = std::nullopt, py::kw_only(),
      py::arg("options") = nullptr, py::arg("depth") = py::none(),
      py::arg("depth_options") = nullptr, py::arg("backend") = nullptr,
      py::arg("max_seconds") = std::nullopt,
      "Refines given poses over several images of one static scene.\n\nArguments are those of "
      "detect_jointly() and register(); the poses are world_from_object.");
}

}  // namespace

void add_detection(py::module_& module) {
  add_found_objects(module);
  add_detect(module);
  add_detect_jointly(module);
  add_register(module);
  add_register_jointly(module);
  module.def("overlay", &overlay, py::arg("image"), py::arg("camera"), py::arg("detections"),
             py::arg("templates"), py::kw_only(), py::arg("camera_from_world") = py::none(),
             py::arg("backend") = nullptr,
             "The image with the edges and axes of the detections: (height, width, 3) uint8, red, "
             "green, blue. Green edges are in the image, orange ones are not.");
}

}  // namespace edgescout::python
