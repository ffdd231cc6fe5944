// Cubes in an image, as the tests of the evaluation use them.
#pragma once

#include <cmath>

#include "host/eval/recall.h"

namespace edgescout {

// Eight corners of a cube; diameter 100 mm.
inline Object cube(int id) {
  Object object;
  object.id = id;
  const double half = 0.05 / std::sqrt(3.0);
  for (int corner = 0; corner < 8; ++corner)
    object.mesh.vertices_m.emplace_back(corner & 1 ? half : -half, corner & 2 ? half : -half,
                                        corner & 4 ? half : -half);
  object.mesh.diameter_m = 0.1;
  return object;
}

// Far away with a long lens: MSPD is 10 px for each millimetre of a sideways shift, to 1 %.
inline EvaluationImage image() {
  EvaluationImage image;
  image.camera.width = 640;
  image.camera.height = 480;
  image.camera.fx = image.camera.fy = 1e5;
  return image;
}

inline Se3 at_mm(double x_mm) { return {Eigen::Quaterniond::Identity(), {1e-3 * x_mm, 0, 10}}; }

inline BopTruth truth(int object, double x_mm, double visible = 1) {
  return {object, at_mm(x_mm), visible};
}

inline BopResult estimate(int object, double x_mm, double score) {
  BopResult result;
  result.object_id = object;
  result.score = score;
  result.camera_from_object = at_mm(x_mm);
  return result;
}

inline const std::map<int, Object> CUBES{{1, cube(1)}, {2, cube(2)}};

}  // namespace edgescout
