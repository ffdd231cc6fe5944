// Everything an active detection knows, step by step: what a log, a page or a robot's program
// reads, and what is saved after every step.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/active/extrinsics_check.h"
#include "host/active/modes.h"
#include "host/active/next_view.h"
#include "host/active/particles.h"
#include "host/core/camera.h"
#include "host/core/stopwatch.h"

namespace edgescout {

// Why a view, and what was thought when it was chosen.
struct ScoutDecision {
  int view = 0;
  Strategy strategy = Strategy::Information;  // by which `views` was judged
  bool use_paper_formula = false;  // by the paper's own formula, which does not count in nats
  // one a view; empty for the first image, of which nothing can be expected
  std::vector<ViewInformation> views;
  std::vector<Detection> candidates;  // world, at that time
  // of the sampled combinations: indices into the candidates. Empty where none were sampled
  std::vector<int> likeliest, unlikeliest;
  std::vector<StageSeconds> stages;
};

// One image and what it changed.
struct ScoutStep {
  ScoutDecision decision;
  Se3 camera_from_world;  // as given
  Image image;            // undistorted
  int searches = 0;       // of this image: ScoutOptions::max_searches
  std::size_t new_candidates =
      0;  // that no particle is near, nor any candidate there was before this image
  // before this image's say, those drawn around its new candidates included
  std::vector<Particle> before;
  std::vector<Particle> after;
  ParticleUpdate update;
  bool resampled = false;  // after `detections` were reported (resample_where_poor)
  std::vector<ModeDetection> detections;
  // one a step so far: the later images' say on this and the earlier ones
  std::vector<ExtrinsicsCheck> extrinsics_checks;
  std::vector<double> mode_probabilities;  // of all modes, before resampling; heaviest mode first
  double entropy_nats = 0;                 // belief_entropy of these
  std::vector<StageSeconds> stages;  // in the order they ran first, those of all searches together
};

struct FailedView {
  int view = 0;
  std::string reason;
  std::size_t after_step = 0;        // number of images when it failed
  std::vector<StageSeconds> stages;  // of the decision for it
};

enum class ScoutEnd {
  No,
  ViewBudget,
  NoViewLeft,
  Certain,
  LittleToLearn,
  LittleLearned,
  TimeLimit
};
std::string to_string(ScoutEnd end);  // "", "view budget", ..

// What tells the objects of one run from those of another.
struct ScoutObject {
  int id = 1;                     // BOP obj_id
  std::uint64_t fingerprint = 0;  // of its model and symmetries
  bool operator==(const ScoutObject&) const = default;
};

struct ScoutState {
  std::vector<ScoutObject> objects;  // that are sought, in their order
  Camera camera;                     // that takes every image
  std::vector<Se3> views;            // camera_from_world of all possible views
  std::vector<ScoutStep> steps;
  std::vector<FailedView> failed;     // never proposed again
  std::vector<Detection> candidates;  // world, best probability first
  std::vector<Particle> particles;
  std::vector<double> unseen_px2;         // weigh_particles', one an image
  std::vector<ModeDetection> detections;  // the modes that are instances, best probability first
  double entropy_nats = 0;
  ScoutEnd end = ScoutEnd::No;
  ScoutDecision
      last_decision;  // that no image followed: of an end that was decided on (LittleToLearn)
  double overruled_seconds = 0;  // of such decisions after which it went on all the same

  // One a view: nonzero where it was taken or cannot be reached.
  std::vector<char> closed() const;
  // Of all steps and decisions, those for views that failed included: the machine's, not the arm's.
  double seconds() const;
  // Goes on after the end that last_decision was.
  void overrule();
};

// A versioned binary file (io/binary_file.h), atomically. Loading throws InputError naming the
// file: of another kind or version, cut short, a wrong checksum.
void save_scout_state(const ScoutState& state, const std::filesystem::path& file);
ScoutState load_scout_state(const std::filesystem::path& file);

// InputError naming `source`: `saved` has another camera, other views or objects than `run`, or
// speaks of one that is none.
void require_same_run(const ScoutState& saved, const ScoutState& run, const std::string& source);

}  // namespace edgescout
