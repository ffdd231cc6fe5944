#include "host/experiments/bin_types.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace edgescout::test {
namespace {

// Meshes of other authors, if present: centred on their boxes, and as symmetric as stated: a turned
// vertex is near another one, as far as the tessellation has one there.
TEST(CadBinTypes, AreCentredAndHaveTheirStatedSymmetry) {
  const char* data = std::getenv("EDGESCOUT_DATA");
  if (!data || !std::filesystem::exists(std::filesystem::path(data) / "cad"))
    GTEST_SKIP() << "EDGESCOUT_DATA names no folder with cad";
  const std::vector<Object> types = cad_bin_types(data);
  ASSERT_EQ(types.size(), 3u);
  for (const Object& type : types) {
    EXPECT_LT((type.mesh.box_min_m + type.mesh.box_max_m).norm(), 1e-9) << type.mesh.name;
    EXPECT_GT(type.mesh.diameter_m, 0.04) << type.mesh.name << ": the unit";
    EXPECT_LT(type.mesh.diameter_m, 0.15) << type.mesh.name << ": the unit";
    for (const Eigen::Vector3d axis :
         {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()}) {
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(std::acos(-1.0), axis));
      double worst_m = 0;
      for (const Eigen::Vector3d& vertex_m : type.mesh.vertices_m) {
        double nearest_m = 1;
        for (const Eigen::Vector3d& other_m : type.mesh.vertices_m)
          nearest_m = std::min(nearest_m, (turn * vertex_m - other_m).norm());
        worst_m = std::max(worst_m, nearest_m);
      }
      bool is_said = false;
      for (const Se3& symmetry : type.symmetries.discrete)
        is_said |= std::abs(symmetry.rotation.dot(turn)) > 0.999;
      EXPECT_EQ(worst_m < 0.004, is_said)
          << type.mesh.name << " about " << axis.transpose() << ": " << worst_m;
    }
  }
}

}  // namespace
}  // namespace edgescout::test
