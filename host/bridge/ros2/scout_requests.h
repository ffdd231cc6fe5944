// Answers the requests propose, give and state of an active detection: a camera on an arm looks
// from one view after the other.
#pragma once

#include <memory>
#include <string>

#include "host/active/scout.h"
#include "host/bridge/ros2/inbox.h"
#include "host/bridge/ros2/messages.h"
#include "host/bridge/ros2/object_search.h"

namespace edgescout::ros2 {

class ScoutRequests {
 public:
  // `views`: camera_from_world of the places that the arm can reach.
  ScoutRequests(ObjectSearch& search, ScoutOptions options, std::vector<Se3> views,
                std::string world_frame)
      : search_(search),
        options_(std::move(options)),
        views_(std::move(views)),
        world_frame_(std::move(world_frame)) {}

  // InputError: no views or no world frame among the options; what Scout refuses.
  msg::ScoutProposeResult propose(const msg::ScoutProposeRequest& request, const Camera& camera);
  // The image of a view, and where its camera stood. InputError: no run has begun; no such view;
  // what Scout refuses.
  msg::ScoutGiveResult give(const msg::ScoutGiveRequest& request, const TakenImage& image,
                            const Se3& camera_from_world);
  // The view failed: no image is needed.
  msg::ScoutGiveResult fail(const msg::ScoutGiveRequest& request);
  msg::ScoutStateResult state() const;

 private:
  Scout& running() const;
  void require_view(int view) const;

  ObjectSearch& search_;
  ScoutOptions options_;
  std::vector<Se3> views_;
  std::string world_frame_;
  std::unique_ptr<Scout> scout_;
};

}  // namespace edgescout::ros2
