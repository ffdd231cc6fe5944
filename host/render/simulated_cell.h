// A simulated robot cell: a rendered scene as a source of images (active/source.h).
#pragma once

#include <cstdint>
#include <vector>

#include "host/active/source.h"
#include "host/render/scene.h"

namespace edgescout {

class ThreadPool;

// How far an arm misses the pose it is sent to. Standard deviations per axis.
struct ArmNoise {
  double translation_m = 0;  // of the camera's position
  double rotation_rad = 0;   // of its orientation
  // Whether the arm's encoders measure the error. Then a shot has the pose that was reached, else
  // the planned one.
  bool known = false;
  std::uint64_t seed = 1;
  void validate() const;  // InputError naming the field and the violated bound
};

// A shot has depth if the scene's options have a sensor (DepthSensor::on).
// The image of a view depends only on the scene, the view and the seed, not on earlier calls. Not
// safe for several threads at once.
class SimulatedCell : public ViewSource {
 public:
  // The scene's own views are not used. `pool` must outlive this object. InputError: noise out of
  // bounds; LogicError: a camera with distortion.
  SimulatedCell(SimulatedScene scene, const Camera& camera, std::vector<Se3> camera_from_world,
                const ArmNoise& noise, ThreadPool& pool);
  Camera camera() const override { return camera_; }
  std::vector<Se3> views() const override { return camera_from_world_; }
  Shot acquire(int view) override;  // LogicError: no such view

 private:
  SimulatedScene scene_;
  Camera camera_;
  std::vector<Se3> camera_from_world_;
  ArmNoise noise_;
  ThreadPool& pool_;
};

}  // namespace edgescout
