#include "host/active/scout.h"

#include <algorithm>
#include <cmath>

#include "host/active/candidates.h"
#include "host/active/reference_objects.h"
#include "host/active/views.h"
#include "host/core/log.h"
#include "host/io/binary_file.h"
#include "host/register/occluders.h"
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

// Lines 14 to 20. Works on copies: an exception leaves everything as it was.
void Scout::give(int view, const Image& image, const Se3& camera_from_world) {
  require_open(view);
  require_fitting(image, camera_from_world);
  ScoutState next = state_;
  std::vector<Observation> observations = observations_;
  ScoutStep step;
  step.decision = proposal_ && proposal_->view == view ? *proposal_ : without_expectations(view);
  if (proposal_) step.decision.stages = proposal_->stages;  // spent, whether followed or not
  step.camera_from_world = camera_from_world;
  look(image, step, observations);
  const auto known = [&] { return known_objects(next.detections, options_.known_probability); };
  std::size_t known_before = 0;
  std::vector<Mode> modes;
  do {
    known_before = known().size();
    search(known(), step, next, observations);
    modes = believe(step, next, views_of(observations));
  } while (options_.detect_in_every_image && step.searches < options_.max_searches &&
           known().size() > known_before);
  conclude(step, next, modes, views_of(observations));
  next.steps.push_back(std::move(step));
  next.overrule();
  state_ = std::move(next);
  observations_ = std::move(observations);
  forget_answer();
}

void Scout::unreachable(int view, const std::string& reason) {
  require_open(view);
  log(LogLevel::Warning, "view " + std::to_string(view) + " cannot be had: " + reason);
  state_.failed.push_back({view, reason, state_.steps.size(),
                           proposal_ ? proposal_->stages : std::vector<StageSeconds>{}});
  state_.overrule();
  forget_answer();
}

void Scout::forget_answer() {
  proposal_.reset();
  has_ended_ = false;
}

// Line 1: the image's edges and tensors.
void Scout::look(const Image& image, ScoutStep& step,
                 std::vector<Observation>& observations) const {
  const PreparedImage prepared =
      prepare_image(image, camera_, step.camera_from_world, backend_, options_.pipeline);
  step.image = prepared.image;
  step.stages = prepared.stages;
  Stopwatch watch(step.stages);
  observations.push_back(observe_prepared(prepared, sets_, backend_, options_.pipeline));
  done(watch, "tensors");
}

// Lines 2 and 3: what may be in the image beside and behind the known, refined over all images.
void Scout::search(std::span<const ObjectPose> known, ScoutStep& step, ScoutState& next,
                   std::span<Observation> observations) const {
  Stopwatch watch(step.stages);
  hide_behind(known, observations);
  if (next.candidates.empty() || options_.detect_in_every_image) {
    const std::vector<Detection> found = detect(step, known, observations);
    next.candidates.insert(next.candidates.end(), found.begin(), found.end());
    ++step.searches;
    done(watch, "detection");
  }
  next.candidates = refined_candidates(sets_, models_, next.candidates, views_of(observations),
                                       static_cast<std::size_t>(options_.max_candidates), backend_,
                                       options_.pipeline.detect);
  done(watch, "candidates");
}

// In all images or, each alone, in the newest.
std::vector<Detection> Scout::detect(const ScoutStep& step, std::span<const ObjectPose> known,
                                     std::span<Observation> observations) const {
  const std::span<Observation> images =
      options_.detect_jointly ? observations : observations.last(1);
  if (!options_.detect) {
    for (Observation& image : images)
      scan_for(sets_, image, backend_, options_.pipeline.detect.scan);
    return candidates_in_images(sets_, images, known, backend_, options_.pipeline.detect);
  }
  std::vector<int> views;
  for (const ScoutStep& before : state_.steps) views.push_back(before.decision.view);
  views.push_back(step.decision.view);
  std::vector<Detection> found =
      options_.detect(std::span(views).last(images.size()), images, known);
  for (const Detection& candidate : found) {
    if (candidate.object < 0 || candidate.object >= static_cast<int>(sets_.size()))
      throw InputError("scout", "detected object", std::to_string(candidate.object),
                       "one of " + std::to_string(sets_.size()));
    require_rigid(candidate.world_from_object, "scout", "detected pose");
  }
  return found;
}

void Scout::hide_behind(std::span<const ObjectPose> known,
                        std::span<Observation> observations) const {
  for (Observation& observation : observations)
    observation.view.occluders = make_occluders(models_, known, observation.view, backend_);
}

// Lines 11 and 15 to 17: the particles after this image, and the instances they amount to.
std::vector<Mode> Scout::believe(ScoutStep& step, ScoutState& next,
                                 std::span<const RegisterView> views) const {
  Stopwatch watch(step.stages);
  add_particles(step, next);
  const bool reseeded = step.update.reseeded;
  step.update = update_particles(next.particles, next.unseen_px2, models_, next.candidates, views,
                                 backend_, options_.particles);
  step.update.reseeded |= reseeded;
  done(watch, "particles");
  const std::vector<Mode> modes =
      find_modes(next.particles, sets_, models_, options_.particles, backend_.threads());
  step.mode_probabilities.clear();
  for (const Mode& mode : modes) step.mode_probabilities.push_back(mode.probability);
  next.entropy_nats = step.entropy_nats = belief_entropy(modes);
  next.detections = step.detections =
      mode_detections(next.particles, modes, sets_, models_, views, backend_, options_.detections);
  done(watch, "modes");
  return modes;
}

// Lines 18 and 19: the particles for the next image, and what the images say to the instances.
void Scout::conclude(ScoutStep& step, ScoutState& next, std::span<const Mode> modes,
                     std::span<const RegisterView> views) const {
  Stopwatch watch(step.stages);
  step.resampled =
      resample_where_poor(next.particles, modes, models_, views.size(), options_.particles);
  step.after = next.particles;
  done(watch, "modes");
  const std::vector<ExtrinsicsCheck> before =
      next.steps.empty() ? std::vector<ExtrinsicsCheck>{} : next.steps.back().extrinsics_checks;
  step.extrinsics_checks =
      extrinsics_check(models_, reference_objects(models_, next.steps, next.detections), views,
                       backend_, options_.extrinsics_checks);
  keep_flags(before, step.extrinsics_checks);
  warn_of(step.extrinsics_checks, before);
  done(watch, "extrinsics_checks");
}

// Around the first image's candidates all of them; later a share around each candidate that no
// particle is near.
void Scout::add_particles(ScoutStep& step, ScoutState& next) const {
  const ParticleOptions& o = options_.particles;
  const bool first = next.particles.empty();
  if (step.before.empty()) step.before = next.particles;
  const std::vector<Detection> unknown =
      first ? next.candidates
            : without_particles(next.candidates, next.particles, sets_, o.mode_radius,
                                o.min_mode_probability);
  if (unknown.empty()) return;
  const Random random = Random(o.seed).split("new").split(next.steps.size());
  const std::size_t share =
      static_cast<std::size_t>(o.count) * unknown.size() / next.candidates.size();
  const std::vector<Particle> drawn = draw_particles(
      models_, unknown, std::max(1, static_cast<int>(share)), o.drawn,
      step.searches > 1 ? random.split(static_cast<std::uint64_t>(step.searches)) : random);
  next.particles.insert(next.particles.end(), drawn.begin(), drawn.end());
  step.before.insert(step.before.end(), drawn.begin(), drawn.end());
  step.new_candidates += count_new(unknown, state_.candidates, sets_, o.mode_radius);
}

void Scout::done(Stopwatch& watch, const char* stage) const {
  watch.lap(stage);
  stop_where_cancelled();
}

void Scout::stop_where_cancelled() const {
  if (options_.cancelled && options_.cancelled()) throw Cancelled();
}

void Scout::require_open(int view) const {
  check(view >= 0 && view < static_cast<int>(state_.views.size()), "Scout: no such view");
  if (state_.closed()[static_cast<std::size_t>(view)])
    throw InputError("scout", "view", std::to_string(view) + " again",
                     "one neither taken nor given up");
}

void Scout::require_fitting(const Image& image, const Se3& camera_from_world) const {
  if (image.pixels.size() !=
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    throw InputError("scout", "image", std::to_string(image.pixels.size()) + " pixels",
                     std::to_string(image.width) + "x" + std::to_string(image.height));
  if (image.width != camera_.width || image.height != camera_.height)
    throw InputError(
        "scout", "image size", std::to_string(image.width) + "x" + std::to_string(image.height),
        "the camera's " + std::to_string(camera_.width) + "x" + std::to_string(camera_.height));
  validate_views({&camera_from_world, 1}, "scout: camera pose");
}

void Scout::resume(ScoutState state, const std::string& source) {
  require_same_run(state, state_, source);
  std::vector<Observation> observations;
  for (const ScoutStep& step : state.steps) {
    try {
      require_fitting(step.image, step.camera_from_world);
    } catch (const InputError& error) {
      throw InputError(source + ": " + error.what());
    }
    const PreparedImage prepared = prepare_image(
        step.image, undistorted(camera_), step.camera_from_world, backend_, options_.pipeline);
    observations.push_back(observe_prepared(prepared, sets_, backend_, options_.pipeline));
    stop_where_cancelled();
  }
  state_ = std::move(state);
  observations_ = std::move(observations);
  forget_answer();
}

}  // namespace edgescout
