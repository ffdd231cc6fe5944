// The parts of Scout::give: what one image adds to an active detection.
#include "host/active/candidates.h"
#include "host/active/reference_objects.h"
#include "host/active/scout.h"
#include "host/detect/search_space.h"
#include "host/register/occluders.h"
#include "kernels/error.h"

namespace edgescout {

Scout::Update Scout::begin_update(int view, const Se3& camera_from_world) const {
  Update next{state_, views_, {}};
  const bool as_proposed = proposal_ && proposal_->view == view;
  next.step.decision = as_proposed ? *proposal_ : decision_without_expectations(view);
  // The time of the proposal counts whether it was followed or not.
  if (proposal_) next.step.decision.stages = proposal_->stages;
  next.step.camera_from_world = camera_from_world;
  return next;
}

void Scout::add_image(Update& next, const Shot& shot) const {
  ScoutStep& step = next.step;
  ObjectView view = prepare_view(shot.image, camera_, step.camera_from_world, backend_,
                                 options_.pipeline, &step.stages);
  step.image = *view.image;
  step.depth = view.depth = shot.depth;
  Stopwatch watch(step.stages, backend_);
  add_tensors(view, sets_, backend_, options_.pipeline.tensor);
  next.views.push_back({std::move(view), {}});
  record_stage(watch, "tensors");
}

// Candidates next to and behind the known instances, refined over all images.
void Scout::search_image(Update& next) const {
  Stopwatch watch(next.step.stages, backend_);
  std::vector<Detection>& candidates = next.state.candidates;
  const std::vector<ObjectPose> known_now = known(next.state);
  set_occluders(next, known_now);
  if (candidates.empty() || options_.detect_in_every_image) {
    const std::vector<Detection> found = detect(next, known_now);
    candidates.insert(candidates.end(), found.begin(), found.end());
    ++next.step.searches;
    record_stage(watch, "detection");
  }
  const std::vector<ObjectView> views = views_of(next.views);
  const TimeLimit limit = until_cancelled();
  candidates = refined_candidates({models_, views, backend_, &limit}, sets_, candidates,
                                  static_cast<std::size_t>(options_.max_candidates),
                                  options_.pipeline.detect);
  record_stage(watch, "candidates");
}

std::vector<ObjectPose> Scout::known(const ScoutState& state) const {
  return known_objects(state.detections, options_.known_probability);
}

void Scout::set_occluders(Update& next, std::span<const ObjectPose> known) const {
  for (ScannedView& scanned : next.views)
    scanned.view.occluders = make_occluders(models_, known, scanned.view, backend_);
}

// In all images or in the newest alone (detect_jointly).
std::vector<Detection> Scout::detect(Update& next, std::span<const ObjectPose> known) const {
  const std::span<ScannedView> all = next.views;
  const std::span<ScannedView> images = options_.detect_jointly ? all : all.last(1);
  if (options_.detect) return call_detector(next, views_of(images), known);
  const TimeLimit limit = until_cancelled();
  for (ScannedView& image : images)
    scan_once(sets_, image, backend_, options_.pipeline.detect.scan, &limit);
  return candidates_in_images(sets_, images, known, backend_, options_.pipeline.detect, &limit);
}

std::vector<Detection> Scout::call_detector(const Update& next, std::span<const ObjectView> images,
                                            std::span<const ObjectPose> known) const {
  std::vector<int> views;
  for (const ScoutStep& before : next.state.steps) views.push_back(before.decision.view);
  views.push_back(next.step.decision.view);
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

// The particles after this image, and the instances that they show.
std::vector<Mode> Scout::update_belief(Update& next) const {
  ScoutState& state = next.state;
  ScoutStep& step = next.step;
  Stopwatch watch(step.stages, backend_);
  const std::vector<ObjectView> views = views_of(next.views);
  const TimeLimit limit = until_cancelled();
  const Scene scene{models_, views, backend_, &limit};
  add_particles(next);
  const bool reseeded = step.update.reseeded;
  step.update = update_particles(scene, state.particles, state.unseen_px2, state.candidates,
                                 options_.particles);
  step.update.reseeded |= reseeded;
  record_stage(watch, "particles");
  std::vector<Mode> modes =
      find_modes(state.particles, sets_, models_, options_.particles, backend_.threads());
  step.mode_probabilities.clear();
  for (const Mode& mode : modes) step.mode_probabilities.push_back(mode.probability);
  state.entropy_nats = step.entropy_nats = belief_entropy(modes);
  state.detections = step.detections =
      within_prior(mode_detections(scene, sets_, state.particles, modes, options_.detections));
  record_stage(watch, "modes");
  return modes;
}

// Without the poses that the prior in the world excludes.
std::vector<ModeDetection> Scout::within_prior(std::vector<ModeDetection> found) const {
  const std::vector<SearchSpace> spaces =
      search_spaces(options_.pipeline.detect.scan.world, models_);
  std::erase_if(found, [&](const ModeDetection& mode) {
    const Detection& pose = mode.detection;
    return !spaces[std::size_t(pose.object)].admits(pose.world_from_object);
  });
  return found;
}

// The first image: particles around all candidates. Later: a share of them around each candidate
// that has no particle.
void Scout::add_particles(Update& next) const {
  const ParticleOptions& o = options_.particles;
  ScoutState& state = next.state;
  ScoutStep& step = next.step;
  const bool first = state.particles.empty();
  if (step.before.empty()) step.before = state.particles;
  const std::vector<Detection> unknown =
      first ? state.candidates
            : without_particles(state.candidates, state.particles, sets_, o.mode_radius,
                                o.min_mode_probability);
  if (unknown.empty()) return;
  const Random random = Random(o.seed).split("new").split(state.steps.size());
  const std::size_t share =
      static_cast<std::size_t>(o.count) * unknown.size() / state.candidates.size();
  const std::vector<Particle> drawn = draw_particles(
      models_, unknown, std::max(1, static_cast<int>(share)), o.drawn,
      step.searches > 1 ? random.split(static_cast<std::uint64_t>(step.searches)) : random);
  state.particles.insert(state.particles.end(), drawn.begin(), drawn.end());
  step.before.insert(step.before.end(), drawn.begin(), drawn.end());
  step.new_candidates += count_new(unknown, state_.candidates, sets_, o.mode_radius);
}

// The particles for the next image.
void Scout::resample_particles(Update& next, std::span<const Mode> modes) const {
  Stopwatch watch(next.step.stages, backend_);
  next.step.resampled = resample_where_poor(next.state.particles, modes, models_, next.views.size(),
                                            options_.particles);
  next.step.after = next.state.particles;
  record_stage(watch, "modes");
}

void Scout::check_extrinsics(Update& next) const {
  Stopwatch watch(next.step.stages, backend_);
  const std::vector<ScoutStep>& earlier = next.state.steps;
  const std::vector<ExtrinsicsCheck> before =
      earlier.empty() ? std::vector<ExtrinsicsCheck>{} : earlier.back().extrinsics_checks;
  const std::vector<ObjectView> views = views_of(next.views);
  std::vector<ExtrinsicsCheck>& checks = next.step.extrinsics_checks;
  checks = extrinsics_check({models_, views, backend_},
                            reference_objects(models_, earlier, next.state.detections),
                            options_.extrinsics);
  keep_unrefuted_flags(before, checks);
  log_disagreements(checks, before);
  record_stage(watch, "extrinsics check");
}

void Scout::commit(Update next) {
  next.state.steps.push_back(std::move(next.step));
  next.state.overrule();
  state_ = std::move(next.state);
  views_ = std::move(next.views);
  discard_proposal();
}

}  // namespace edgescout
