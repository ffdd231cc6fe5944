// An active detection step by step: lines 14 to 20 of Algorithm 2 in Scout::give. scout_decide.cpp
// chooses the next view (lines 4 to 10 and 13), scout_end.cpp ends the run, scout_update.cpp has
// the parts of `give`.
#include "host/active/scout.h"

#include <cmath>

#include "host/active/views.h"
#include "host/core/image_size.h"
#include "host/core/log.h"
#include "host/io/binary_file.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

std::vector<TemplateTable> tables_of(std::span<const TemplateSet> sets, Backend& backend) {
  std::vector<TemplateTable> tables;
  for (const TemplateSet& set : sets)
    tables.push_back(make_template_table(
        set.model, std::sqrt(set.options.distance_min_m * set.options.distance_max_m), backend));
  return tables;
}

std::vector<ScoutObject> objects_of(std::span<const TemplateSet> sets) {
  std::vector<ScoutObject> objects;
  for (const TemplateSet& set : sets) {
    BinaryWriter bytes;
    bytes.put(fingerprint(set.model));
    for (const Se3& symmetry : set.symmetries.discrete) bytes.put_pose(symmetry);
    objects.push_back({set.object_id, checksum(bytes.bytes)});
  }
  return objects;
}

}  // namespace

Scout::Scout(std::span<const TemplateSet> sets, const Camera& camera,
             std::vector<Se3> camera_from_world_views, const ScoutOptions& options,
             Backend& backend)
    : sets_(sets), camera_(camera), options_(options), backend_(backend), models_(models_of(sets)) {
  options_.particles.sigma_px = options_.next_view.sigma_px;
  options_.pipeline.detect.penetration_m = options_.particles.penetration_m;
  options_.validate();
  if (sets.empty()) throw InputError("scout: found no object, expected at least one");
  validate(camera, "scout: camera");
  validate_views(camera_from_world_views, "scout: views");
  if (options_.first_view >= static_cast<int>(camera_from_world_views.size()))
    throw InputError("options", "scout.first_view", std::to_string(options_.first_view),
                     "one of " + std::to_string(camera_from_world_views.size()) + " views");
  for (const int view : options_.next_view.sequence)
    if (view < 0 || view >= static_cast<int>(camera_from_world_views.size()))
      throw InputError("options", "scout.sequence", std::to_string(view),
                       "one of " + std::to_string(camera_from_world_views.size()) + " views");
  tables_ = tables_of(sets, backend);
  state_.objects = objects_of(sets);
  state_.camera = camera_;
  state_.views = std::move(camera_from_world_views);
}

void Scout::give(int view, const Image& image) {
  check(view >= 0 && view < static_cast<int>(state_.views.size()), "Scout::give: no such view");
  give(view, image, state_.views[static_cast<std::size_t>(view)]);
}

void Scout::give(int view, const Image& image, const Se3& camera_from_world) {
  give(view, Shot{image, camera_from_world});
}

// Works on a copy: an exception leaves everything as it was.
void Scout::give(int view, const Shot& shot) {
  require_open(view);
  require_fitting(shot);
  was_cancelled_ = false;
  Update next = begin_update(view, shot.camera_from_world);
  add_image(next, shot);  // edges and tensors: line 14
  std::vector<Mode> modes;
  bool more_known = true;
  while (more_known) {
    const std::size_t known_before = known(next.state).size();
    search_image(next);           // object candidates: lines 2 and 3
    modes = update_belief(next);  // particles and instances: lines 11 and 15 to 17
    more_known = options_.detect_in_every_image && next.step.searches < options_.max_searches &&
                 known(next.state).size() > known_before;
  }
  resample_particles(next, modes);  // lines 18 and 19
  check_extrinsics(next);
  commit(std::move(next));
}

void Scout::unreachable(int view, const std::string& reason) {
  require_open(view);
  log(LogLevel::Warning, "view " + std::to_string(view) + " cannot be had: " + reason);
  state_.failed.push_back({view, reason, state_.steps.size(),
                           proposal_ ? proposal_->stages : std::vector<StageSeconds>{}});
  state_.overrule();
  discard_proposal();
}

void Scout::resume(ScoutState state, const std::string& source) {
  require_same_run(state, state_, source);
  was_cancelled_ = false;
  std::vector<ScannedView> views;
  std::vector<StageSeconds> not_counted;  // the saved state has the times of the first run
  for (const ScoutStep& step : state.steps) {
    try {
      require_fitting({step.image, step.camera_from_world, step.depth});
    } catch (const InputError& error) {
      throw InputError(source + ": " + error.what());
    }
    ObjectView view = prepare_view(step.image, undistorted(camera_), step.camera_from_world,
                                   backend_, options_.pipeline, &not_counted);
    view.depth = step.depth;
    add_tensors(view, sets_, backend_, options_.pipeline.tensor);
    views.push_back({std::move(view), {}});
    throw_if_cancelled();
  }
  state_ = std::move(state);
  views_ = std::move(views);
  discard_proposal();
}

void Scout::require_open(int view) const {
  check(view >= 0 && view < static_cast<int>(state_.views.size()), "Scout: no such view");
  if (state_.closed()[static_cast<std::size_t>(view)])
    throw InputError("scout", "view", std::to_string(view) + " again",
                     "one neither taken nor given up");
}

void Scout::require_fitting(const Shot& shot) const {
  require_size_of(camera_, shot.image, "scout");
  if (shot.depth) require_size_of(camera_, shot.depth->image, "scout");
  validate_views({&shot.camera_from_world, 1}, "scout: camera pose");
}

void Scout::discard_proposal() {
  proposal_.reset();
  has_ended_ = false;
}

void Scout::record_stage(Stopwatch& watch, const char* stage) const {
  watch.lap(stage);
  throw_if_cancelled();
}

void Scout::throw_if_cancelled() const {
  if (is_cancelled()) throw Cancelled();
}

// What ends because of one answer must not be taken for complete after the next.
bool Scout::is_cancelled() const {
  was_cancelled_ = was_cancelled_ || (options_.cancelled && options_.cancelled());
  return was_cancelled_;
}

TimeLimit Scout::until_cancelled() const {
  if (!options_.cancelled) return {};
  return {{}, [this] { return is_cancelled(); }};
}

}  // namespace edgescout
