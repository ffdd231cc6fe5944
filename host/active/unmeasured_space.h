// Internal to host/active: the space that no depth image has measured. An object without a
// candidate may be there.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "host/detect/world_prior.h"
#include "host/register/occluders.h"

namespace edgescout {

// Where objects may be: a box, cut to a ball where there is one.
struct Workspace {
  Eigen::AlignedBox3d box_m;  // in a frame of its own
  Se3 world_from_box;
  std::optional<double> radius_m;  // of the ball about the box's middle
};
// The box of the prior. Without one the ball about the point that the views look at that all of
// them see whole; nothing where they look at none.
std::optional<Workspace> workspace_of(const WorldPrior& prior,
                                      std::span<const Se3> camera_from_world, const Camera& camera);

// Cells of the workspace, equal cubes.
struct UnmeasuredSpace {
  double cell_m = 0;                      // their side
  std::vector<Eigen::Vector3d> middle_m;  // of the cells that no depth image has measured, world
};

// Of some 32,000 cells. A depth image has measured a cell if it measured something at or behind it.
UnmeasuredSpace unmeasured_space(std::span<const ObjectView> views, const Workspace& workspace,
                                 ThreadPool& pool);

// The volume of the cells, m3, that a camera would see: in its image, and not behind the surfaces
// measured (measured_surface.h).
double volume_seen_m3(const UnmeasuredSpace& space, const Occluders& surfaces,
                      const Se3& camera_from_world);

}  // namespace edgescout
