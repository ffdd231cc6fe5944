// Renders the images of a scene, with ground truth at every pixel.
#pragma once

#include <vector>

#include "host/core/depth_image.h"
#include "host/render/scene.h"

namespace edgescout {

class ThreadPool;

struct Rendering {
  Image image;
  std::vector<int> placed;  // per pixel centre: index into SimulatedScene::placed, -1 on the board
  // per pixel centre: camera-frame z, board included; infinity above the horizon
  std::vector<float> depth_m;
  // per placed object: visible pixels / pixels of its whole silhouette, also outside the image
  std::vector<double> visible_fraction;
  DepthImage measured_depth;  // by RenderOptions::depth; empty where it is off
};

// Renders all views. The pixels depend only on the scene, not on the number of threads.
std::vector<Rendering> render(const SimulatedScene& scene, ThreadPool& pool);

}  // namespace edgescout
