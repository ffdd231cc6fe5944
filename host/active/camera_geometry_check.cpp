#include "host/active/camera_geometry_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/core/grid.h"
#include "host/core/log.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Cameras nearer to each other than this fraction of the nearest searched distance see a scene from
// one place.
constexpr double LEAST_PARALLAX = 0.01;

DistanceRange with_slack(const DistanceRange& searched) {
  return {searched.min_m / 2, searched.max_m * 2};
}

// Whether a camera sees a place at a searched distance. A tenth of the image around it counts as
// well: objects reach over the border.
bool sees(const PosedCamera& posed, const Eigen::Vector3d& world_m, const DistanceRange& searched) {
  const Eigen::Vector3d x = posed.camera_from_world * world_m;
  const double distance_m = x.norm();
  if (x.z() <= 0 || distance_m < searched.min_m || distance_m > searched.max_m) return false;
  const Camera& camera = posed.camera;
  const Eigen::Vector2d pixel = project(camera, x);
  const double margin_x = 0.1 * camera.width, margin_y = 0.1 * camera.height;
  return pixel.x() > -margin_x && pixel.x() < camera.width + margin_x && pixel.y() > -margin_y &&
         pixel.y() < camera.height + margin_y;
}

// Places all over the view of a camera, world frame: a grid of 9 x 7 lines of sight, distances in
// steps of a quarter.
std::vector<Eigen::Vector3d> places_in_view(const PosedCamera& posed,
                                            const DistanceRange& searched) {
  const Camera& camera = posed.camera;
  const Se3 world_from_camera = inverse(posed.camera_from_world);
  std::vector<Eigen::Vector3d> places;
  for (int column = 0; column < 9; ++column)
    for (int row = 0; row < 7; ++row) {
      const Eigen::Vector2d pixel((column + 0.5) / 9 * camera.width,
                                  (row + 0.5) / 7 * camera.height);
      const Eigen::Vector3d ray = ray_through(camera, pixel).normalized();
      double distance_m = searched.min_m;
      while (distance_m <= searched.max_m) {
        places.push_back(world_from_camera * (distance_m * ray));
        distance_m *= 1.25;
      }
    }
  return places;
}

// Symmetric; whether two cameras see a place in common.
Grid<char> shared_sight(std::span<const PosedCamera> cameras, const DistanceRange& searched) {
  Grid<char> shared(cameras.size(), cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const std::vector<Eigen::Vector3d> places = places_in_view(cameras[i], searched);
    for (std::size_t j = 0; j < cameras.size(); ++j)
      if (i != j && std::ranges::any_of(places, [&](const Eigen::Vector3d& place) {
            return sees(cameras[j], place, searched);
          }))
        shared(i, j) = shared(j, i) = true;
  }
  return shared;
}

bool all_see_one_place(std::span<const PosedCamera> cameras, const DistanceRange& searched) {
  return std::ranges::any_of(
      places_in_view(cameras[0], searched), [&](const Eigen::Vector3d& place) {
        return std::ranges::all_of(
            cameras, [&](const PosedCamera& camera) { return sees(camera, place, searched); });
      });
}

double largest_baseline_m(std::span<const PosedCamera> cameras) {
  double largest = 0;
  for (const PosedCamera& a : cameras)
    for (const PosedCamera& b : cameras)
      largest = std::max(largest, (inverse(a.camera_from_world).translation_m -
                                   inverse(b.camera_from_world).translation_m)
                                      .norm());
  return largest;
}

// A mistake that may have been made with all poses, and what undoes it.
struct Mistake {
  std::string name;
  std::function<Se3(const Se3&)> undone;
};

Se3 with_lengths(const Se3& pose, double factor) {
  return {pose.rotation, factor * pose.translation_m};
}

constexpr const char* INVERTED = "poses that are inverted (camera to world, not world to camera)";

// Lengths times `factor` are right, of poses as they are and of inverted ones.
std::vector<Mistake> mistakes_of_lengths(const std::string& name, double factor) {
  return {{name, [factor](const Se3& pose) { return with_lengths(pose, factor); }},
          {INVERTED + (" and have " + name),
           [factor](const Se3& pose) { return inverse(with_lengths(pose, factor)); }}};
}

// Lengths that are too large are only likely where nothing at all is shared: a camera that is moved
// along a row of parts sees them all at once if its path is shortened.
std::vector<Mistake> likely_mistakes(bool nothing_shared) {
  std::vector<Mistake> mistakes{{INVERTED, [](const Se3& pose) { return inverse(pose); }}};
  std::ranges::move(mistakes_of_lengths("lengths in m where mm are expected", 1000),
                    std::back_inserter(mistakes));
  if (nothing_shared)
    std::ranges::move(mistakes_of_lengths("lengths in mm where m are expected", 1e-3),
                      std::back_inserter(mistakes));
  return mistakes;
}

bool stand_apart(std::span<const PosedCamera> cameras, const DistanceRange& searched) {
  return largest_baseline_m(cameras) >= LEAST_PARALLAX * searched.min_m;
}

// The name of the first mistake without which all cameras see one place, from places apart.
std::string cause_among(std::span<const Mistake> mistakes, std::span<const PosedCamera> cameras,
                        const DistanceRange& searched) {
  for (const Mistake& mistake : mistakes) {
    std::vector<PosedCamera> changed(cameras.begin(), cameras.end());
    for (PosedCamera& camera : changed)
      camera.camera_from_world = mistake.undone(camera.camera_from_world);
    if (stand_apart(changed, searched) && all_see_one_place(changed, with_slack(searched)))
      return mistake.name;
  }
  return "";
}

std::string text_of(const CameraPoseProblem& problem) {
  return problem.found + (problem.likely_cause.empty() ? "" : ", as with " + problem.likely_cause);
}

}  // namespace

std::optional<CameraPoseProblem> camera_pose_problem(std::span<const PosedCamera> cameras,
                                                     const DistanceRange& searched) {
  if (cameras.size() < 2) return {};
  const bool one_place = all_see_one_place(cameras, with_slack(searched));
  if (one_place && stand_apart(cameras, searched)) return {};
  if (one_place)
    return CameraPoseProblem{
        false,
        fmt::format("cameras at most {:.3f} mm from each other, which gives no depth",
                    1000 * largest_baseline_m(cameras)),
        cause_among(likely_mistakes(false), cameras, searched)};
  const bool nothing_shared = std::ranges::none_of(
      shared_sight(cameras, with_slack(searched)).values(), [](char shared) { return shared; });
  const std::string cause = cause_among(likely_mistakes(nothing_shared), cameras, searched);
  if (!nothing_shared && cause.empty()) return {};
  return CameraPoseProblem{
      nothing_shared,
      fmt::format("cameras that see {} {:.3f} to {:.3f} m away",
                  nothing_shared ? "nothing in common" : "no place all together", searched.min_m,
                  searched.max_m),
      cause};
}

std::vector<std::size_t> cameras_alone(std::span<const PosedCamera> cameras,
                                       const DistanceRange& searched) {
  const Grid<char> shared = shared_sight(cameras, with_slack(searched));
  std::vector<std::size_t> alone;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (std::ranges::none_of(shared.row(i), [](char one) { return one; })) alone.push_back(i);
  return alone;
}

void check_camera_poses(std::span<const PosedCamera> cameras, const DistanceRange& searched,
                        const std::string& source) {
  const std::optional<CameraPoseProblem> problem = camera_pose_problem(cameras, searched);
  if (problem && problem->nothing_shared)
    throw InputError(source, "camera poses", text_of(*problem), "views of one scene");
  if (problem)
    log(LogLevel::Warning,
        fmt::format("{}: camera poses: found {}, expected views of one scene from different places",
                    source, text_of(*problem)));
  if (const std::vector<std::size_t> alone = cameras_alone(cameras, searched);
      cameras.size() > 1 && !alone.empty())
    log(LogLevel::Warning,
        fmt::format("{}: camera poses: views {} (from 0) see nothing that another view sees",
                    source, fmt::join(alone, ", ")));
}

}  // namespace edgescout
