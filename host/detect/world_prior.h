// What is known of where the objects are: a box that holds their centres, a plane that supports
// them. Poses outside are neither searched nor reported.
//
// It is given in the world frame, so the pose of every camera in the world must be known.
//
// Public header.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "host/core/options.h"
#include "host/model/template_set.h"

namespace edgescout {

// Empty lists: nothing is known. An object's centre is that of its bounding box
// (EdgeModel::center_m).
//
// A pose is rejected however little it lies outside, so the prior must leave room for the error of
// a pose. In a single image that is largest along the line of sight.
struct WorldPrior {
  // x0 y0 z0 x1 y1 z1, m: any two opposite corners of a box along the world's axes.
  std::vector<double> box_m;
  // nx ny nz d: the points x, m, with n x = d. n is a unit vector, to 1 %, that points from the
  // support towards the objects: no object reaches below the plane.
  std::vector<double> plane;
  double plane_tolerance_m = 0.005;  // how far objects may reach below
  // To the frame of box and plane, from the world of the camera poses. detect_objects, whose world
  // is the camera frame, sets it.
  Se3 prior_from_world;

  bool is_given() const { return !box_m.empty() || !plane.empty(); }
  Eigen::AlignedBox3d box() const;                    // box_m must be given
  Eigen::Hyperplane<double, 3> lowest_plane() const;  // below `plane` by the tolerance; given
  // Checks the prior. InputError naming the field and the violated bound: also a box without volume
  // and a normal that is no unit vector.
  void validate() const;
};

void describe(WorldPrior& prior, OptionVisitor& visit);

// Returns the options, with distances that were 0 set where the prior has a box: from the camera
// that is nearest to the box to the one that is farthest, as far as the object spans a twentieth of
// the image's smaller side to all of its larger one. InputError: it does so at none of these
// distances.
TemplateOptions with_distances_to_box(TemplateOptions options, double diameter_m,
                                      const Camera& camera, const WorldPrior& prior,
                                      std::span<const Se3> camera_from_world);

}  // namespace edgescout
