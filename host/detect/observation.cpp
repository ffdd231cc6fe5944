#include "host/detect/observation.h"

#include <algorithm>
#include <cmath>

#include "host/edge/salient_edges.h"
#include "kernels/error.h"

namespace edgescout {

double reduction_for(double size_px) { return std::clamp(std::round(size_px / 48), 1.0, 8.0); }

Observation observe(const Image& image, const Camera& camera, const Se3& camera_from_world,
                    std::span<const EdgePoint> edges, double reduction, const TensorOptions& tensor,
                    Backend& backend) {
  check(is_finite(camera_from_world), "observe: a camera pose that is not finite");
  Observation o;
  o.reduction = reduction;
  o.coarse_camera = scaled(camera, 1 / reduction);
  o.view.camera = camera;
  o.view.camera_from_world = camera_from_world;
  o.view.image = std::make_shared<Image>(image);
  o.view.edges = std::make_shared<EdgeIndex>(edges, camera.width, camera.height);
  o.view.view = backend.make_view(edges, camera.width, camera.height,
                                  {image.width, image.height, image.pixels.data()},
                                  intrinsics_of(camera), tensor);
  TensorOptions coarse = tensor;
  coarse.lambda_px_per_rad = float(tensor.lambda_px_per_rad / reduction);
  const auto reduced_view = [&](std::vector<EdgePoint> points) {
    for (EdgePoint& edge : points) {
      edge.x_px = float((edge.x_px + 0.5) / reduction - 0.5);
      edge.y_px = float((edge.y_px + 0.5) / reduction - 0.5);
    }
    return backend.make_view(points, o.coarse_camera.width, o.coarse_camera.height, {},
                             intrinsics_of(o.coarse_camera), coarse);
  };
  o.view.coarse = reduced_view({edges.begin(), edges.end()});
  o.salient = reduced_view(salient_edges(edges, camera.width, camera.height));
  return o;
}

std::vector<RegisterView> views_of(std::span<const Observation> observations) {
  std::vector<RegisterView> views;
  for (const Observation& observation : observations) views.push_back(observation.view);
  return views;
}

}  // namespace edgescout
