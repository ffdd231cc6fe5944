// Where images come from: moves a camera to a view and takes an image there.
//
// The world is any fixed frame. A source offers numbered views and takes an image from one of them.
// It throws AcquisitionError for a view that it cannot reach or read. The loop (scout.h) then goes
// on without that view.
//
//   recorded_views.h          images from files
//   render/simulated_cell.h   a rendered scene
//
// Public header.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "host/core/types.h"
#include "host/register/measured_depth.h"

namespace edgescout {

// Timeout, unreadable image, pose not reached.
class AcquisitionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Shot {
  Image image;            // as the camera saw it, distorted
  Se3 camera_from_world;  // where the camera stood, as far as the source knows
  // Of undistorted(camera) (io/depth_registration.h); null: nothing was measured.
  std::shared_ptr<const MeasuredDepth> depth = nullptr;
};

class ViewSource {
 public:
  virtual ~ViewSource() = default;
  virtual Camera camera() const = 0;  // of every image
  // Returns camera_from_world of every place that the camera can be sent to.
  virtual std::vector<Se3> views() const = 0;
  virtual Shot acquire(int view) = 0;  // throws AcquisitionError
};

// A source that calls the user's function, in place of a class of the user's own.
class CallbackSource : public ViewSource {
 public:
  CallbackSource(const Camera& camera, std::vector<Se3> camera_from_world,
                 std::function<Shot(int)> acquire)
      : camera_(camera),
        camera_from_world_(std::move(camera_from_world)),
        acquire_(std::move(acquire)) {}
  Camera camera() const override { return camera_; }
  std::vector<Se3> views() const override { return camera_from_world_; }
  Shot acquire(int view) override { return acquire_(view); }

 private:
  Camera camera_;
  std::vector<Se3> camera_from_world_;
  std::function<Shot(int)> acquire_;
};

}  // namespace edgescout
