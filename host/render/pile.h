// Puts parts on a table, one after the other, without letting them run into each other.
//
// No physics: a part comes to rest on one of the faces of its convex hull, is let down vertically
// on a height map of what lies there, and where it lands on others it slides and tilts by random
// trial towards lower potential energy.
#pragma once

#include <vector>

#include "host/core/random.h"
#include "host/core/types.h"

namespace edgescout {

// A pose in which the mesh, set down on a plane with normal +z, does not roll; turned at random
// about z.
Eigen::Quaterniond random_rest(const Mesh& mesh, Random& random);

// Centre of mass of the surface.
Eigen::Vector3d surface_centre(const Mesh& mesh);

class PileTable {
 public:
  // A square of `side_m` about the origin, its heights sampled every `cell_m`: the accuracy of
  // contact.
  PileTable(double side_m, double cell_m);

  // Drops the mesh somewhere within `radius_m` of the origin. `alone`: on the bare table, apart
  // from everything else, outside the radius where there is no room left.
  Se3 place(const Mesh& mesh, double radius_m, bool alone, Random& random);

 private:
  struct Footprint;
  Footprint footprint(const Mesh& mesh, const Eigen::Quaterniond& rotation,
                      const Eigen::Vector2d& at) const;
  double rest_height(const Footprint& footprint) const;
  void occupy(const Footprint& footprint, double height_m);
  Se3 select_detections(const Mesh& mesh, Se3 pose, double radius_m, Random& random) const;

  int cells_ = 0;
  double cell_m_ = 0;
  std::vector<float> heights_m_;
};

}  // namespace edgescout
