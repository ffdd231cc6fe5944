#include "host/track/tracker.h"

#include <mutex>

#include "host/bindings/c/src/images.h"
#include "host/bindings/c/src/limits.h"
#include "host/bindings/c/src/poses.h"
#include "host/bindings/c/src/results.h"
#include "host/bindings/c/src/structs.h"
#include "kernels/error.h"

namespace edgescout::c {

namespace {

TrackFrame frame_of(const edgescout_frame& frame) {
  return {std::make_shared<const Image>(image_of(frame.image)), frame.time_s};
}

}  // namespace

// A tracker with what it refers to.
class FollowingTracker {
 public:
  explicit FollowingTracker(const edgescout_tracker_plan& plan)
      : templates_(live(plan.templates)),
        backend_(live(plan.backend)),
        tracker_(templates_->value.sets, *shared(plan.camera), *backend_->value.backend,
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
    const TrackFrame taken = frame_of(frame);
    const Borrowed<edgescout_backend> on(backend_, Use::Exclusive);
    tracker_.update(taken);
  }

  // Beside calls of other threads.
  int search(const edgescout_search& search) {
    const TimeLimit limit = limit_of(search.limit);
    const TrackFrame taken = frame_of(read_struct(&search.frame, "search.frame"));
    const auto on = exclusive(search.backend);
    const std::unique_lock lock(searching_, std::try_to_lock);
    if (!lock)
      refuse(EDGESCOUT_BUSY, "tracker", "one that another search uses", "one search at a time");
    return tracker_.search(taken, *on->backend, limit);
  }

  const std::vector<Track>& tracks() const { return tracker_.tracks(); }

 private:
  std::shared_ptr<Live<edgescout_templates>> templates_;
  std::shared_ptr<Live<edgescout_backend>> backend_;
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
    *found = std::size_t(given->value->search(read_struct(search, "search")));
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
