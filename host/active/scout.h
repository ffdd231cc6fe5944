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
// No thread of its own, no global state, no clock but for timings and max_seconds: the same images
// in the same order give the same result. Each call leaves the state as it was where it throws.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>

#include "host/active/combinations.h"
#include "host/active/scout_state.h"
#include "host/active/source.h"
#include "host/pipeline.h"

namespace edgescout {

// Thrown where ScoutOptions::cancelled says so.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

struct ScoutOptions {
  PipelineOptions pipeline = scout_defaults();
  int max_candidates = 40;  // kept of all objects together (the paper's N_obj)
  bool detect_in_every_image =
      true;  // else until there are candidates: in the first alone, as in the paper
  // A detector of one's own in place of candidates_in_images (candidates.h): what may be in the
  // images of these views, in the world. The last one is new, the others are those before it, as
  // far as detection may use them; `known` are the instances that need not be found again.
  // InputError from give(): an object that is none, a pose that is not rigid.
  std::function<std::vector<Detection>(std::span<const int> views,
                                       std::span<const Observation> images,
                                       std::span<const ObjectPose> known)>
      detect;
  // later images are searched together with those before (detect/rescore_in_views.h); else each
  // alone
  bool detect_jointly = true;
  // Reported instances (detections.min_probability) as probable as this are known: they are not
  // sought in later images, and hide what is behind them (register/occluders.h): what they cover
  // counts neither for nor against other poses, but leaves fewer edges to be certain by. Above 1:
  // none are.
  double known_probability = 0.9;
  // Of one image. While what the last search of it found makes more instances known, it is searched
  // once more for what is behind and beside them, the places of the best hits being free then. Only
  // where detect_in_every_image is. 1: as in the paper.
  int max_searches = 2;
  CombinationOptions
      combinations;  // its seed is the first decision's; that after n images has n more
  bool probable_combinations =
      true;  // scenes as often as they are believed in; else by psi (Algorithm 1)
  ParticleOptions
      particles;  // its penetration_m is the candidates', too: one measure of what excludes what
  NextViewOptions
      next_view;  // its sigma_px is the particles' too: one model of how far right poses lie
  ModeDetectionOptions detections;
  ExtrinsicsCheckOptions extrinsics_checks;
  int first_view = 0;  // whatever the strategy: of a fixed sequence give its first
  // The end, whichever comes first. Of all but the images a limit of 0 is none.
  int max_views = 5;  // images
  double min_entropy_nats =
      0.01;  // less: the modes are certain; and no new candidates in the last image
  // less expected of every view about the candidates, what its way costs taken off
  // (Strategy::Information): none is worth it
  double min_information_nats = 0;
  double min_gained_nats = 0;  // less from the last image, and no new candidates in it
  double max_seconds = 0;      // of computing; asked between images, so that one may go beyond it
  // Asked between stages, from the calling thread. The longest are the detection of all objects in
  // an image and a decision: seconds, on a software device up to a minute.
  std::function<bool()> cancelled;
  // More hits an image than a detection that has but one, since later images judge them again;
  // fewer of them aligned and registered: what an image misses, the next one shows, in half the
  // time (docs/next_view.md).
  static PipelineOptions scout_defaults();
  void validate() const;  // InputError naming the field and the violated bound
};

class Scout {
 public:
  // `camera` takes every image; `sets` and `backend` must outlive this. InputError: options out of
  // bounds, no or doubled or non-rigid views, no object.
  Scout(std::span<const TemplateSet> sets, const Camera& camera,
        std::vector<Se3> camera_from_world_views, const ScoutOptions& options, Backend& backend);

  // The next view and what is expected of each; nothing where an end is reached: state().end says
  // which. Asked again without news it answers the same.
  std::optional<ScoutDecision> propose();

  // The image from a view, taken where it was planned or where the camera truly was. It need not be
  // the proposed one. InputError: a view taken or given up before, what require_fitting refuses;
  // LogicError: no such view.
  void give(int view, const Image& image);
  void give(int view, const Image& image, const Se3& camera_from_world);
  // Whether `give` would take it. InputError: another size than the camera's, other pixels than its
  // size says, a pose that is not rigid.
  void require_fitting(const Image& image, const Se3& camera_from_world) const;
  // The view failed; it is never proposed again. InputError: a view taken or given up before;
  // LogicError: no such view.
  void unreachable(int view, const std::string& reason);

  const ScoutState& state() const { return state_; }
  // Goes on from a saved state, as if these steps had been made here. InputError naming `source`:
  // another camera, other views or objects than this scout's, images that require_fitting refuses.
  void resume(ScoutState state, const std::string& source);

 private:
  void require_open(int view) const;
  void forget_answer();
  ScoutEnd end_before_planning() const;
  bool may_find_more() const;
  bool certain() const;
  bool little_to_learn(const ScoutDecision& decision) const;
  bool little_learned() const;
  int first_open_view() const;
  ScoutDecision without_expectations(int view) const;
  ScoutDecision decide() const;
  void look(const Image& image, ScoutStep& step, std::vector<Observation>& observations) const;
  void search(std::span<const ObjectPose> known, ScoutStep& step, ScoutState& next,
              std::span<Observation> observations) const;
  std::vector<Mode> believe(ScoutStep& step, ScoutState& next,
                            std::span<const RegisterView> views) const;
  void conclude(ScoutStep& step, ScoutState& next, std::span<const Mode> modes,
                std::span<const RegisterView> views) const;
  void add_particles(ScoutStep& step, ScoutState& next) const;
  std::vector<Detection> detect(const ScoutStep& step, std::span<const ObjectPose> known,
                                std::span<Observation> observations) const;
  void hide_behind(std::span<const ObjectPose> known, std::span<Observation> observations) const;
  void done(Stopwatch& watch, const char* stage) const;
  void stop_where_cancelled() const;

  std::span<const TemplateSet> sets_;
  Camera camera_;
  ScoutOptions options_;
  Backend& backend_;
  std::vector<EdgeModel> models_;
  std::vector<TemplateTable> tables_;
  ScoutState state_;
  std::vector<Observation> observations_;  // of the images so far
  // What propose() answered, until there is news.
  std::optional<ScoutDecision> proposal_;
  bool has_ended_ = false;  // by a decision, which need not be made again
};

// Drives the loop to its end: views that cannot be acquired, or whose shot does not fit the camera,
// are marked and it goes on. `on_step` is called after every image or failure.
void run_scout(Scout& scout, ViewSource& source,
               const std::function<void(const ScoutState&)>& on_step = {});

}  // namespace edgescout
