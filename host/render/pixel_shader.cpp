#include "host/render/pixel_shader.h"

#include <algorithm>
#include <cmath>

#include "host/core/random.h"
#include "host/render/photographs.h"

namespace edgescout {
namespace {

// Of one sample. All rays of a mirror go the same way, and what reflects little has little noise.
int rays_of(const Material& material) {
  return material.roughness < 0.05 || material.reflectance < 0.15 ? 1 : 4;
}

double fraction(double x) { return x - std::floor(x); }

// Even over the unit square for the samples of a pixel, and different in each pixel: Roberts'
// sequence R2 from a random start. `u` stays below 1, since a few samples far out in the lobe would
// be single bright pixels.
LobeSample lobe_sample(int x, int y, int sample, int count) {
  Random start = Random(static_cast<std::uint64_t>(x)).split(static_cast<std::uint64_t>(y));
  const double u = fraction(start.uniform() + 0.7548776662466927 * sample),
               v = fraction(start.uniform() + 0.5698402909980532 * sample);
  return {std::min(u, 1 - 0.5 / count), v, count, (start.below(8) + sample) % 8};
}

}  // namespace

SceneShading::SceneShading(const SimulatedScene& scene, ThreadPool& pool)
    : triangles(scene), lighting(scene, triangles, pool), plane(scene) {
  if (scene.environment) reflections.emplace(scene, triangles, lighting);
}

double PixelShader::shade(int x, int y) {
  const int n = view_.scene.options.supersampling;
  received_.clear();
  lit_share_.reset();
  double sum = 0;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      sum += light_of(seen_at(view_, x * n + i, y * n + j), {x, y, j * n + i});
  return sum / (n * n);
}

double PixelShader::light_of(const SeenSurface& seen, const Pixel& pixel) {
  constexpr double HORIZON_LIGHT = 0.3;
  if (is_background(seen)) return light_of_background(seen, pixel);
  if (seen.triangle == HORIZON) return HORIZON_LIGHT;
  const Material& material = material_of(view_, seen);
  const double albedo =
      seen.triangle == PLANE ? shading_.plane.albedo(seen.point_m) : material.albedo;
  const ShadedPoint surface = shaded_point(view_, seen);
  const ReceivedLight direct = received(seen.triangle, surface, material);
  const double light = albedo * direct.diffuse + direct.specular;
  return material.reflectance > 0 ? light + reflected(surface, material, pixel) : light;
}

bool PixelShader::is_background(const SeenSurface& seen) const {
  if (scene_view_.background.pixels.empty() || seen.triangle >= 0) return false;
  return seen.triangle == HORIZON || !shading_.plane.is_board(seen.point_m);
}

// The photograph has its own light; only the shadows of the parts are added.
double PixelShader::light_of_background(const SeenSurface& seen, const Pixel& pixel) {
  const double shown = light_of_grey(scene_view_.background.at(pixel.x, pixel.y));
  if (seen.triangle == HORIZON) return shown;
  if (!lit_share_) lit_share_ = shading_.lighting.lit_share(seen.point_m, seen.normal);
  return shown * *lit_share_;
}

double PixelShader::reflected(const ShadedPoint& surface, const Material& material,
                              const Pixel& pixel) const {
  const int n = view_.scene.options.supersampling;
  const int rays = rays_of(material);
  double sum = 0;
  for (int i = 0; i < rays; ++i)
    sum += shading_.reflections->at(
        surface, material, lobe_sample(pixel.x, pixel.y, pixel.sample * rays + i, n * n * rays));
  return sum / rays;
}

ReceivedLight PixelShader::received(int triangle, const ShadedPoint& surface,
                                    const Material& material) {
  for (const auto& [known, light] : received_)
    if (known == triangle) return light;
  received_.emplace_back(triangle, shading_.lighting.at(surface, material));
  return received_.back().second;
}

}  // namespace edgescout
