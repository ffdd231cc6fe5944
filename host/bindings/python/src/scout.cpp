#include "host/active/scout.h"

#include <functional>

#include "host/active/views.h"
#include "host/bindings/python/src/array_pixels.h"
#include "host/bindings/python/src/called_in_turn.h"
#include "host/bindings/python/src/found_objects.h"
#include "host/bindings/python/src/parts.h"
#include "host/bindings/python/src/shared_backend.h"

namespace edgescout::python {

namespace {

// A view that the scout asks for.
struct Proposal {
  int view = 0;
  Se3 camera_from_world;
  std::vector<double> values_nats;  // of each possible view; NaN: closed
};

// An instance that the scout reports.
struct Instance : FoundObject {
  std::vector<int> supporting_images;
};

// What is read of a scout while another thread may be in a call.
struct ShownScout {
  std::vector<ModeDetection> detections;
  double entropy_nats = 0;
  std::size_t images = 0;
  ScoutEnd end = ScoutEnd::No;
};

ShownScout shown_of(const Scout& scout) {
  const ScoutState& state = scout.state();
  return {state.detections, state.entropy_nats, state.steps.size(), state.end};
}

// A function of Python, which may be called and freed without the interpreter's lock.
class CalledFunction {
 public:
  explicit CalledFunction(const py::object& function)
      : function_(new py::object(function), [](py::object* freed) {
          const py::gil_scoped_acquire lock;
          delete freed;
        }) {}
  bool operator()(int view) const {
    const py::gil_scoped_acquire lock;
    return py::cast<bool>(py::bool_((*function_)(view)));
  }

 private:
  std::shared_ptr<py::object> function_;
};

// None: all views are. A function says so of each, or these indices are.
std::function<bool(int view)> reachable_of(const py::object& given, std::size_t views) {
  if (given.is_none()) return {};
  if (PyCallable_Check(given.ptr())) return CalledFunction(given);
  std::vector<int> indices;
  try {
    indices = py::cast<std::vector<int>>(given);
  } catch (const py::cast_error&) {
    refuse("reachable", type_name(given), "None, a function or a sequence of views");
  }
  std::vector<bool> is_reachable(views);
  for (const int view : indices) {
    if (view < 0 || std::size_t(view) >= views)
      refuse("reachable", "view " + std::to_string(view),
             "one of " + std::to_string(views) + " views");
    is_reachable[std::size_t(view)] = true;
  }
  return [is_reachable](int view) { return bool(is_reachable[std::size_t(view)]); };
}

// Keeps what a Scout refers to.
class PythonScout {
 public:
  PythonScout(GivenSets sets, const Camera& camera, std::vector<Se3> views, ScoutOptions options,
              BackendPointer backend)
      : given_(std::move(sets)),
        sets_(given_.sets()),
        backend_(std::move(backend)),
        camera_(camera),
        views_(std::move(views)),
        scout_(on_backend(backend_, {},
                          [&](const TimeLimit&, Backend& on) {
                            options.cancelled = [this] { return limit_ && limit_->is_cancelled(); };
                            return std::make_unique<Scout>(sets_, camera_, views_, options, on);
                          }),
               &shown_of) {}

  std::optional<Proposal> propose() {
    const std::optional<ScoutDecision> decision =
        call([](Scout& scout) { return scout.propose(); });
    if (!decision) return {};
    Proposal proposal{decision->view, views_[std::size_t(decision->view)], {}};
    for (const ViewInformation& view : decision->views)
      proposal.values_nats.push_back(view.open ? view.value() : NAN);
    return proposal;
  }

  void give(int view, const py::object& image, const py::object& camera_from_world,
            const GivenDepth& depth) {
    require_view(view);
    const Se3 pose = camera_from_world.is_none() ? views_[std::size_t(view)]
                                                 : pose_of(camera_from_world, "camera_from_world");
    TakenImage taken{image_of(image), camera_, pose, {}, {}};
    give_depth(taken, depth);
    const Shot shot{std::move(taken.image), pose, measured_depth(taken)};
    call([&](Scout& scout) { scout.give(view, shot); });
  }

  void unreachable(int view, const std::string& reason) {
    require_view(view);
    call([&](Scout& scout) { scout.unreachable(view, reason); });
  }

  std::vector<Instance> detections() const {
    std::vector<Instance> instances;
    for (const ModeDetection& mode : shown().detections) {
      const TemplateSet& set = sets_[std::size_t(mode.detection.object)];
      instances.push_back(
          {{mode.detection, set.object_id, set.model.mesh.name}, mode.supporting_images});
    }
    return instances;
  }

  void resume(const std::filesystem::path& file) {
    call([&](Scout& scout) { scout.resume(load_scout_state(file), file.string()); });
  }

  void save(const std::filesystem::path& file) {
    call([&](Scout& scout) { save_scout_state(scout.state(), file); });
  }

  // As of the last call.
  ShownScout shown() const { return scout_.shown(); }

 private:
  template <typename Work>
  std::invoke_result_t<Work, Scout&> call(const Work& work) {
    return on_backend(backend_, {}, [&](const TimeLimit& limit, Backend&) {
      return scout_.call([&](Scout& scout) {
        limit_ = &limit;
        const auto reset = [this](const TimeLimit*) { limit_ = nullptr; };
        const std::unique_ptr<const TimeLimit, decltype(reset)> until_the_end(&limit, reset);
        return work(scout);
      });
    });
  }

  void require_view(int view) const {
    if (view < 0 || std::size_t(view) >= views_.size())
      throw py::index_error("view: found " + std::to_string(view) + ", expected one of " +
                            std::to_string(views_.size()));
  }

  GivenSets given_;
  std::span<const TemplateSet> sets_;
  BackendPointer backend_;
  const Camera camera_;
  const std::vector<Se3> views_;
  const TimeLimit* limit_ = nullptr;  // of the call in progress
  CalledInTurn<Scout, ShownScout> scout_;
};

py::array_t<double> hemisphere(const std::array<double, 3>& center_m, double radius_m, int count,
                               const std::vector<double>& elevations_deg) {
  return matrices_of(
      hemisphere_views({{center_m[0], center_m[1], center_m[2]}, radius_m, elevations_deg, count}));
}

void add_scout_results(py::module_& module) {
  py::class_<Proposal>(module, "Proposal", "The view that the scout asks for.")
      .def_readonly("view", &Proposal::view, "Index into the views that were given.")
      .def_property_readonly(
          "camera_from_world", [](const Proposal& p) { return matrix_of(p.camera_from_world); },
          "(4, 4) float64, metres, where the camera is to be sent.")
      .def_property_readonly(
          "values_nats",
          [](const Proposal& p) {
            return py::array_t<double>(py::ssize_t(p.values_nats.size()), p.values_nats.data());
          },
          "Of each possible view, what is expected of it; NaN: taken or failed. Empty for the "
          "first image.");
  py::class_<Instance, FoundObject>(module, "Instance", "An object that the scout reports.")
      .def_readonly("supporting_images", &Instance::supporting_images,
                    "Images, from 0, that alone make the pose probable.");
}

using ScoutClass = py::class_<PythonScout>;

void add_steps(ScoutClass& scout) {
  scout
      .def("propose", &PythonScout::propose,
           "The next view, or None at the end. The same until an image or a failure is given.")
      .def(
          "give",
          [](PythonScout& self, int view, const py::object& image,
             const py::object& camera_from_world, const py::object& depth,
             const DepthOptions* depth_options) {
            self.give(view, image, camera_from_world, {depth, depth_options});
          },
          py::arg("view"), py::arg("image"), py::arg("camera_from_world") = py::none(),
          py::kw_only(), py::arg("depth") = py::none(), py::arg("depth_options") = nullptr,
          "Adds the image of a view, taken where it was planned or at the given (4, 4) pose. "
          "image, depth: as those of detect(). Ctrl-C leaves the scout as it was.")
      .def("unreachable", &PythonScout::unreachable, py::arg("view"), py::arg("reason"),
           "The view failed; another one is proposed.");
}

void add_state(ScoutClass& scout) {
  scout
      .def_property_readonly("detections", &PythonScout::detections,
                             "Most probable first; as of the last call, as all that is read.")
      .def_property_readonly(
          "entropy_nats", [](const PythonScout& s) { return s.shown().entropy_nats; },
          "What is uncertain about the objects, nats.")
      .def_property_readonly(
          "images", [](const PythonScout& s) { return s.shown().images; }, "How many were given.")
      .def_property_readonly(
          "end", [](const PythonScout& s) { return to_string(s.shown().end); },
          "Why it ended; empty while it goes on.")
      .def("save", &PythonScout::save, py::arg("file"),
           "Writes the state, whole or not at all. resume() goes on from it.")
      .def("resume", &PythonScout::resume, py::arg("file"),
           "Goes on from a saved state of the same objects, camera and views.");
}

void add_camera_poses(py::module_& module) {
  module.def("hemisphere_views", &hemisphere, py::arg("center_m"), py::arg("radius_m"),
             py::arg("count") = 32, py::arg("elevations_deg") = std::vector<double>{35, 55, 75},
             "Poses (n, 4, 4) camera_from_world of cameras on rings above a point, which look at "
             "it.");
  module.def(
      "look_at",
      [](const std::array<double, 3>& eye_m, const std::array<double, 3>& target_m) {
        return matrix_of(
            look_at({eye_m[0], eye_m[1], eye_m[2]}, {target_m[0], target_m[1], target_m[2]}));
      },
      py::arg("eye_m"), py::arg("target_m"),
      "The pose camera_from_world, world z up in the image.");
}

}  // namespace

void add_scout(py::module_& module) {
  add_scout_results(module);
  ScoutClass scout(module, "Scout",
                   "Finds objects from several views and says which view to take next.\n\n"
                   "    while (proposal := scout.propose()) is not None:\n"
                   "        move_camera(proposal.camera_from_world)\n"
                   "        scout.give(proposal.view, take_image())\n");
  scout.def(py::init([](const py::object& templates, const Camera& camera,
                        const py::object& camera_from_world, const ScoutOptions* options,
                        const py::object& reachable, const BackendPointer& backend) {
              std::vector<Se3> views = poses_of(camera_from_world, "camera_from_world");
              ScoutOptions used = options ? *options : ScoutOptions{};
              used.next_view.reachable = reachable_of(reachable, views.size());
              return std::make_unique<PythonScout>(GivenSets(templates), camera, std::move(views),
                                                   std::move(used), backend_or_usual(backend));
            }),
            py::arg("templates"), py::arg("camera"), py::arg("camera_from_world"),
            py::arg("options") = nullptr, py::kw_only(), py::arg("reachable") = py::none(),
            py::arg("backend") = nullptr,
            "camera_from_world: (n, 4, 4), metres, where the camera may be sent. reachable: which "
            "of these views can be reached now: a function that propose() asks with the index of a "
            "view, or a sequence of the indices; None: all. The function does not call the scout.");
  add_steps(scout);
  add_state(scout);
  add_camera_poses(module);
}

}  // namespace edgescout::python
