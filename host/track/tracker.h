// Follows the poses of objects from image to image.
//
// update() predicts each pose by its motion, searches the image's edges along the normals of the
// predicted ones (normal_search.h) and fits the pose to them (normal_fit.h). Only where that is
// doubtful, the pose is registered on the tensor of the object's surroundings
// (register_objects.h). Where depth was measured, the visible surface is fitted to it beside the
// edges (surface_fit.h), and what lies clearly nearer hides edges. search() looks for objects that
// are lost, by detection in the whole image. What it finds joins at the next update.
//
// The tracker starts no thread. search() may run in another thread, with a backend of its own,
// while update() goes on.
//
// Public header.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/core/time_limit.h"
#include "host/model/template_set.h"
#include "host/register/measured_depth.h"
#include "host/track/track_options.h"
#include "kernels/backend.h"

namespace edgescout {

enum class TrackState {
  Tracked,
  // Too few edges agree, or measured depth contradicts: the pose is the best one found, or the
  // predicted one.
  Doubtful,
  Lost,  // doubtful for too long, or out of the image: the pose is the last one
};
std::string to_string(TrackState state);  // "tracked", "doubtful", "lost"

// In the camera frame. `object` indexes the template sets.
struct Track : ObjectPose {
  int id = 0;  // of the instance, from 1; it keeps it when it is found again
  TrackState state = TrackState::Tracked;
  // Tangent of core/se3.h; of measurement and prediction together. It grows while the pose is
  // doubtful, and is infinite before the first measurement.
  Matrix6d covariance = Matrix6d::Zero();
  double above_chance = 0;  // share of the edges found, above what chance gives, [0, 1]
  int doubtful_frames = 0;  // in a row
};

// A grey image, when it was taken, s on any clock, and the depth that was measured with it. What
// depth lacks never counts against a pose.
struct TrackFrame {
  std::shared_ptr<const Image> image;
  double time_s = 0;
  // Of the camera without its lens (io/depth_registration.h: undistort_depth or register_depth);
  // null: nothing was measured.
  std::shared_ptr<const MeasuredDepth> depth = {};
};

class Tracker {
 public:
  // Begins without an instance. The sets, with or without templates (search() needs them), and the
  // backend outlive the tracker. With one object a CPU backend is faster than a device. InputError:
  // options out of bounds, a camera that is none.
  Tracker(std::span<const TemplateSet> sets, const Camera& camera, Backend& backend,
          const TrackOptions& options = {});
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  // Follows an object from a pose that is known to about 10 px in the next image; returns its id.
  // LogicError: no such object, a pose that is not finite.
  int add(int object, const Se3& camera_from_object);
  // Forgets an instance. LogicError: no such id.
  void remove(int id);

  // Follows and returns all instances in the new image, in the order of their ids. Objects hide
  // each other as far as their poses say. The limit ends the registration of doubtful poses, which
  // takes most of the time (docs/tracking.md): they then stay doubtful, with what the search along
  // the normals found. Edges and tensor of a registration that was begun are completed. InputError:
  // an image of another size than the camera's, or not later than the last one; depth of another
  // size. LogicError: while another thread is in a call other than search().
  const std::vector<Track>& update(const TrackFrame& frame, const TimeLimit& limit = {});

  // Looks for instances that are lost or not yet found, until the limit is over; returns how many
  // it found. LogicError: a set without templates; while another thread is in search().
  int search(const TrackFrame& frame, Backend& backend, const TimeLimit& limit = {});

  const std::vector<Track>& tracks() const;  // as of the last update

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace edgescout
