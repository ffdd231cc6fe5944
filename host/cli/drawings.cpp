#include "host/cli/drawings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "host/active/views.h"
#include "host/cli/page_parts.h"
#include "host/model/visible_edges.h"
#include "host/render/raster.h"
#include "kernels/backend.h"

namespace edgescout {

namespace {

constexpr double PI = std::numbers::pi;

// The place of a view in the plot of the hemisphere.
struct Place {
  double x, y;
};
constexpr double PLOT_RADIUS = 150, PLOT_MIDDLE = 180;  // the radius is 90 degrees from the top

Place place_of(const Eigen::Vector3d& direction, const Eigen::Vector3d& above) {
  const Eigen::Vector3d d =
      Eigen::Quaterniond::FromTwoVectors(above, Eigen::Vector3d::UnitZ()) * direction;
  const double r = PLOT_RADIUS * std::acos(std::clamp(d.z(), -1.0, 1.0)) / (PI / 2),
               azimuth = std::atan2(d.y(), d.x());
  return {PLOT_MIDDLE + r * std::cos(azimuth), PLOT_MIDDLE - r * std::sin(azimuth)};
}

std::string rings_svg() {
  std::string svg;
  for (int ring : {30, 60, 90}) {
    const double r = PLOT_RADIUS * ring / 90;
    svg += fmt::format(
        "<circle class=ring cx={0} cy={0} r={1:.1f} /><text class=tick x={0} y={2:.1f}>{3}°</text>",
        PLOT_MIDDLE, r, PLOT_MIDDLE - r - 3, 90 - ring);
  }
  for (int spoke = 0; spoke < 4; ++spoke) {
    const double x = PLOT_RADIUS * std::cos(spoke * PI / 4),
                 y = PLOT_RADIUS * std::sin(spoke * PI / 4);
    svg += fmt::format("<path class=ring d='M{:.1f} {:.1f}L{:.1f} {:.1f}'/>", PLOT_MIDDLE - x,
                       PLOT_MIDDLE - y, PLOT_MIDDLE + x, PLOT_MIDDLE + y);
  }
  return svg;
}

// The path of the camera, image by image.
std::string path_svg(std::span<const DrawnView> views, const std::vector<Place>& places) {
  std::vector<std::pair<int, Place>> stops;
  for (std::size_t v = 0; v < views.size(); ++v)
    if (views[v].taken > 0) stops.emplace_back(views[v].taken, places[v]);
  std::ranges::sort(stops, {}, [](const auto& stop) { return stop.first; });
  std::string line;
  for (const auto& [number, place] : stops)
    line += fmt::format("{}{:.1f} {:.1f}", line.empty() ? 'M' : 'L', place.x, place.y);
  return "<path class=way d='" + line + "'/>";
}

std::string view_svg(const DrawnView& view, std::size_t number, const Place& p, double low,
                     double high, const std::string& unit) {
  const std::string title =
      fmt::format("<title>view {}{}</title>", number,
                  view.information ? fmt::format(": {:.4f} {}", *view.information, unit) : "");
  std::string svg;
  if (view.unreachable)
    return fmt::format("<g><path class=cross d='M{:.1f} {:.1f}l10 10m0 -10l-10 10'/>{}</g>",
                       p.x - 5, p.y - 5, title);
  if (view.chosen) svg += fmt::format("<circle class=chosen cx={:.1f} cy={:.1f} r=14 />", p.x, p.y);
  if (view.taken > 0)
    return svg +
           fmt::format(
               "<g><circle class=taken cx={0:.1f} cy={1:.1f} r=9 /><text class=number x={0:.1f} "
               "y={2:.1f}>{3}</text>{4}</g>",
               p.x, p.y, p.y + 4, view.taken, title);
  const std::string fill =
      view.information ? heat_colour(high > low ? (*view.information - low) / (high - low) : 0.5)
                       : "none";
  return svg + fmt::format("<circle class=view fill='{}' cx={:.1f} cy={:.1f} r=9>{}</circle>", fill,
                           p.x, p.y, title);
}

std::string colour_bar_svg(double low, double high, const std::string& unit) {
  std::string svg;
  constexpr int steps = 32;
  for (int i = 0; i < steps; ++i)
    svg += fmt::format("<rect x=372 y={:.1f} width=14 height=6.5 fill='{}'/>", 275.0 - 6 * i,
                       heat_colour(i / (steps - 1.0)));
  return svg + fmt::format(
                   "<text class=label x=391 y=285>{:.3f}</text><text class=label x=391 "
                   "y=97>{:.3f}</text><text class=label x=372 y=78>{}</text>",
                   low, high, unit);
}

// Depth of the nearest surface of all objects at every pixel.
std::vector<float> surface_of(std::span<const EdgeModel> models,
                              std::span<const DrawnObject> objects, const Camera& camera,
                              const Se3& camera_from_world, ThreadPool& pool) {
  Triangles triangles;
  for (const ObjectPose& object : objects)
    triangles.add(models[static_cast<std::size_t>(object.object)].mesh, object.world_from_object);
  return rasterize(triangles, camera, camera_from_world, pool).depth_m;
}

// Returns whether a point lies in the image and is visible in at least one of the 3 x 3 pixels
// around it: no surface is clearly in front of it there. On a contour one of these pixels shows the
// background.
bool shows(const Eigen::Vector2d& pixel, double z_m, double tolerance_m, const Camera& camera,
           const std::vector<float>& depth_m) {
  const int x = static_cast<int>(std::lround(pixel.x())),
            y = static_cast<int>(std::lround(pixel.y()));
  if (x < 1 || y < 1 || x >= camera.width - 1 || y >= camera.height - 1) return false;
  for (int i = 0; i < 9; ++i)
    if (depth_m[static_cast<std::size_t>(y + i / 3 - 1) * camera.width + x + i % 3 - 1] >=
        z_m - tolerance_m)
      return true;
  return false;
}

}  // namespace

std::string inline_png(const std::string& png) { return "data:image/png;base64," + base64(png); }

std::string heat_colour(double fraction) {
  // Viridis at nine points.
  constexpr double stops[9][3] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
                                  {44, 113, 142}, {33, 144, 141}, {39, 173, 129},
                                  {92, 200, 99},  {170, 220, 50}, {253, 231, 37}};
  const double at = 8 * std::clamp(fraction, 0.0, 1.0);
  const int i = std::min(7, static_cast<int>(at));
  std::array<int, 3> rgb;
  for (int k = 0; k < 3; ++k)
    rgb[k] =
        static_cast<int>(std::lround(stops[i][k] + (at - i) * (stops[i + 1][k] - stops[i][k])));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

std::array<std::uint8_t, 3> distinct_colour(int number) {
  // Hues at steps of the golden angle, with a lightness that is visible on white.
  const double hue = std::fmod(210 + 137.508 * number, 360) / 60;
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue, 6);
    return static_cast<std::uint8_t>(
        std::lround(255 * (0.82 - 0.74 * std::clamp(std::min(k, 4 - k), 0.0, 1.0))));
  };
  return {channel(5), channel(3), channel(1)};
}

std::string hemisphere_svg(std::span<const DrawnView> views, const std::string& unit) {
  std::vector<Se3> poses;
  double low = INFINITY, high = -INFINITY;
  for (const DrawnView& view : views) {
    poses.push_back(view.camera_from_world);
    if (!view.information) continue;
    low = std::min(low, *view.information);
    high = std::max(high, *view.information);
  }
  // If the views look at no common point, any point shows their order.
  const Eigen::Vector3d center_m =
      looked_at_m(poses).value_or(inverse(poses[0]) * Eigen::Vector3d::UnitZ());
  const std::vector<Eigen::Vector3d> directions = directions_to(poses, center_m);
  const Eigen::Vector3d above = direction_above(directions).value_or(Eigen::Vector3d::UnitZ());
  std::vector<Place> places;
  for (const Eigen::Vector3d& direction : directions) places.push_back(place_of(direction, above));
  std::string svg = "<svg class=hemisphere viewBox='0 0 440 360' role=img>" + rings_svg() +
                    path_svg(views, places);
  for (std::size_t v = 0; v < views.size(); ++v)
    svg += view_svg(views[v], v, places[v], low, high, unit);
  if (high >= low) svg += colour_bar_svg(low, high, unit);
  return svg + "</svg>";
}

std::string particles_svg(const std::string& image_id, const Camera& camera,
                          std::span<const DrawnParticle> particles,
                          std::span<const EdgeModel> models) {
  double heaviest = 0;
  for (const DrawnParticle& particle : particles) heaviest = std::max(heaviest, particle.weight);
  std::string svg = fmt::format("<svg class=picture viewBox='0 0 {} {}' role=img><use href='#{}'/>",
                                camera.width, camera.height, image_id);
  for (const DrawnParticle& particle : particles) {
    const EdgeModel& model = models[static_cast<std::size_t>(particle.object)];
    const Eigen::Vector3d center = particle.camera_from_object * model.center_m;
    if (center.z() <= 0) continue;
    const Eigen::Vector2d p = project(camera, center);
    const auto [r, g, b] = distinct_colour(particle.object);
    svg += fmt::format(
        "<g opacity={:.2f} stroke='#{:02x}{:02x}{:02x}'><circle cx={:.1f} cy={:.1f} r=2.5 />",
        0.15 + 0.75 * particle.weight / heaviest, r, g, b, p.x(), p.y());
    for (int axis : {0, 1}) {
      const Eigen::Vector3d end =
          particle.camera_from_object *
          (model.center_m + 0.2 * model.mesh.diameter_m * Eigen::Vector3d::Unit(axis));
      if (end.z() <= 0) continue;
      const Eigen::Vector2d q = project(camera, end);
      svg += fmt::format("<path d='M{:.1f} {:.1f}L{:.1f} {:.1f}'/>", p.x(), p.y(), q.x(), q.y());
    }
    svg += "</g>";
  }
  return svg + "</svg>";
}

RgbImage edge_map(std::span<const EdgeModel> models, std::span<const DrawnObject> objects,
                  const ObjectView& view, int width_px, Backend& backend) {
  const Camera small =
      scaled(view.camera, std::min(1.0, static_cast<double>(width_px) / view.camera.width));
  const std::vector<float> depth_m =
      surface_of(models, objects, small, view.camera_from_world, backend.threads());
  cv::Mat canvas(small.height, small.width, CV_8UC3, cv::Scalar(255, 255, 255));
  for (const DrawnObject& object : objects) {
    const EdgeModel& model = models[static_cast<std::size_t>(object.object)];
    const Se3 camera_from_object = view.camera_from_world * object.world_from_object;
    const auto [r, g, b] = distinct_colour(object.colour);
    const std::vector<ModelPoint> points =
        visible_edges(model, {&camera_from_object, 1}, backend)[0];
    for (const ModelPoint& point : points) {
      const Eigen::Vector3d x =
          camera_from_object * Eigen::Vector3d(point.x_m, point.y_m, point.z_m);
      const Eigen::Vector2d pixel = project(small, x);
      if (!shows(pixel, x.z(), 0.02 * model.mesh.diameter_m, small, depth_m)) continue;
      constexpr int bits = 4;
      cv::circle(canvas,
                 cv::Point(int(std::lround(16 * pixel.x())), int(std::lround(16 * pixel.y()))), 16,
                 cv::Scalar(r, g, b), cv::FILLED, cv::LINE_AA, bits);
    }
  }
  return {small.width, small.height, {canvas.data, canvas.data + canvas.total() * 3}};
}

}  // namespace edgescout
