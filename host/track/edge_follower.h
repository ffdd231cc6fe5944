// Finds the pose of an object in the next image, near where it is expected.
#pragma once

#include <optional>
#include <span>

#include "host/model/edge_model.h"
#include "host/track/normal_fit.h"
#include "host/track/normal_search.h"
#include "host/track/track_options.h"
#include "kernels/backend.h"

namespace edgescout {

struct Occluders;  // register/occluders.h

// An object in an earlier image: its edges there have the contrasts that the next image is expected
// to have.
struct SeenObject {
  SearchedImage image;
  Se3 camera_from_object;
};

// What can be seen of an object in a pose.
struct VisibleObject {
  std::vector<ModelPoint> edges;
  std::optional<SurfaceFit> surface;  // where depth was measured
  const SurfaceFit* measured() const { return surface ? &*surface : nullptr; }
};

struct FollowedPose {
  Se3 camera_from_object;
  NormalFit fit;
};

// Whether a pose lies on the object's edges, and measured depth does not contradict it.
bool is_on_object(const NormalFit& fit, const TrackOptions& options);
// By edges; a pose that measured depth contradicts is worse than any other.
bool is_better(const NormalFit& fit, const NormalFit& than);

class EdgeFollower {
 public:
  // `occluders` may be null.
  EdgeFollower(const EdgeModel& model, Backend& backend, const TrackOptions& options,
               const Occluders* occluders)
      : model_(model), backend_(backend), options_(options), occluders_(occluders) {}

  // The best of the poses found from the starts, which are tried in order until one is tracked.
  // Where none is, they are tried again from further away, in the image of half the size.
  // `earlier` may be null.
  FollowedPose follow(const SearchedImage& image, std::span<const Se3> starts,
                      const SeenObject* earlier) const;

  // How well a pose fits the edges of an image.
  NormalFit measure(const SearchedImage& image, const Se3& camera_from_object,
                    const SeenObject* earlier) const;

 private:
  FollowedPose follow_near(const SearchedImage& image, const Se3& start,
                           const SeenObject* earlier) const;
  Se3 follow_far(const SearchedImage& half, const Se3& start, const SeenObject* earlier) const;
  VisibleObject visible_at(const SearchedImage& image, const Se3& camera_from_object) const;
  NormalSearch search(const SearchedImage& image, const Se3& pose,
                      std::span<const ModelPoint> points, const SeenObject* earlier,
                      double reach_px) const;

  const EdgeModel& model_;
  Backend& backend_;
  const TrackOptions& options_;
  const Occluders* occluders_;
};

}  // namespace edgescout
