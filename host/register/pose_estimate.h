// A registered pose with its covariance, cost and features.
//
// Public header.
#pragma once

#include <string>
#include <vector>

#include "host/core/types.h"
#include "kernels/edge_support.h"

namespace edgescout {

// Grey values inside a silhouette against a smooth function of the surface normal (shading.h).
struct Shading {
  double pixels = 0;       // number compared: inside the image, away from edges of the depth map
  double squares = 0;      // sum of squared deviations of their grey values from the mean
  double unexplained = 0;  // the same from the best function of the normal
};

// The object's visible surface against measured depth (register/depth_evidence.h), in numbers of
// its samples. All 0 where the view has no depth image.
struct DepthEvidence {
  double agreeing = 0;       // measured where the pose has its surface
  double contradicting = 0;  // measured clearly behind: the surface cannot be there
  double hidden = 0;         // measured clearly before: something hides it
  double missing = 0;        // not measured, or outside the image
  double offset_m = 0;  // sum over agreeing: measured minus the pose's, along the camera's axis
};

// What was measured of a pose in one view, or pooled over views (pose_features.h).
struct PoseFeatures {
  double psi = 0;        // Eq. 10, mean over the visible points
  double mean_px = 0;    // mean tensor value
  double matched = 0;    // fraction of points with a tensor value below the match limit
  double points = 0;     // number of visible points inside the image, not behind known objects
  double length_px = 0;  // of the visible edges inside the image
  double in_image = 0;   // points / visible
  double visible = 0;    // number of points inside the image or not, behind known objects or not
  Shading shading;       // zero where the view has no image
  EdgeSupport support;   // the same (edge_support.h)
  DepthEvidence depth;   // zero where the view has no depth
};

// What PoseClassifier finds in the features of a pose (pose_classifier.h: classify). Without
// features all is 0.
struct PoseClassification {
  PoseFeatures pooled;          // over all views
  double rank = 0;              // PoseClassifier::rank of all views
  double pooled_rank = 0;       // the same of the pooled features
  double pooled_log_odds = 0;   // PoseClassifier::log_odds of the pooled features
  double probability = 0;       // PoseClassifier::probability of all views
  double psi_z_score = 0;       // of the pooled features
  double unexplained_grey = 0;  // the same
  int informative_views = 0;    // is_informative
  bool has_psi_above_chance = false;
};

// Why the last stage of a registration stopped.
enum class Convergence {
  Converged,       // the last step was small
  NoDecrease,      // no step lowered the cost
  IterationLimit,  // the last step was not small
  TooFewEdges,     // edge ICP found too few near the visible points: the pose is as it was before
  NoPoints,        // no point was visible
  OutOfTime,       // the limit was over before (Scene::limit)
};
std::string to_string(Convergence convergence);

struct PoseEstimate : ObjectPose {
  // Tangent of core/se3.h. Inverse of the final J'WJ times the residual variance (points count as
  // independent); after edge_icp that of edge_covariance.h; infinite where singular.
  Matrix6d covariance = Matrix6d::Zero();
  double explained = 0;  // share that edges explain (edge_covariance.h); 0 without edge_icp
  double cost_px2 = 0;   // final sum of rho over all points and views (Eq. 11)
  double mean_px = 0;    // mean residual
  int points = 0;        // in all views
  int iterations = 0;    // of Levenberg-Marquardt
  // Of the last stage: by how much its last step moved the points across their edges, root mean
  // square.
  double last_step_px = 0;
  Convergence convergence = Convergence::NoPoints;
  std::vector<PoseFeatures> features;  // one per view; empty until measured (measure_features)
  PoseClassification classification;   // of the features, set with them
};

// Returns the poses alone: starts for what comes next. Takes a range of ObjectPose or of what
// derives from it.
template <typename Poses>
std::vector<ObjectPose> object_poses(const Poses& poses) {
  return std::vector<ObjectPose>(poses.begin(), poses.end());
}

}  // namespace edgescout
