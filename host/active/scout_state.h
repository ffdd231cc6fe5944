// The whole state of an active detection, step by step: what a log, a page or a robot's program
// reads, and what is saved after every step.
//
// Public header.
#pragma once

#include <filesystem>
#include <memory>
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
#include "host/register/measured_depth.h"

namespace edgescout {

// A chosen view and what was expected when it was chosen.
struct ScoutDecision {
  int view = 0;
  Strategy strategy = Strategy::Information;  // by which `views` was computed
  bool use_paper_formula = false;  // the paper's own formula, whose information is not in nats
  // One per possible view. Empty for the first image, of which nothing can be expected.
  std::vector<ViewInformation> views;
  std::vector<Detection> candidates;  // world, at that time
  // The most and the least probable of the sampled combinations: indices into the candidates. Empty
  // where none were sampled.
  std::vector<int> likeliest, unlikeliest;
  std::vector<StageSeconds> stages;
};

// One image and what it changed.
struct ScoutStep {
  ScoutDecision decision;
  Se3 camera_from_world;                       // as given
  Image image;                                 // undistorted
  std::shared_ptr<const MeasuredDepth> depth;  // null: none was given
  int searches = 0;                            // of this image: ScoutOptions::max_searches
  // Candidates near no particle and near no candidate that was known before this image.
  std::size_t new_candidates = 0;
  // The particles before this image was used, with those that were drawn around its new candidates.
  std::vector<Particle> before;
  std::vector<Particle> after;
  ParticleUpdate update;
  bool resampled = false;  // after `detections` were made (resample_where_poor)
  std::vector<ModeDetection> detections;
  // One per step so far: a later image also checks the earlier ones.
  std::vector<ExtrinsicsCheck> extrinsics_checks;
  std::vector<double> mode_probabilities;  // of all modes, before resampling; heaviest mode first
  double entropy_nats = 0;                 // belief_entropy of these modes
  // In the order they ran first; the searches of one image are added up.
  std::vector<StageSeconds> stages;
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

// Identifies an object, so that a saved state is not continued with other objects.
struct ScoutObject {
  int id = 1;                     // BOP obj_id
  std::uint64_t fingerprint = 0;  // of its model and symmetries
  bool operator==(const ScoutObject&) const = default;
};

struct ScoutState {
  std::vector<ScoutObject> objects;  // to find, in the caller's order
  Camera camera;                     // of every image
  std::vector<Se3> views;            // camera_from_world of all possible views
  std::vector<ScoutStep> steps;
  std::vector<FailedView> failed;     // never proposed again
  std::vector<Detection> candidates;  // world, most probable first
  std::vector<Particle> particles;
  std::vector<double> unseen_px2;         // of weigh_particles, one per image
  std::vector<ModeDetection> detections;  // modes that are instances, most probable first
  double entropy_nats = 0;
  ScoutEnd end = ScoutEnd::No;
  // The decision that no image followed: the one that ended the run (LittleToLearn).
  ScoutDecision last_decision;
  double overruled_seconds = 0;  // of such decisions after which the run was continued

  // Returns a number for each possible view: nonzero where it was taken or failed.
  std::vector<char> closed() const;
  // Returns the computing time of all steps and decisions, with those for failed views; without the
  // arm's motion.
  double seconds() const;
  // Continues after the end that last_decision was.
  void overrule();
};

// Writes or reads a versioned binary file (io/binary_file.h). It is written atomically. Loading
// throws InputError naming the file: of another kind or version, cut short, a wrong checksum.
void save_scout_state(const ScoutState& state, const std::filesystem::path& file);
ScoutState load_scout_state(const std::filesystem::path& file);

// Checks that a saved state is of this run. InputError naming `source`: `saved` has another camera,
// other views or objects than `run`, or an index of an object, view or candidate that does not
// exist.
void require_same_run(const ScoutState& saved, const ScoutState& run, const std::string& source);

}  // namespace edgescout
