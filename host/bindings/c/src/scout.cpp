#include "host/active/scout.h"

#include "host/bindings/c/src/depth.h"
#include "host/bindings/c/src/images.h"
#include "host/bindings/c/src/limits.h"
#include "host/bindings/c/src/poses.h"
#include "host/bindings/c/src/results.h"
#include "host/bindings/c/src/structs.h"

namespace edgescout::c {

// A scout with what it refers to.
class SteppedScout {
 public:
  explicit SteppedScout(const edgescout_scout_plan& plan)
      : templates_(live(plan.templates)), backend_(live(plan.backend)) {
    auto options = options_of<ScoutOptions>(plan.options);
    options.cancelled = [this] { return limit_ && limit_->is_over(); };
    if (plan.reachable)
      options.next_view.reachable = [reachable = plan.reachable, user = plan.user](int view) {
        return reachable(view, user) != 0;
      };
    std::vector<Se3> views =
        poses_of(plan.camera_from_world, plan.view_count, "plan.camera_from_world");
    camera_ = *shared(plan.camera);
    const Borrowed<edgescout_backend> on(backend_, Use::Exclusive);
    scout_ = std::make_unique<Scout>(templates_->value.sets, camera_, std::move(views), options,
                                     *on->backend);
  }

  std::optional<ScoutDecision> propose(const edgescout_limit* limit) {
    std::optional<ScoutDecision> decision;
    within(limit, [&](Scout& scout) { decision = scout.propose(); });
    if (decision) expected_ = decision->views;
    return decision;
  }

  void give(const edgescout_shot& shot) {
    require_view(shot.view);
    Shot given{image_of(shot.image), {}};
    const auto depth = take_depth({shot.depth, shot.depth_camera, shot.camera_from_depth}, "shot");
    given.camera_from_world = shot.camera_from_world
                                  ? pose_of(shot.camera_from_world, "shot.camera_from_world")
                                  : state().views[std::size_t(shot.view)];
    within(shot.limit, [&](Scout& scout) {
      given.depth = in_camera(depth, camera_, backend_->value.backend->threads());
      scout.give(shot.view, given);
    });
  }

  void unreachable(std::int32_t view, const char* reason) {
    require_view(view);
    scout_->unreachable(view, reason ? reason : "");
  }

  void resume(const char* file, const edgescout_limit* limit) {
    within(limit, [&](Scout& scout) { scout.resume(load_scout_state(file), file); });
  }

  edgescout_expectation expectation(std::int32_t view) const {
    require_view(view);
    edgescout_expectation shown{};
    if (expected_.empty()) return shown;
    const ViewInformation& expected = expected_[std::size_t(view)];
    shown.is_open = expected.open;
    shown.information = expected.information;
    shown.discovery = expected.discovery;
    shown.motion_cost = expected.motion_cost;
    shown.value = expected.open ? expected.value() : 0;
    return shown;
  }

  FoundObjects detections() const {
    FoundObjects result;
    for (const ModeDetection& mode : state().detections) {
      result.found.push_back(named(mode.detection, templates_->value.sets));
      result.found.back().supporting_images = mode.supporting_images;
    }
    return result;
  }

  const ScoutState& state() const { return scout_->state(); }

 private:
  void within(const edgescout_limit* given, const std::function<void(Scout&)>& work) {
    const TimeLimit limit = limit_of(given);
    const Borrowed<edgescout_backend> on(backend_, Use::Exclusive);
    limit_ = &limit;
    const auto reset = [this](const TimeLimit*) { limit_ = nullptr; };
    const std::unique_ptr<const TimeLimit, decltype(reset)> until_the_end(&limit, reset);
    work(*scout_);
  }

  void require_view(std::int32_t view) const {
    if (view < 0 || std::size_t(view) >= state().views.size())
      refuse(EDGESCOUT_BAD_INPUT, "view", std::to_string(view),
             "one of " + std::to_string(state().views.size()));
  }

  std::shared_ptr<Live<edgescout_templates>> templates_;
  std::shared_ptr<Live<edgescout_backend>> backend_;
  Camera camera_;                     // lens included
  const TimeLimit* limit_ = nullptr;  // of the call in progress
  std::unique_ptr<Scout> scout_;
  std::vector<ViewInformation> expected_;  // by the last proposal
};

namespace {

edgescout_proposal shown_proposal(const std::optional<ScoutDecision>& decision,
                                  const ScoutState& state) {
  edgescout_proposal shown{};
  shown.view = decision ? decision->view : -1;
  write_pose(decision ? state.views[std::size_t(decision->view)] : Se3{}, shown.camera_from_world);
  return shown;
}

edgescout_scout_state shown_state(const ScoutState& state) {
  edgescout_scout_state shown{};
  shown.end = std::int32_t(state.end);
  shown.image_count = state.steps.size();
  shown.failed_count = state.failed.size();
  shown.candidate_count = state.candidates.size();
  shown.particle_count = state.particles.size();
  shown.entropy_nats = state.entropy_nats;
  shown.seconds = state.seconds();
  return shown;
}

edgescout_scout_step shown_step(const ScoutStep& step) {
  edgescout_scout_step shown{};
  shown.view = step.decision.view;
  shown.searches = step.searches;
  write_pose(step.camera_from_world, shown.camera_from_world);
  shown.entropy_nats = step.entropy_nats;
  shown.new_candidates = step.new_candidates;
  shown.detection_count = step.detections.size();
  return shown;
}

}  // namespace

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_scout_create(const edgescout_scout_plan* plan, edgescout_scout** out) {
  return create(out, [&] { return std::make_shared<SteppedScout>(read_struct(plan, "plan")); });
}

edgescout_status edgescout_scout_propose(edgescout_scout* scout, const edgescout_limit* limit,
                                         edgescout_proposal* out) {
  return guarded([&] {
    const auto given = exclusive(scout);
    struct_size_of(out, "out");  // before the work
    const auto decision = (*given)->propose(limit);
    write_struct(shown_proposal(decision, (*given)->state()), out, "out");
  });
}

edgescout_status edgescout_scout_expectation(const edgescout_scout* scout, int32_t view,
                                             edgescout_expectation* out) {
  return guarded([&] { write_struct((*shared(scout))->expectation(view), out, "out"); });
}

edgescout_status edgescout_scout_give(edgescout_scout* scout, const edgescout_shot* shot) {
  return guarded([&] { (*exclusive(scout))->give(read_struct(shot, "shot")); });
}

edgescout_status edgescout_scout_unreachable(edgescout_scout* scout, int32_t view,
                                             const char* reason) {
  return guarded([&] { (*exclusive(scout))->unreachable(view, reason); });
}

edgescout_status edgescout_scout_get(const edgescout_scout* scout, edgescout_scout_state* out) {
  return guarded([&] { write_struct(shown_state((*shared(scout))->state()), out, "out"); });
}

edgescout_status edgescout_scout_step_at(const edgescout_scout* scout, size_t step,
                                         edgescout_scout_step* out) {
  return guarded([&] {
    const auto given = shared(scout);
    const auto& steps = (*given)->state().steps;
    require_index(step, steps.size(), "step");
    write_struct(shown_step(steps[step]), out, "out");
  });
}

edgescout_status edgescout_scout_detections(const edgescout_scout* scout,
                                            edgescout_detections** out) {
  return create(out, [&] { return (*shared(scout))->detections(); });
}

edgescout_status edgescout_scout_save(const edgescout_scout* scout, const char* file) {
  return guarded([&] {
    const auto given = shared(scout);
    require(file, "file");
    edgescout::save_scout_state((*given)->state(), file);
  });
}

edgescout_status edgescout_scout_resume(edgescout_scout* scout, const char* file,
                                        const edgescout_limit* limit) {
  return guarded([&] {
    const auto given = exclusive(scout);
    require(file, "file");
    (*given)->resume(file, limit);
  });
}
