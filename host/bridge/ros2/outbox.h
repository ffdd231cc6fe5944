// Where the bridge's results go.
#pragma once

#include "host/bridge/ros2/messages.h"

namespace edgescout::ros2 {

class Outbox {
 public:
  virtual ~Outbox() = default;
  // Whether anyone listens: overlays and meshes are not made for nobody.
  virtual bool wants_markers() const = 0;
  virtual bool wants_overlay() const = 0;
  virtual void send(const msg::Detection3DArray& detections) = 0;
  virtual void send(const msg::MarkerArray& markers) = 0;
  virtual void send(const msg::Image& overlay) = 0;
  virtual void send(const msg::TFMessage& frames) = 0;
};

}  // namespace edgescout::ros2
