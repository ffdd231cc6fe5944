#include "host/bindings/python/src/found_objects.h"

#include "host/bindings/python/src/array_pixels.h"
#include "host/bindings/python/src/interrupt.h"
#include "host/core/image_size.h"
#include "host/io/depth_registration.h"

namespace edgescout::python {

GivenSets::GivenSets(const py::object& templates) {
  using Pointer = std::shared_ptr<TemplateSet>;
  if (py::isinstance<TemplateSet>(templates)) {
    one_ = py::cast<Pointer>(templates);
    return;
  }
  if (!py::isinstance<py::sequence>(templates))
    refuse("templates", type_name(templates), "Templates or a sequence of them");
  for (const py::handle& each : py::reinterpret_borrow<py::sequence>(templates)) {
    if (!py::isinstance<TemplateSet>(each))
      refuse("templates", type_name(each) + " in them", "Templates or a sequence of them");
    several_.push_back(*py::cast<Pointer>(each));
  }
  if (several_.empty()) refuse("templates", "none", "at least one");
}

TakenImage taken_image(const py::handle& image, const Camera& camera,
                       const Se3& camera_from_world) {
  TakenImage shot{image_of(image), camera, camera_from_world, {}, {}};
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

void give_depth(TakenImage& taken, const GivenDepth& depth) {
  if (depth.values.is_none()) return;
  const DepthOptions options = depth.options ? *depth.options : DepthOptions{};
  taken.depth = depth_of(depth.values, options);
  taken.depth_noise = options.noise;
  require_size_of(taken.camera, *taken.depth, "depth", "image");
}

void give_depth(std::span<TakenImage> taken, const GivenDepth& depth) {
  if (depth.values.is_none()) return;
  if (!py::isinstance<py::sequence>(depth.values))
    refuse("depth", type_name(depth.values), "a sequence of depth images");
  const auto each = py::cast<std::vector<py::object>>(depth.values);
  if (each.size() != taken.size())
    refuse("depth", std::to_string(each.size()) + " depth images",
           "one or None an image of " + std::to_string(taken.size()));
  for (std::size_t i = 0; i < each.size(); ++i) give_depth(taken[i], {each[i], depth.options});
}

std::shared_ptr<const MeasuredDepth> measured_depth(const TakenImage& taken) {
  if (!taken.depth) return nullptr;
  return without_lock([&] {
    return std::make_shared<const MeasuredDepth>(
        MeasuredDepth{undistort_depth(*taken.depth, taken.camera), taken.depth_noise});
  });
}

namespace {

// One for all images, or one an image.
std::vector<Camera> cameras_of(const py::object& given, std::size_t images) {
  if (py::isinstance<Camera>(given))
    return std::vector<Camera>(images, py::cast<const Camera&>(given));
  if (!py::isinstance<py::sequence>(given))
    refuse("camera", type_name(given), "a Camera or a sequence of them");
  std::vector<Camera> cameras;
  for (const py::handle& each : py::reinterpret_borrow<py::sequence>(given)) {
    if (!py::isinstance<Camera>(each))
      refuse("camera", type_name(each) + " in them", "a Camera or a sequence of them");
    cameras.push_back(py::cast<const Camera&>(each));
  }
  if (cameras.size() != images)
    refuse("camera", std::to_string(cameras.size()) + " cameras",
           "one for all or one an image of " + std::to_string(images));
  return cameras;
}

}  // namespace

std::vector<TakenImage> taken_images(const py::object& images, const py::object& camera,
                                     const py::object& camera_from_world) {
  if (!py::isinstance<py::sequence>(images))
    refuse("images", type_name(images), "a sequence of images");
  const auto given = py::cast<std::vector<py::object>>(images);
  const std::vector<Se3> poses = poses_of(camera_from_world, "camera_from_world");
  if (poses.size() != given.size() || poses.empty())
    refuse("camera_from_world", std::to_string(poses.size()) + " poses",
           "one an image of " + std::to_string(given.size()));
  const std::vector<Camera> cameras = cameras_of(camera, given.size());
  std::vector<TakenImage> taken;
  for (std::size_t i = 0; i < given.size(); ++i)
    taken.push_back(taken_image(given[i], cameras[i], poses[i]));
  return taken;
}

FoundObjects named(Detections&& detections, std::span<const TemplateSet> sets) {
  FoundObjects result{{}, detections.completion, std::move(detections.stages)};
  for (Detection& detection : detections.detections) {
    const TemplateSet& set = sets[std::size_t(detection.object)];
    result.found.push_back({std::move(detection), set.object_id, set.model.mesh.name});
  }
  return result;
}

namespace {

using DetectionClass = py::class_<FoundObject>;

void add_pose(DetectionClass& detection) {
  detection
      .def_readonly("object", &FoundObject::object, "Index into the templates that were given.")
      .def_readonly("object_id", &FoundObject::object_id, "That of its templates.")
      .def_readonly("name", &FoundObject::name, "Of its mesh.")
      .def_property_readonly(
          "world_from_object", [](const FoundObject& d) { return matrix_of(d.world_from_object); },
          "(4, 4) float64, metres. With one image the world is the camera frame.")
      .def_property_readonly(
          "covariance", [](const FoundObject& d) { return array_of(d.covariance); },
          "(6, 6) float64 of [translation m, rotation rad] in the world.");
}

void add_scores(DetectionClass& detection) {
  detection
      .def_readonly("probability", &FoundObject::probability, "That the pose is right, [0, 1].")
      .def_readonly(
          "psi", &FoundObject::psi,
          "Mean cosine between image gradient and edge normals, [0, 1] (Eq. 10 of the paper).")
      .def_readonly("psi_z_score", &FoundObject::psi_z_score,
                    "psi above what chance gives, in standard errors.")
      .def_readonly("cost_px", &FoundObject::cost_px,
                    "Mean distance of the visible edge points from the image's edges.")
      .def_readonly("matched_fraction", &FoundObject::matched_fraction,
                    "Of the visible edge points, those with an edge of the image near.")
      .def_readonly(
          "unexplained_grey", &FoundObject::unexplained_grey,
          "Share of the contrast inside the outline that the surface does not explain, [0, 1].")
      .def_readonly("convergence", &FoundObject::convergence, "Why the registration stopped.")
      .def_readonly("alternatives", &FoundObject::alternatives, "Most probable first.")
      .def("__repr__", [](const FoundObject& d) {
        const Eigen::Vector3d& t = d.world_from_object.translation_m;
        return py::str("Detection({}, probability {:.3f}, at [{:.4f}, {:.4f}, {:.4f}] m)")
            .format(d.name, d.probability, t.x(), t.y(), t.z());
      });
}

void add_alternatives(py::module_& module) {
  py::class_<AlternativePose>(module, "Alternative", "Another pose that explains the same edges.")
      .def_property_readonly(
          "world_from_object",
          [](const AlternativePose& a) { return matrix_of(a.world_from_object); },
          "(4, 4) float64, metres.")
      .def_readonly("probability", &AlternativePose::probability, "That it is the right one.");
}

void add_detections(py::module_& module) {
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
            for (const StageSeconds& stage : f.stages) seconds[py::str(stage.name)] = stage.seconds;
            return seconds;
          },
          "Of each stage, by name.");
}

}  // namespace

void add_found_objects(py::module_& module) {
  add_alternatives(module);
  DetectionClass detection(module, "Detection", "One object that was found.");
  add_pose(detection);
  add_scores(detection);
  add_detections(module);
}

}  // namespace edgescout::python
