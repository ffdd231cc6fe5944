#include "host/track/tracker.h"

#include "host/bindings/python/src/called_in_turn.h"
#include "host/bindings/python/src/found_objects.h"
#include "host/bindings/python/src/parts.h"
#include "host/bindings/python/src/shared_backend.h"
#include "host/track/track_overlay.h"

namespace edgescout::python {

namespace {

// A track with the identity of its object.
struct PythonTrack : Track {
  int object_id = 1;
};

// Keeps what a Tracker refers to. search() goes beside calls of other threads.
class PythonTracker {
 public:
  PythonTracker(GivenSets sets, const Camera& camera, const TrackOptions& options,
                BackendPointer backend)
      : given_(std::move(sets)),
        sets_(given_.sets()),
        camera_(camera),
        backend_(std::move(backend)),
        tracker_(on_backend(backend_, {},
                            [&](const TimeLimit&, Backend& on) {
                              return std::make_unique<Tracker>(sets_, camera, on, options);
                            }),
                 [](const Tracker& tracker) { return tracker.tracks(); }) {}

  int add(const py::object& camera_from_object, int object) {
    if (object < 0 || std::size_t(object) >= sets_.size())
      refuse("object", std::to_string(object),
             "one of " + std::to_string(sets_.size()) + " templates");
    const Se3 pose = pose_of(camera_from_object, "camera_from_object");
    return without_lock(
        [&] { return tracker_.call([&](Tracker& tracker) { return tracker.add(object, pose); }); });
  }

  void remove(int id) {
    without_lock([&] { tracker_.call([&](Tracker& tracker) { tracker.remove(id); }); });
  }

  std::vector<PythonTrack> update(const py::object& image, double time_s, const GivenDepth& depth,
                                  std::optional<double> max_seconds) {
    const TrackFrame frame = frame_of(image, time_s, depth);
    return named(on_backend(backend_, max_seconds, [&](const TimeLimit& limit, Backend&) {
      return tracker_.call(
          [&](Tracker& tracker) { return std::vector<Track>(tracker.update(frame, limit)); });
    }));
  }

  // On a backend of its own, so that another thread may update.
  int search(const py::object& image, const GivenDepth& depth, const BackendPointer& backend,
             std::optional<double> max_seconds) {
    const TrackFrame frame = frame_of(image, 0, depth);
    if (backend == backend_ && backend)
      refuse("backend", "that of the tracker", "another one: update() goes on during a search");
    if (!backend && !own_) own_ = std::make_shared<SharedBackend>(make_backend("auto"));
    return on_backend(backend ? backend : own_, max_seconds,
                      [&](const TimeLimit& limit, Backend& on) {
                        return tracker_.beside().search(frame, on, limit);
                      });
  }

  py::array_t<std::uint8_t> overlay(const py::object& image) {
    const TrackFrame frame = frame_of(image, 0, {py::none()});
    const std::vector<EdgeModel> models = models_of(sets_);
    return array_of(on_backend(backend_, {}, [&](const TimeLimit&, Backend& on) {
      return draw_tracks(*frame.image, camera_, tracker_.shown(), models, on);
    }));
  }

  // As of the last call.
  std::vector<PythonTrack> tracks() { return named(tracker_.shown()); }

 private:
  std::vector<PythonTrack> named(const std::vector<Track>& tracks) const {
    std::vector<PythonTrack> result;
    for (const Track& track : tracks)
      result.push_back({track, sets_[std::size_t(track.object)].object_id});
    return result;
  }

  TrackFrame frame_of(const py::object& image, double time_s, const GivenDepth& depth) const {
    TakenImage taken = taken_image(image, camera_, {});
    give_depth(taken, depth);
    return {std::make_shared<const Image>(std::move(taken.image)), time_s, measured_depth(taken)};
  }

  GivenSets given_;
  std::span<const TemplateSet> sets_;
  Camera camera_;
  BackendPointer backend_;
  BackendPointer own_;  // of searches
  CalledInTurn<Tracker, std::vector<Track>> tracker_;
};

void add_tracks(py::module_& module) {
  py::enum_<TrackState>(module, "TrackState", "How sure a pose is.")
      .value("TRACKED", TrackState::Tracked)
      .value("DOUBTFUL", TrackState::Doubtful, "Too few edges agree, or too few are visible.")
      .value("LOST", TrackState::Lost, "Doubtful for too long. Tracker.search() looks for it.");
  py::class_<PythonTrack>(module, "Track", "An instance that is followed.")
      .def_readonly("id", &PythonTrack::id, "From 1. It stays when the instance is found again.")
      .def_readonly("object", &PythonTrack::object, "Index into the templates that were given.")
      .def_readonly("object_id", &PythonTrack::object_id, "That of its templates.")
      .def_readonly("state", &PythonTrack::state, "Whether the pose can be relied on.")
      .def_property_readonly(
          "camera_from_object", [](const PythonTrack& t) { return matrix_of(t.world_from_object); },
          "4x4, metres.")
      .def_property_readonly(
          "covariance", [](const PythonTrack& t) { return array_of(t.covariance); },
          "6x6: translation, m, then rotation, rad, along the camera's axes; the rotation is about "
          "the object's origin.")
      .def_readonly("above_chance", &PythonTrack::above_chance,
                    "Share of the edges found, above what chance gives, 0 to 1.")
      .def("__repr__", [](const PythonTrack& t) {
        return py::str("Track({}, object {}, {}, {:.2f})")
            .format(t.id, t.object_id, to_string(t.state), t.above_chance);
      });
}

using TrackerClass = py::class_<PythonTracker>;

void add_instances(TrackerClass& tracker) {
  tracker
      .def("add", &PythonTracker::add, py::arg("camera_from_object"), py::arg("object") = 0,
           "Follows an object from a pose (4x4, metres) known to some 10 px; returns its id.")
      .def("remove", &PythonTracker::remove, py::arg("id"), "Forgets an instance.")
      .def_property_readonly("tracks", &PythonTracker::tracks,
                             "As of the last call; another thread may be in update().");
}

void add_update(TrackerClass& tracker) {
  tracker.def(
      "update",
      [](PythonTracker& self, const py::object& image, double time_s, const py::object& depth,
         const DepthOptions* depth_options, std::optional<double> max_seconds) {
        return self.update(image, time_s, {depth, depth_options}, max_seconds);
      },
      py::arg("image"), py::arg("time_s"), py::kw_only(), py::arg("depth") = py::none(),
      py::arg("depth_options") = nullptr, py::arg("max_seconds") = std::nullopt,
      "All instances in the next image. time_s: when it was taken, on any clock; it rises. image, "
      "depth: as those of detect(). max_seconds, Ctrl-C: then objects that are doubtful stay so, "
      "not registered; the image was taken in.");
}

void add_search(TrackerClass& tracker) {
  tracker.def(
      "search",
      [](PythonTracker& self, const py::object& image, const py::object& depth,
         const DepthOptions* depth_options, const BackendPointer& backend,
         std::optional<double> max_seconds) {
        return self.search(image, {depth, depth_options}, backend, max_seconds);
      },
      py::arg("image"), py::kw_only(), py::arg("depth") = py::none(),
      py::arg("depth_options") = nullptr, py::arg("backend") = nullptr,
      py::arg("max_seconds") = std::nullopt,
      "Looks for instances that are lost or not yet found, and returns how many it found. They "
      "join at the next update(), which may go on in another thread meanwhile.");
}

}  // namespace

void add_tracker(py::module_& module) {
  add_tracks(module);
  TrackerClass tracker(module, "Tracker",
                       "Follows the poses of objects from image to image.\n\n"
                       "    tracker = Tracker(templates, camera)\n"
                       "    tracker.search(first_image)\n"
                       "    for time_s, image in images:\n"
                       "        for track in tracker.update(image, time_s): ...\n");
  tracker.def(
      py::init([](const py::object& templates, const Camera& camera, const TrackOptions* options,
                  const BackendPointer& backend) {
        return std::make_unique<PythonTracker>(GivenSets(templates), camera,
                                               options ? *options : TrackOptions{},
                                               backend_or_usual(backend));
      }),
      py::arg("templates"), py::arg("camera"), py::arg("options") = nullptr, py::kw_only(),
      py::arg("backend") = nullptr,
      "The camera needs a size. Templates without views are followed but not searched for.");
  add_instances(tracker);
  add_update(tracker);
  add_search(tracker);
  tracker.def(
      "overlay", &PythonTracker::overlay, py::arg("image"),
      "The image with what is tracked or doubtful: (height, width, 3) uint8, red, green, blue. "
      "The number is that of above_chance.");
}

}  // namespace edgescout::python
