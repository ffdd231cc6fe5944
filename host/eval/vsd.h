// Visible surface discrepancy, the error of BOP that compares depth: which share of the surface
// that is visible in either pose lies elsewhere in the other one.
//
// Hodan et al., BOP: Benchmark for 6D object pose estimation, ECCV 2018, as BOP has measured it
// since 2019. Distances are along the pixels' rays. At a pixel of both poses that is visible in
// both, the cost is 1 if the distances differ by tau or more, else 0; at one that is visible in one
// pose alone it is 1. The error is the mean. A surface is visible where the measured one is not
// nearer by more than `delta_m`, and where nothing was measured; that of the estimate also where
// that of the truth is. Symmetries need no list: what looks the same has no error.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "host/core/depth_image.h"
#include "host/core/types.h"

namespace edgescout {

inline constexpr int VSD_TAUS = 10;  // 5, 10 .. 50 % of the diameter
using VsdErrors = std::array<double, VSD_TAUS>;
// Of an image, by object: [estimate][truth], the best scores first, of as many estimates as there
// are truths.
using VsdTables = std::map<int, std::vector<VsdErrors>>;

// What a camera would see of an object alone in the part of the image that can hold it.
struct DistanceWindow {
  int left = 0, top = 0, width = 0, height = 0;  // px; 0 x 0: out of the image
  std::vector<float> distances_m;                // infinity without a surface
  float at(int x, int y) const;                  // of the image's pixel; infinity outside
};

// The object's triangles as the raster takes them.
class VsdObject {
 public:
  explicit VsdObject(const Object& object);
  DistanceWindow seen_by(const Camera& camera, const Se3& camera_from_object) const;
  double diameter_m() const { return diameter_m_; }

 private:
  std::vector<Eigen::Vector3d> vertices_m_;
  std::vector<float> coordinates_m_;
  std::vector<std::uint32_t> triangles_;
  double diameter_m_;
};

// Distances along the rays in place of depths along the axis; missing ones stay DEPTH_MISSING.
// LogicError: depth and camera differ in size.
DepthImage distances_of(const DepthImage& depth, const Camera& camera);

// Errors of 1 where nothing of both is visible.
VsdErrors vsd(const DistanceWindow& estimate, const DistanceWindow& truth,
              const DepthImage& measured_distances, double diameter_m, double delta_m);

}  // namespace edgescout
