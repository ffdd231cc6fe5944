#include "host/render/renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "host/core/random.h"
#include "host/render/lighting.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

constexpr int BOARD = -1, HORIZON = -2;

// What one sample of a pixel sees.
struct Hit {
  int triangle = HORIZON;  // or BOARD
  Eigen::Vector3d point_m, normal, to_viewer;
  double depth_m = std::numeric_limits<double>::infinity();
};

struct ViewContext {
  const SimulatedScene& scene;
  const WorldTriangles& triangles;
  const Lighting& lighting;
  Camera fine;  // of the supersampled image
  Se3 world_from_camera;
  Raster raster;  // of `fine`
};

Eigen::Vector3d interpolated_normal(const TriangleCorners& corners, const TriangleCorners& normals,
                                    const Eigen::Vector3d& point) {
  const Eigen::Vector3d a = corners[1] - corners[0], b = corners[2] - corners[0],
                        p = point - corners[0];
  const Eigen::Vector3d n = a.cross(b);
  const double area = n.squaredNorm();
  const double v = std::clamp(n.dot(p.cross(b)) / area, 0.0, 1.0),
               w = std::clamp(n.dot(a.cross(p)) / area, 0.0, 1.0 - v);
  return ((1 - v - w) * normals[0] + v * normals[1] + w * normals[2]).normalized();
}

Hit trace(const ViewContext& view, int x, int y) {
  const std::size_t i = static_cast<std::size_t>(y) * view.fine.width + x;
  const Eigen::Vector3d ray =
      view.world_from_camera.rotation * ray_through(view.fine, Eigen::Vector2d(x, y));
  const Eigen::Vector3d& eye = view.world_from_camera.translation_m;
  Hit hit;
  hit.triangle = view.raster.triangle[i];
  hit.to_viewer = -ray.normalized();
  if (hit.triangle >= 0) {
    hit.depth_m = view.raster.depth_m[i];
    hit.point_m = eye + hit.depth_m * ray;
    hit.normal = interpolated_normal(view.triangles.corners_m[hit.triangle],
                                     view.triangles.normals[hit.triangle], hit.point_m);
    if (hit.normal.dot(hit.to_viewer) < 0) hit.normal = -hit.normal;
  } else if (ray.z() < -1e-6) {
    hit.triangle = BOARD;
    hit.depth_m = -eye.z() / ray.z();
    hit.point_m = eye + hit.depth_m * ray;
    hit.normal = Eigen::Vector3d::UnitZ();
  } else {
    hit.triangle = HORIZON;
  }
  return hit;
}

// The print's rows go down, the board's y goes up. Without the flip, words would be mirrored.
double board_albedo(const SimulatedScene& scene, const Se3& board_from_world,
                    const Eigen::Vector3d& point_m) {
  const Eigen::Vector3d p = board_from_world * point_m;
  const double scale = scene.board.width / scene.board_side_m;
  const double u = p.x() * scale + 0.5 * (scene.board.width - 1),
               v = 0.5 * (scene.board.height - 1) - p.y() * scale;
  if (!(u >= 0 && v >= 0 && u < scene.board.width - 1 && v < scene.board.height - 1))
    return scene.desk_albedo;
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  const double fu = u - x, fv = v - y;
  const double top = (1 - fu) * scene.board.at(x, y) + fu * scene.board.at(x + 1, y);
  const double bottom = (1 - fu) * scene.board.at(x, y + 1) + fu * scene.board.at(x + 1, y + 1);
  return ((1 - fv) * top + fv * bottom) / 255;
}

// Computes the mean light of one pixel's samples; 1 is white. The light is computed once per
// surface and pixel. The print, which is finer, is read once per sample.
class PixelShader {
 public:
  explicit PixelShader(const ViewContext& view)
      : view_(view), board_from_world_(inverse(view.scene.world_from_board)) {}

  double shade(int pixel_x, int pixel_y) {
    const int n = view_.scene.options.supersampling;
    seen_.clear();
    double sum = 0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) sum += sample(trace(view_, pixel_x * n + i, pixel_y * n + j));
    return sum / (n * n);
  }

 private:
  double sample(const Hit& hit) {
    constexpr double HORIZON_LIGHT = 0.3;
    if (hit.triangle == HORIZON) return HORIZON_LIGHT;
    const Material& material =
        hit.triangle == BOARD ? board_
                              : view_.scene.placed[view_.triangles.placed[hit.triangle]].material;
    const ReceivedLight light = received(hit, material);
    const double albedo = hit.triangle == BOARD
                              ? board_albedo(view_.scene, board_from_world_, hit.point_m)
                              : material.albedo;
    return albedo * light.diffuse + light.specular;
  }

  ReceivedLight received(const Hit& hit, const Material& material) {
    for (const auto& [triangle, light] : seen_)
      if (triangle == hit.triangle) return light;
    seen_.emplace_back(hit.triangle,
                       view_.lighting.at(hit.point_m, hit.normal, hit.to_viewer, material));
    return seen_.back().second;
  }

  const ViewContext& view_;
  Se3 board_from_world_;
  Material board_{0, 0.015, 12};  // paper: nearly matt; its albedo is the print
  std::vector<std::pair<int, ReceivedLight>> seen_;
};

// Converts light to grey levels: lens blur, the display curve of cameras, sensor noise.
Image develop(cv::Mat light, const RenderOptions& options, const Random& random) {
  if (options.blur_px > 0)
    cv::GaussianBlur(light, light, {0, 0}, options.blur_px, options.blur_px, cv::BORDER_REPLICATE);
  Image image{light.cols, light.rows, {}};
  image.pixels.resize(light.total());
  for (int y = 0; y < light.rows; ++y) {
    Random noise = random.split(static_cast<std::uint64_t>(y));
    for (int x = 0; x < light.cols; ++x) {
      const double display = std::pow(std::clamp<double>(light.at<float>(y, x), 0.0, 1.0), 1 / 2.2);
      const double grey =
          255 * display + (options.noise_grey > 0 ? options.noise_grey * noise.normal() : 0.0);
      image.pixels[static_cast<std::size_t>(y) * light.cols + x] =
          static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0, 255.0)));
    }
  }
  return image;
}

// Counts the pixels of one object's silhouette, as if nothing hid it and the image had no border.
// An object close to the camera may be thousands of images wide; then only a fraction of the pixels
// is sampled.
double silhouette_px(const SimulatedScene& scene, const PlacedObject& part, const SceneView& view,
                     ThreadPool& pool) {
  const Mesh& mesh = scene.objects[part.object].mesh;
  std::vector<TriangleCorners> triangles;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9), high = -low;
  for (const auto& corners : mesh.triangles) {
    TriangleCorners t;
    for (int i = 0; i < 3; ++i) {
      t[i] = part.world_from_object * mesh.vertices_m[corners[i]];
      const Eigen::Vector3d x = view.camera_from_world * t[i];
      if (x.z() <= 0) return 0;
      low = low.cwiseMin(project(view.camera, x));
      high = high.cwiseMax(project(view.camera, x));
    }
    triangles.push_back(t);
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

void read_truth(const ViewContext& view, const SceneView& scene_view, Rendering& out,
                ThreadPool& pool) {
  const int n = view.scene.options.supersampling;
  const Camera& camera = scene_view.camera;
  std::vector<std::size_t> seen(view.scene.placed.size(), 0);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const Hit hit = trace(view, x * n + n / 2, y * n + n / 2);
      const int placed = hit.triangle >= 0 ? view.triangles.placed[hit.triangle] : -1;
      out.placed.push_back(placed);
      out.depth_m.push_back(static_cast<float>(hit.depth_m));
      if (placed >= 0) ++seen[placed];
    }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double whole_px = silhouette_px(view.scene, view.scene.placed[i], scene_view, pool);
    out.visible_fraction.push_back(whole_px == 0 ? 0.0 : static_cast<double>(seen[i]) / whole_px);
  }
}

}  // namespace

std::vector<Rendering> render(const SimulatedScene& scene, ThreadPool& pool) {
  const WorldTriangles triangles = world_triangles(scene);
  const Lighting lighting(scene, triangles, pool);
  std::vector<Rendering> renderings;
  for (std::size_t v = 0; v < scene.views.size(); ++v) {
    const SceneView& scene_view = scene.views[v];
    const Camera fine = scaled(scene_view.camera, scene.options.supersampling);
    const ViewContext view{
        scene,
        triangles,
        lighting,
        fine,
        inverse(scene_view.camera_from_world),
        rasterize(triangles.corners_m, fine, scene_view.camera_from_world, pool)};
    cv::Mat light(scene_view.camera.height, scene_view.camera.width, CV_32F);
    pool.for_each(light.rows, [&](std::size_t y) {
      PixelShader shader(view);
      for (int x = 0; x < light.cols; ++x)
        light.at<float>(static_cast<int>(y), x) =
            static_cast<float>(shader.shade(x, static_cast<int>(y)));
    });
    Rendering out;
    out.image = develop(light, scene.options, Random(scene.options.seed).split("noise").split(v));
    read_truth(view, scene_view, out, pool);
    renderings.push_back(std::move(out));
  }
  return renderings;
}

}  // namespace edgescout
