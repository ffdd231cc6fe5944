#include "host/detect/world_prior.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/option_names.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr double FARTHEST_M = 1e6, LONGEST_SIDE_M = 20;

Eigen::Vector3d corner(const std::vector<double>& numbers, std::size_t first) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

// From the cameras to the box.
Range distances_to(const Eigen::AlignedBox3d& box, std::span<const Se3> box_from_camera) {
  Range range{INFINITY, 0};
  for (const Se3& pose : box_from_camera) {
    const Eigen::Vector3d& eye = pose.translation_m;
    const Eigen::Vector3d to_farthest = (eye - box.center()).cwiseAbs() + 0.5 * box.sizes();
    range.low = std::min(range.low, box.exteriorDistance(eye));
    range.high = std::max(range.high, to_farthest.norm());
  }
  return range;
}

// At which an object spans a twentieth of the image's smaller side to all of its larger one.
Range useful_distances(double diameter_m, const Camera& camera) {
  const double most_px = std::max(camera.width, camera.height),
               least_px = std::min(camera.width, camera.height) / 20.0;
  return {distance_at_size_m(diameter_m, most_px, camera),
          distance_at_size_m(diameter_m, least_px, camera)};
}

}  // namespace

void describe(WorldPrior& o, OptionVisitor& visit) {
  visit.group("Detection");
  visit.numbers({"world-box",
                 "Box that holds the objects' centres: two opposite corners x0 y0 z0 x1 y1 z1, m, "
                 "world frame. Poses outside are not searched. The images must have world poses",
                 OptionLevel::Basic},
                o.box_m, 6, -FARTHEST_M, FARTHEST_M);
  visit.numbers({"world-plane",
                 "Plane that supports the objects, nx ny nz d: the points x, m, world frame, with "
                 "n x = d and the unit normal n towards the objects. Poses that reach below are "
                 "not searched. The images must have world poses",
                 OptionLevel::Basic},
                o.plane, 4, -FARTHEST_M, FARTHEST_M);
  visit.number({"plane-tolerance", "How far objects may reach below --world-plane, m"},
               o.plane_tolerance_m, 0.0, 1.0);
}

Eigen::AlignedBox3d WorldPrior::box() const {
  const Eigen::Vector3d one = corner(box_m, 0), other = corner(box_m, 3);
  return {one.cwiseMin(other), one.cwiseMax(other)};
}

Eigen::Hyperplane<double, 3> WorldPrior::lowest_plane() const {
  return {corner(plane, 0).normalized(), plane_tolerance_m - plane[3]};
}

void WorldPrior::validate() const {
  check_bounds(*this, "detect");
  const BoundsCheck in("detect");
  if (!box_m.empty() && !(box().sizes().array() > 0).all()) {
    const Eigen::Vector3d sizes_m = box().sizes();
    in.fail("world-box",
            fmt::format("a box of {} x {} x {} m", sizes_m.x(), sizes_m.y(), sizes_m.z()),
            "two corners that differ in x, y and z");
  }
  if (!box_m.empty() && box().sizes().maxCoeff() > LONGEST_SIDE_M)
    in.fail("world-box", fmt::format("a side of {} m", box().sizes().maxCoeff()),
            fmt::format("sides of at most {} m: {} mm are {}", LONGEST_SIDE_M,
                        box().sizes().maxCoeff(), box().sizes().maxCoeff() / 1000));
  if (plane.empty()) return;
  const double length = corner(plane, 0).norm();
  if (std::abs(length - 1) > 0.01)
    in.fail("world-plane", fmt::format("a normal of length {}", length), "a unit normal, to 1 %");
}

TemplateOptions with_distances_to_box(TemplateOptions options, double diameter_m,
                                      const Camera& camera, const WorldPrior& prior,
                                      std::span<const Se3> camera_from_world) {
  if (options.distance_min_m > 0 || options.distance_max_m > 0 || prior.box_m.empty())
    return options;
  std::vector<Se3> box_from_camera;
  for (const Se3& pose : camera_from_world)
    box_from_camera.push_back(prior.prior_from_world * inverse(pose));
  const Range box = distances_to(prior.box(), box_from_camera),
              useful = useful_distances(diameter_m, camera);
  options.distance_min_m = std::max(box.low, useful.low);
  options.distance_max_m = std::min(box.high, useful.high);
  if (options.distance_min_m > options.distance_max_m)
    throw InputError(
        "options", "detect.world_box",
        fmt::format("one {:.3f} to {:.3f} m from the cameras", box.low, box.high),
        fmt::format(
            "one where an object of {:.1f} mm spans a twentieth to all of the image, {:.3f} "
            "to {:.3f} m away, or {} and {}, or another unit of the model ({})",
            1000 * diameter_m, useful.low, useful.high, option_name("distance-min"),
            option_name("distance-max"), option_name("unit")));
  return options;
}

}  // namespace edgescout
