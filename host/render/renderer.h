// Images of a scene, with the truth at every pixel.
#pragma once

#include <vector>

#include "host/render/scene.h"

namespace edgescout {

class ThreadPool;

struct Rendering {
  Image image;
  std::vector<int> placed;  // per pixel centre: index into Scene::placed, -1 on the board
  std::vector<float>
      depth_m;  // per pixel centre: camera-frame z, board included; infinity above the horizon
  // per placed object: its pixels seen / its whole silhouette, beyond the image too
  std::vector<double> visible_fraction;
};

// All views. The bytes depend on the scene alone, not on the number of threads.
std::vector<Rendering> render(const Scene& scene, ThreadPool& pool);

}  // namespace edgescout
