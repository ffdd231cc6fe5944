#include "host/track/tracker.h"

#include <cstring>
#include <mutex>

#include "host/bindings/c/src/depth.h"
#include "host/bindings/c/src/images.h"
#include "host/bindings/c/src/limits.h"
#include "host/bindings/c/src/poses.h"
#include "host/bindings/c/src/results.h"
#include "host/bindings/c/src/structs.h"
#include "kernels/error.h"

namespace edgescout::c {

namespace {

// A frame of the caller. What it points to may be gone once a call waits for a backend.
struct TakenFrame {
  explicit TakenFrame(const edgescout_frame& given)
      : frame{std::make_shared<const Image>(image_of(given.image)), given.time_s},
        depth(take_depth({given.depth, given.depth_camera, given.camera_from_depth}, "frame")) {}

  // With depth in the frame of an image of this camera.
  TrackFrame in(const Camera& camera, ThreadPool& pool) const {
    TrackFrame result = frame;
    result.depth = in_camera(depth, camera, pool);
    return result;
  }

  TrackFrame frame;
  std::optional<TakenDepth> depth;
};

// What follows the frame in a search lies where the caller's frame ends.
edgescout_search read_search(const edgescout_search* given) {
  const std::size_t size = struct_size_of(given, "search");
  constexpr std::size_t frame_begin = offsetof(edgescout_search, frame),
                        rest_begin = frame_begin + sizeof(edgescout_frame),
                        rest_size = sizeof(edgescout_search) - rest_begin;
  const std::size_t rest_given = frame_begin + struct_size_of(&given->frame, "search.frame");
  if (rest_given + rest_size > size)
    refuse(EDGESCOUT_WRONG_VERSION, "search.struct_size", std::to_string(size),
           "at least " + std::to_string(rest_given + rest_size) + " with this frame");
  require_zeros(given, rest_given + rest_size, size, "search");
  edgescout_search search{};
  search.frame = read_struct(&given->frame, "search.frame");
  std::memcpy(reinterpret_cast<unsigned char*>(&search) + rest_begin,
              reinterpret_cast<const unsigned char*>(given) + rest_given, rest_size);
  if (search.frame.limit)
    refuse(EDGESCOUT_BAD_INPUT, "search.frame.limit", "a limit", "NULL: that of the search counts");
  return search;
}

}  // namespace

// A tracker with what it refers to.
class FollowingTracker {
 public:
  explicit FollowingTracker(const edgescout_tracker_plan& plan)
      : templates_(live(plan.templates)),
        backend_(live(plan.backend)),
        camera_(*shared(plan.camera)),
        tracker_(templates_->value.sets, camera_, *backend_->value.backend,
                 options_of<TrackOptions>(plan.options)) {}

  int add(std::int32_t object, const double* camera_from_object) {
    if (object < 0 || std::size_t(object) >= templates_->value.sets.size())
      refuse(EDGESCOUT_BAD_INPUT, "object", std::to_string(object),
             "one of " + std::to_string(templates_->value.sets.size()) + " parts");
    return tracker_.add(object, pose_of(camera_from_object, "camera_from_object"));
  }

  void remove(std::int32_t id) {
    try {
      tracker_.remove(id);
    } catch (const LogicError&) {
      refuse(EDGESCOUT_BAD_INPUT, "id", std::to_string(id), "that of an instance");
    }
  }

  void update(const edgescout_frame& frame) {
    const TimeLimit limit = limit_of(frame.limit);
    const TakenFrame taken(frame);
    const Borrowed<edgescout_backend> on(backend_, Use::Exclusive);
    tracker_.update(taken.in(camera_, on->backend->threads()), limit);
  }

  // Beside calls of other threads.
  int search(const edgescout_search& search) {
    const TimeLimit limit = limit_of(search.limit);
    const TakenFrame taken(search.frame);
    const auto on = exclusive(search.backend);
    const std::unique_lock lock(searching_, std::try_to_lock);
    if (!lock)
      refuse(EDGESCOUT_BUSY, "tracker", "one that another search uses", "one search at a time");
    return tracker_.search(taken.in(camera_, on->backend->threads()), *on->backend, limit);
  }

  const std::vector<Track>& tracks() const { return tracker_.tracks(); }

 private:
  std::shared_ptr<Live<edgescout_templates>> templates_;
  std::shared_ptr<Live<edgescout_backend>> backend_;
  Camera camera_;  // lens included
  Tracker tracker_;
  std::mutex searching_;
};

namespace {

edgescout_track shown_track(const Track& track) {
  edgescout_track shown{};
  shown.id = track.id;
  shown.object = track.object;
  shown.state = std::int32_t(track.state);
  shown.doubtful_frames = track.doubtful_frames;
  write_pose(track.world_from_object, shown.camera_from_object);
  write_covariance(track.covariance, shown.covariance);
  shown.above_chance = track.above_chance;
  return shown;
}

}  // namespace

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_tracker_create(const edgescout_tracker_plan* plan,
                                          edgescout_tracker** out) {
  return create(out, [&] { return std::make_shared<FollowingTracker>(read_struct(plan, "plan")); });
}

edgescout_status edgescout_tracker_add(edgescout_tracker* tracker, int32_t object,
                                       const double camera_from_object[16], int32_t* id) {
  return guarded([&] {
    const auto given = exclusive(tracker);
    require(id, "id");
    *id = (*given)->add(object, camera_from_object);
  });
}

edgescout_status edgescout_tracker_remove(edgescout_tracker* tracker, int32_t id) {
  return guarded([&] { (*exclusive(tracker))->remove(id); });
}

edgescout_status edgescout_tracker_update(edgescout_tracker* tracker,
                                          const edgescout_frame* frame) {
  return guarded([&] { (*exclusive(tracker))->update(read_struct(frame, "frame")); });
}

edgescout_status edgescout_tracker_search(edgescout_tracker* tracker,
                                          const edgescout_search* search, size_t* found) {
  return guarded([&] {
    const auto given = live(tracker);
    require(found, "found");
    *found = std::size_t(given->value->search(read_search(search)));
  });
}

edgescout_status edgescout_tracker_count(const edgescout_tracker* tracker, size_t* out) {
  return guarded([&] {
    require(out, "out");
    *out = (*shared(tracker))->tracks().size();
  });
}

edgescout_status edgescout_tracker_at(const edgescout_tracker* tracker, size_t index,
                                      edgescout_track* out) {
  return guarded([&] {
    const auto given = shared(tracker);
    const std::vector<edgescout::Track>& tracks = (*given)->tracks();
    require_index(index, tracks.size(), "index");
    write_struct(shown_track(tracks[index]), out, "out");
  });
}
