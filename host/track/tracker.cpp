#include "host/track/tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "host/core/image_size.h"
#include "host/detect/distinct_poses.h"
#include "host/register/depth_evidence.h"
#include "host/register/occluders.h"
#include "host/register/thresholds.h"
#include "host/track/cropped_registration.h"
#include "host/track/edge_follower.h"
#include "host/track/motion_model.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Holds a mutex or throws: a second thread is a mistake of the caller, and waiting would hide it.
class Exclusive {
 public:
  explicit Exclusive(std::mutex& mutex) : lock_(mutex, std::try_to_lock) {
    check(lock_.owns_lock(), "tracker: another thread is in this call");
  }

 private:
  std::unique_lock<std::mutex> lock_;
};

Matrix6d unknown_covariance() {
  return Matrix6d::Constant(std::numeric_limits<double>::infinity());
}

// Whether the place of an object is known well enough to act on: edges of a few pixels fit
// anything.
bool is_determined(const Track& track, const EdgeModel& model) {
  constexpr double most_of_diameter = 0.1;
  const double most_m = most_of_diameter * model.mesh.diameter_m;
  const Matrix6d about_center =
      covariance_about(track.world_from_object, model.center_m, track.covariance);
  return about_center.topLeftCorner<3, 3>().trace() < most_m * most_m;
}

// A doubtful pose is believed where it agrees with the predicted one.
bool is_near(const Se3& pose, const Se3& predicted, const EdgeModel& model) {
  return pose_distance_m(pose, predicted, model.mesh, {}) <
         thresholds::NEAR_PREDICTED * model.mesh.diameter_m;
}

}  // namespace

std::string to_string(TrackState state) {
  constexpr std::array names{"tracked", "doubtful", "lost"};
  return names[std::size_t(state)];
}

struct Tracker::State {
  State(std::span<const TemplateSet> sets_, const Camera& camera_, Backend& backend_,
        const TrackOptions& options_)
      : sets(sets_),
        models(models_of(sets_)),
        camera(camera_),
        backend(backend_),
        options(options_) {}

  // What is known of an instance beyond what the caller sees.
  struct Instance {
    Track track;
    MotionModel motion;
    bool was_seen = false;  // in the last image, at the track's pose
  };

  std::span<const TemplateSet> sets;
  std::vector<EdgeModel> models;  // of the sets
  Camera camera;
  Backend& backend;
  TrackOptions options;

  std::vector<Instance> instances;
  std::shared_ptr<const Image> last_image;
  std::optional<double> last_time_s;
  int next_id = 1;

  std::mutex in_update, in_search;  // held by the calls, to find a second thread
  std::mutex shared;                // of what follows, for an instant
  std::vector<Track> tracks;        // of the instances; written by the thread of update() alone
  std::vector<ObjectPose> joining;  // found by search()

  void require(const TrackFrame& frame) const;
  int add(int object, const Se3& camera_from_object);
  MotionModel motion_from(int object, const Se3& camera_from_object) const {
    return {models[std::size_t(object)].center_m, camera_from_object};
  }
  void join_found();
  int missing(int object, std::span<const Track> known) const;
  bool is_known(const ObjectPose& pose, std::span<const Track> known) const;
  int keep_found(std::span<const Detection> detections, int object, int most,
                 std::span<const Track> known);
  std::shared_ptr<const Occluders> occluders_of(const Instance& instance, double time_s) const;
  void follow(Instance& instance, const SearchedImage& image, double time_s,
              const TimeLimit& limit);
  void update_track(Instance& instance, const FollowedPose& found, double time_s);
  std::optional<FollowedPose> registered(const Instance& instance, const SearchedImage& image,
                                         std::span<const Se3> starts, const TimeLimit& limit) const;
  void publish();
};

void Tracker::State::require(const TrackFrame& frame) const {
  check(frame.image != nullptr, "tracker: a frame without an image");
  require_size_of(camera, *frame.image, "frame");
  if (frame.depth) require_size_of(camera, frame.depth->image, "frame");
  if (!std::isfinite(frame.time_s))
    throw InputError("frame", "time", fmt::format("{}", frame.time_s), "a number");
}

int Tracker::State::add(int object, const Se3& camera_from_object) {
  check(object >= 0 && std::size_t(object) < sets.size(), "tracker: no such object");
  check(is_finite(camera_from_object), "tracker: a pose that is not finite");
  Track track;
  track.object = object;
  track.world_from_object = camera_from_object;
  track.id = next_id++;
  track.covariance = unknown_covariance();
  instances.push_back({track, motion_from(object, camera_from_object)});
  return track.id;
}

void Tracker::State::publish() {
  const std::lock_guard lock(shared);
  tracks.clear();
  for (const Instance& instance : instances) tracks.push_back(instance.track);
}

// How many instances of an object are neither tracked nor doubtful.
int Tracker::State::missing(int object, std::span<const Track> known) const {
  const auto followed = std::ranges::count_if(known, [&](const Track& track) {
    return track.object == object && track.state != TrackState::Lost;
  });
  return std::max(0, options.instances - int(followed));
}

// Whether an instance that is not lost has this pose.
bool Tracker::State::is_known(const ObjectPose& pose, std::span<const Track> known) const {
  const TemplateSet& set = sets[std::size_t(pose.object)];
  return std::ranges::any_of(known, [&](const Track& track) {
    return track.object == pose.object && track.state != TrackState::Lost &&
           pose_distance_m(track.world_from_object, pose.world_from_object, set.model.mesh,
                           set.symmetries) < thresholds::NEAR_KNOWN * set.model.mesh.diameter_m;
  });
}

// The detections, most probable first, are of one object alone. Returns how many are new.
int Tracker::State::keep_found(std::span<const Detection> detections, int object, int most,
                               std::span<const Track> known) {
  int kept = 0;
  for (const Detection& detection : detections) {
    const ObjectPose pose{object, detection.world_from_object};
    if (kept == most || is_known(pose, known)) continue;
    const std::lock_guard lock(shared);
    joining.push_back(pose);
    ++kept;
  }
  return kept;
}

// A found pose takes the place of the nearest lost instance of its object, else it is a new one.
void Tracker::State::join_found() {
  std::vector<ObjectPose> found;
  {
    const std::lock_guard lock(shared);
    found.swap(joining);
  }
  for (const ObjectPose& pose : found) {
    publish();  // what joined before is known
    if (is_known(pose, tracks)) continue;
    Instance* nearest = nullptr;
    const auto distance_m = [&](const Instance& instance) {
      return distance_between_m(instance.track.world_from_object, pose.world_from_object);
    };
    for (Instance& instance : instances)
      if (instance.track.object == pose.object && instance.track.state == TrackState::Lost &&
          (!nearest || distance_m(instance) < distance_m(*nearest)))
        nearest = &instance;
    if (!nearest) {
      add(pose.object, pose.world_from_object);
      continue;
    }
    nearest->track.world_from_object = pose.world_from_object;
    nearest->track.state = TrackState::Doubtful;
    nearest->track.doubtful_frames = 0;
    nearest->was_seen = false;
    nearest->motion = motion_from(pose.object, pose.world_from_object);
  }
}

// Null where no other instance lies before this one.
std::shared_ptr<const Occluders> Tracker::State::occluders_of(const Instance& instance,
                                                              double time_s) const {
  const auto place = [&](const Instance& of) {
    const EdgeModel& model = models[std::size_t(of.track.object)];
    return std::pair(of.motion.predicted(time_s) * model.center_m, model.radius_m);
  };
  const auto [center_m, radius_m] = place(instance);
  std::vector<ObjectPose> before;
  for (const Instance& other : instances) {
    if (&other == &instance || other.track.state != TrackState::Tracked) continue;
    const auto [other_m, other_radius_m] = place(other);
    if (!(other_m.z() > 0) || !(center_m.z() > 0) ||
        other_m.z() - other_radius_m > center_m.z() + radius_m)
      continue;
    const double apart =
        (other_m.head<2>() / other_m.z() - center_m.head<2>() / center_m.z()).norm();
    if (apart < radius_m / center_m.z() + other_radius_m / other_m.z())
      before.push_back({other.track.object, other.motion.predicted(time_s)});
  }
  ObjectView view;
  view.camera = undistorted(camera);
  return make_occluders(models, before, view, backend);
}

std::optional<FollowedPose> Tracker::State::registered(const Instance& instance,
                                                       const SearchedImage& image,
                                                       std::span<const Se3> starts,
                                                       const TimeLimit& limit) const {
  const EdgeModel& model = models[std::size_t(instance.track.object)];
  const std::optional<CroppedDetection> found =
      register_in_crop(image, model, starts, backend, options, limit);
  if (!found || found->probability < options.min_probability) return std::nullopt;
  const EdgeFollower follower(model, backend, options, nullptr);
  if (found->reduction > 1) return follower.follow(image, {&found->world_from_object, 1}, nullptr);
  return FollowedPose{found->world_from_object,
                      follower.measure(image, found->world_from_object, nullptr)};
}

void Tracker::State::update_track(Instance& instance, const FollowedPose& found, double time_s) {
  Track& track = instance.track;
  const EdgeModel& model = models[std::size_t(track.object)];
  track.above_chance = found.fit.above_chance();
  const bool is_found = is_on_object(found.fit, options);
  const bool agrees = track.above_chance >= options.lost_above_chance &&
                      !is_contradicted(found.fit.depth) &&
                      is_near(found.camera_from_object, instance.motion.predicted(time_s), model);
  const bool is_measured = (is_found || agrees) && found.fit.covariance.allFinite();
  if (is_measured)
    instance.motion.measured(found.camera_from_object, found.fit.covariance, time_s);
  else
    instance.motion.coast(time_s);
  track.world_from_object = instance.motion.pose();
  track.covariance = instance.motion.covariance();
  instance.was_seen = is_found && is_measured && is_determined(track, model);
  track.doubtful_frames = instance.was_seen ? 0 : track.doubtful_frames + 1;
  track.state = instance.was_seen                                 ? TrackState::Tracked
                : track.doubtful_frames > options.doubtful_frames ? TrackState::Lost
                                                                  : TrackState::Doubtful;
}

void Tracker::State::follow(Instance& instance, const SearchedImage& image, double time_s,
                            const TimeLimit& limit) {
  const EdgeModel& model = models[std::size_t(instance.track.object)];
  const std::shared_ptr<const Occluders> occluders = occluders_of(instance, time_s);
  const EdgeFollower follower(model, backend, options, occluders.get());
  const std::array starts{instance.motion.predicted(time_s), instance.motion.pose()};
  std::optional<SeenObject> earlier;
  if (instance.was_seen && last_image)
    earlier = SeenObject{searched(*last_image, camera), instance.track.world_from_object};
  FollowedPose found = follower.follow(image, starts, earlier ? &*earlier : nullptr);
  if (options.register_doubtful && !is_on_object(found.fit, options)) {
    const std::array from{starts[0], starts[1], found.camera_from_object};
    const std::optional<FollowedPose> better = registered(instance, image, from, limit);
    if (better && is_better(better->fit, found.fit)) found = *better;
  }
  update_track(instance, found, time_s);
}

Tracker::Tracker(std::span<const TemplateSet> sets, const Camera& camera, Backend& backend,
                 const TrackOptions& options) {
  options.validate();
  validate(camera, "tracker");
  state_ = std::make_unique<State>(sets, camera, backend, options);
}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

int Tracker::add(int object, const Se3& camera_from_object) {
  const Exclusive exclusive(state_->in_update);
  const int id = state_->add(object, camera_from_object);
  state_->publish();
  return id;
}

void Tracker::remove(int id) {
  const Exclusive exclusive(state_->in_update);
  check(std::erase_if(state_->instances,
                      [&](const auto& instance) { return instance.track.id == id; }) == 1,
        "tracker: no such id");
  state_->publish();
}

const std::vector<Track>& Tracker::tracks() const { return state_->tracks; }

const std::vector<Track>& Tracker::update(const TrackFrame& frame, const TimeLimit& limit) {
  State& state = *state_;
  const Exclusive exclusive(state.in_update);
  state.require(frame);
  if (state.last_time_s && !(frame.time_s > *state.last_time_s))
    throw InputError("frame", "time", fmt::format("{} s", frame.time_s),
                     fmt::format("later than the last frame, {} s", *state.last_time_s));
  const SearchedImage image = searched(*frame.image, state.camera, frame.depth.get());
  state.join_found();
  const TimeLimit latching = latched(limit);
  for (State::Instance& instance : state.instances)
    if (instance.track.state != TrackState::Lost)
      state.follow(instance, image, frame.time_s, latching);
  state.last_image = frame.image;
  state.last_time_s = frame.time_s;
  state.publish();
  return state.tracks;
}

int Tracker::search(const TrackFrame& frame, Backend& backend, const TimeLimit& limit) {
  State& state = *state_;
  const Exclusive exclusive(state.in_search);
  state.require(frame);
  std::vector<Track> tracks;
  {
    const std::lock_guard lock(state.shared);
    tracks = state.tracks;
  }
  PipelineOptions options = state.options.pipeline;
  options.limit = latched(limit);
  options.detect.min_probability = state.options.min_probability;
  std::optional<ObjectView> view;
  int found = 0;
  for (int object = 0; object < int(state.sets.size()); ++object) {
    const int missing = state.missing(object, tracks);
    if (missing == 0 || options.limit.is_over()) continue;
    const std::span<const TemplateSet> set = state.sets.subspan(std::size_t(object), 1);
    check(!set[0].views.empty(), "search: an object without templates");
    if (!view) {
      view = prepare_view(*frame.image, state.camera, Se3{}, backend, options);
      view->depth = frame.depth;
    }
    found += state.keep_found(detect_objects(*view, set, backend, options).detections, object,
                              missing, tracks);
  }
  return found;
}

}  // namespace edgescout
