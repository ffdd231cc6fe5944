// Active detection (paper, Sec. 5.4, Algorithm 2) as a state machine that a robot's control thread
// drives: propose a view, move there, give the image, read the state.
//
//   Scout scout(sets, camera, views, options, backend);
//   while (const auto proposal = scout.propose()) {
//     ... move the camera to views[proposal->view] ...
//     scout.give(proposal->view, image);  // or unreachable(proposal->view, why)
//   }
//   scout.state().detections;
//
// It has no thread of its own and no global state, and reads the clock only for timings and
// max_seconds. The same images in the same order give the same result. A call that throws leaves
// the state as it was.
//
// Public header.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>

#include "host/active/scout_options.h"
#include "host/active/scout_state.h"
#include "host/active/source.h"
#include "host/detect/scanned_view.h"

namespace edgescout {

// Thrown where ScoutOptions::cancelled returns true.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

class Scout {
 public:
  // Begins without an image. `camera` takes every image; `sets` and `backend` must outlive this
  // object. InputError: options out of bounds, no object, no view, views that are the same or not
  // rigid.
  Scout(std::span<const TemplateSet> sets, const Camera& camera,
        std::vector<Se3> camera_from_world_views, const ScoutOptions& options, Backend& backend);

  // Returns the next view, and what is expected of each. Nothing where an end is reached:
  // state().end says which. Called again without a new image or failure, it returns the same.
  std::optional<ScoutDecision> propose();

  // Adds the image from a view, which need not be the proposed one. The camera stood where the view
  // was planned, or at the given pose. InputError: a view that was taken or failed before, what
  // require_fitting refuses; LogicError: no such view.
  void give(int view, const Image& image);
  void give(int view, const Image& image, const Se3& camera_from_world);
  void give(int view, const Shot& shot);
  // Checks whether `give` would accept the shot. InputError: image or depth of another size than
  // the camera's, of another number of pixels than their size says, a pose that is not rigid.
  void require_fitting(const Shot& shot) const;
  // Leaves out a view that failed; it is never proposed again. InputError: a view that was taken or
  // failed before; LogicError: no such view.
  void unreachable(int view, const std::string& reason);

  const ScoutState& state() const { return state_; }
  // Continues from a saved state, as if its steps had been made here. InputError naming `source`:
  // another camera, other views or objects than this scout's, images that require_fitting refuses.
  void resume(ScoutState state, const std::string& source);

 private:
  // What a new image changes. It replaces the scout's state as a whole, so that an exception on the
  // way changes nothing.
  struct Update {
    ScoutState state;
    std::vector<ScannedView> views;  // of all images, the new one last
    ScoutStep step;                  // of the new image
  };

  // The parts of `give`, in this order.
  Update begin_update(int view, const Se3& camera_from_world) const;
  void add_image(Update& next, const Shot& shot) const;
  void search_image(Update& next) const;
  std::vector<Mode> update_belief(Update& next) const;
  std::vector<ModeDetection> within_prior(std::vector<ModeDetection> found) const;
  void resample_particles(Update& next, std::span<const Mode> modes) const;
  void check_extrinsics(Update& next) const;
  void commit(Update next);

  std::vector<ObjectPose> known(const ScoutState& state) const;
  void set_occluders(Update& next, std::span<const ObjectPose> known) const;
  std::vector<Detection> detect(Update& next, std::span<const ObjectPose> known) const;
  std::vector<Detection> call_detector(const Update& next, std::span<const ObjectView> images,
                                       std::span<const ObjectPose> known) const;
  void add_particles(Update& next) const;

  // The parts of `propose`.
  ScoutEnd end_before_decision() const;
  bool is_certain() const;
  bool gained_little() const;
  bool expects_little(const ScoutDecision& decision) const;
  ScoutDecision decide() const;
  ScoutDecision decision_without_expectations(int view) const;
  BitMatrix draw_combinations(ScoutDecision& decision) const;
  int first_open_view() const;

  void require_open(int view) const;
  void discard_proposal();
  void record_stage(Stopwatch& watch, const char* stage) const;
  void throw_if_cancelled() const;
  bool is_cancelled() const;
  TimeLimit until_cancelled() const;  // lives no longer than this object

  std::span<const TemplateSet> sets_;
  Camera camera_;
  ScoutOptions options_;
  Backend& backend_;
  std::vector<EdgeModel> models_;
  std::vector<TemplateTable> tables_;
  ScoutState state_;
  std::vector<ScannedView> views_;  // of the images so far
  // The answer of propose() until there is a new image or failure.
  std::optional<ScoutDecision> proposal_;
  mutable bool was_cancelled_ = false;  // since the last call began
  bool has_ended_ = false;              // by a decision, which need not be made again
};

// Runs the loop to its end. Views that cannot be acquired, or whose shot does not fit the camera,
// are marked as failed. `on_step` is called after every image or failure.
void run_scout(Scout& scout, ViewSource& source,
               const std::function<void(const ScoutState&)>& on_step = {});

}  // namespace edgescout
