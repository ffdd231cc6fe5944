// Checks the camera poses of a scene by geometry alone, before an image is searched: cameras must
// see places in common, and from places apart.
//
// extrinsics_check.h measures small errors, on objects that were found. This check is for poses so
// wrong that nothing can be found: inverted ones, lengths in another unit.
//
// Public header.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/core/types.h"
#include "host/model/template_set.h"

namespace edgescout {

struct PosedCamera {
  Camera camera;
  Se3 camera_from_world;
};

// What is wrong with the poses, as far as geometry tells.
struct CameraPoseProblem {
  bool nothing_shared = false;  // no two cameras see one place: no scene can be searched jointly
  std::string found;            // what the cameras see: "no place in common"
  std::string likely_cause;     // a change of all poses after which all see one place; empty: none
};

// Returns what is wrong with the cameras' poses. `searched`: distances from the cameras at which
// objects are searched; the check allows twice as much at both ends. Nothing for fewer than two
// cameras, and for all cameras that see one place in common and stand apart. A row of cameras of
// which only neighbours see a place in common is reported only if inverted poses, or lengths 1000
// times as large, make all see one place.
std::optional<CameraPoseProblem> camera_pose_problem(std::span<const PosedCamera> cameras,
                                                     const DistanceRange& searched);

// Returns the numbers of the cameras that see no place in common with another one.
std::vector<std::size_t> cameras_alone(std::span<const PosedCamera> cameras,
                                       const DistanceRange& searched);

// Checks that the cameras see a place in common. InputError naming `source` where nothing is
// shared; else logs a warning of any problem, and of single cameras that share nothing.
void check_camera_poses(std::span<const PosedCamera> cameras, const DistanceRange& searched,
                        const std::string& source);

}  // namespace edgescout
