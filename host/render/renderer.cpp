#include "host/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "host/render/camera_effects.h"
#include "host/render/measure_depth.h"
#include "host/render/pixel_shader.h"
#include "host/render/seen_surface.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

// Counts the pixels of one object's silhouette, as if nothing hid it and the image had no border.
// An object close to the camera may be thousands of images wide; then only a fraction of the pixels
// is sampled.
double silhouette_px(const SimulatedScene& scene, const PlacedObject& part, const SceneView& view,
                     ThreadPool& pool) {
  const Mesh& mesh = scene.objects[part.object].mesh;
  Triangles triangles;
  triangles.add(mesh, part.world_from_object);
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = -low;
  for (const Eigen::Vector3d& vertex_m : triangles.vertices_m) {
    const Eigen::Vector3d x = view.camera_from_world * vertex_m;
    if (x.z() <= 0) return 0;
    low = low.cwiseMin(project(view.camera, x));
    high = high.cwiseMax(project(view.camera, x));
  }
  constexpr double MOST_PX = 4096;
  const double spacing_px = std::max(1.0, (high - low).maxCoeff() / MOST_PX);
  Camera window = spacing_px > 1 ? scaled(view.camera, 1 / spacing_px) : view.camera;
  low /= spacing_px;
  high /= spacing_px;
  window.cx -= std::floor(low.x());
  window.cy -= std::floor(low.y());
  window.width = static_cast<int>(std::ceil(high.x()) - std::floor(low.x())) + 1;
  window.height = static_cast<int>(std::ceil(high.y()) - std::floor(low.y())) + 1;
  const Raster alone = rasterize(triangles, window, view.camera_from_world, pool);
  const auto samples =
      std::count_if(alone.triangle.begin(), alone.triangle.end(), [](int t) { return t >= 0; });
  return static_cast<double>(samples) * spacing_px * spacing_px;
}

void read_truth(const ViewRaster& view, const SceneView& scene_view, Rendering& out,
                ThreadPool& pool) {
  const int n = view.scene.options.supersampling;
  const Camera& camera = scene_view.camera;
  std::vector<std::size_t> seen(view.scene.placed.size(), 0);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const SeenSurface surface = seen_at(view, x * n + n / 2, y * n + n / 2);
      const int placed = surface.triangle >= 0 ? view.triangles.placed[surface.triangle] : -1;
      out.placed.push_back(placed);
      out.depth_m.push_back(static_cast<float>(surface.depth_m));
      if (placed >= 0) ++seen[placed];
    }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double whole_px = silhouette_px(view.scene, view.scene.placed[i], scene_view, pool);
    out.visible_fraction.push_back(whole_px == 0 ? 0.0 : static_cast<double>(seen[i]) / whole_px);
  }
}

}  // namespace

std::vector<Rendering> render(const SimulatedScene& scene, ThreadPool& pool) {
  const SceneShading shading(scene, pool);
  std::vector<Rendering> renderings;
  for (std::size_t v = 0; v < scene.views.size(); ++v) {
    const SceneView& scene_view = scene.views[v];
    const ViewRaster view = rasterize_view(scene, shading.triangles, scene_view, pool);
    cv::Mat light(scene_view.camera.height, scene_view.camera.width, CV_32F);
    pool.for_each(light.rows, [&](std::size_t y) {
      PixelShader shader(view, scene_view, shading);
      for (int x = 0; x < light.cols; ++x)
        light.at<float>(static_cast<int>(y), x) =
            static_cast<float>(shader.shade(x, static_cast<int>(y)));
    });
    Rendering out;
    out.image = develop(light, scene.options, scene_view.camera, v);
    read_truth(view, scene_view, out, pool);
    if (scene.options.depth.on)
      out.measured_depth = measure_depth(view, scene_view, shading, out.image, v, pool);
    renderings.push_back(std::move(out));
  }
  return renderings;
}

}  // namespace edgescout
