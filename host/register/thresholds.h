// Thresholds that several stages share, each with its reason.
//
// "Same pose" is a distance between corresponding corners of the bounding box, modulo symmetry
// (detect/distinct_poses.h), as a fraction of the object's diameter.
#pragma once

namespace edgescout::thresholds {

// Between the centres and the orientations of two poses of one object (register/pose_tolerance.h).
struct PoseTolerance {
  double of_diameter, angle_rad;
};
// Poses of one start after its search (register/refine.h). Tight: the search exists to keep poses
// apart that differ by little.
inline constexpr PoseTolerance SAME_AFTER_SEARCH{0.03, 0.06};
// Ends of registrations that have come to one optimum (register/refine.h: hop_probable). Optima lie
// 0.01 rad apart, and from one a hop leads on where from the other it does not.
inline constexpr PoseTolerance SAME_END{0.0015, 0.003};
// Candidates that several views bring for joint refinement: one registered pose from two views lies
// this near itself.
inline constexpr double SAME_ACROSS_VIEWS = 0.05;
// Candidates of one view: registration brings starts this near to one optimum.
inline constexpr double SAME_POSE = 0.1;
// Hits that are aligned in one image, as seen from the camera: the coarse stage brings starts this
// near to one optimum.
inline constexpr double SAME_START = 0.2;
// A hit this near to a known instance is aligned to that instance.
inline constexpr double NEAR_KNOWN = 0.2;

// Another pose of a detected object (detect/alternatives.h): its centre lies within the first
// fraction, one of its corners at least the second one from where the detection has it.
inline constexpr double ALTERNATIVE_CENTER = 0.25;
inline constexpr double ALTERNATIVE_APART = 0.2;
// A hit this near to a given pose, as seen from the camera, should be aligned to it
// (detect/given_pose.h). In rendered scenes half of such hits were aligned to the true pose, and
// nine of ten hits that were aligned to it were such.
inline constexpr double NEAR_GIVEN = 0.25;
// A doubtful pose of a track this near to the predicted one is believed (track/tracker.h).
inline constexpr double NEAR_PREDICTED = 0.15;

// How far beyond the searched distances a pose may lie, as a factor: registration corrects the
// distance of a template by less.
inline constexpr double DISTANCE_SLACK = 1.25;

// A pose with fewer visible points is not evaluated: fewer points fit the edges of any image
// somewhere. Twice the six unknowns of a pose.
inline constexpr int MIN_POINTS = 12;

// Fewer samples of a surface that depth has measured decide nothing, of some 300 that face a
// camera.
inline constexpr int MIN_DEPTH_SAMPLES = 20;

// A registration has converged where its last step moved the points by less than this across their
// edges, root mean square. In an image of two brackets the steps of poses at the brackets were
// below 0.004 px, those of most others 0.01 to 0.07 px.
inline constexpr double CONVERGED_PX = 0.01;

}  // namespace edgescout::thresholds
