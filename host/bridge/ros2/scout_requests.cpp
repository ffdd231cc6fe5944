#include "host/bridge/ros2/scout_requests.h"

#include "host/bridge/ros2/frames.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

Scout& ScoutRequests::running() const {
  if (!scout_) throw InputError("scout", "run", "none", "a request scout_propose before");
  return *scout_;
}

void ScoutRequests::require_view(int view) const {
  if (view < 0 || std::size_t(view) >= views_.size())
    throw InputError("scout", "view", std::to_string(view),
                     "0 to " + std::to_string(views_.size() - 1));
}

msg::ScoutProposeResult ScoutRequests::propose(const msg::ScoutProposeRequest& request,
                                               const Camera& camera) {
  if (views_.empty() || world_frame_.empty())
    throw InputError("scout", views_.empty() ? "views" : "world_frame", "nothing",
                     "the options views and world_frame");
  if (!scout_ || request.restart)
    scout_ = std::make_unique<Scout>(search_.sets(camera, options_.cancelled), camera, views_,
                                     options_, search_.backend());
  msg::ScoutProposeResult result{.success = true};
  const std::optional<ScoutDecision> decision = scout_->propose();
  result.end = to_string(scout_->state().end);
  result.done = !decision;
  if (!decision) return result;
  result.view = decision->view;
  result.camera_pose.header.frame_id = world_frame_;
  result.camera_pose.pose = message_of(inverse(views_[std::size_t(decision->view)]));
  return result;
}

msg::ScoutGiveResult ScoutRequests::give(const msg::ScoutGiveRequest& request,
                                         const TakenImage& image, const Se3& camera_from_world) {
  Scout& scout = running();
  require_view(request.view);
  scout.give(request.view, Shot{image.image, camera_from_world, image.depth});
  return {true, ""};
}

msg::ScoutGiveResult ScoutRequests::fail(const msg::ScoutGiveRequest& request) {
  Scout& scout = running();
  require_view(request.view);
  scout.unreachable(request.view, shown(request.reason));
  return {true, ""};
}

msg::ScoutStateResult ScoutRequests::state() const {
  const ScoutState& state = running().state();
  std::vector<Detection> detections;
  for (const ModeDetection& mode : state.detections) detections.push_back(mode.detection);
  return {.success = true,
          .end = to_string(state.end),
          .images = std::int32_t(state.steps.size()),
          .entropy_nats = state.entropy_nats,
          .detections = detections_message({{}, world_frame_}, detections, search_.objects())};
}

}  // namespace edgescout::ros2
