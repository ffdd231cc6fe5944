// Puts parts on a table, one after the other, so that they do not overlap.
//
// There is no physics. A part rests on one of the faces of its convex hull. It is lowered
// vertically onto a height map of the parts on the table. If it lands on other parts, it slides and
// tilts by random trials towards lower potential energy.
#pragma once

#include <vector>

#include "host/core/random.h"
#include "host/core/types.h"

namespace edgescout {

// Returns a rotation in which the mesh does not roll on a plane with normal +z, with a random turn
// about z.
Eigen::Quaterniond random_rest(const Mesh& mesh, Random& random);

// Returns the centre of mass of the surface.
Eigen::Vector3d surface_centre(const Mesh& mesh);

class PileTable {
 public:
  // A square of side `side_m` about the origin. Its heights are sampled every `cell_m`, which is
  // the accuracy of contact.
  PileTable(double side_m, double cell_m);

  // Drops the mesh somewhere within `radius_m` of the origin. `alone`: it lies on the bare table
  // and touches nothing; if there is no room left, it lies outside the radius.
  Se3 place(const Mesh& mesh, double radius_m, bool alone, Random& random);

 private:
  struct Footprint;
  Footprint footprint(const Mesh& mesh, const Eigen::Quaterniond& rotation,
                      const Eigen::Vector2d& at) const;
  double rest_height(const Footprint& footprint) const;
  void occupy(const Footprint& footprint, double height_m);
  // Moves a part that landed on others towards lower potential energy.
  Se3 slide_downhill(const Mesh& mesh, Se3 pose, double radius_m, Random& random) const;

  int cells_ = 0;
  double cell_m_ = 0;
  std::vector<float> heights_m_;
};

}  // namespace edgescout
