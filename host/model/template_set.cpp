#include "host/model/template_set.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "host/core/option_names.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr double FARTHEST_M = 1000;

std::string metres(double length_m) {
  std::ostringstream text;
  text << length_m << " m";
  return text.str();
}

void describe_range(SphereRange& range, OptionVisitor& visit) {
  visit.number(
      {"latitude-min", "Lowest latitude of viewpoints over the object's x-y plane, degrees"},
      range.latitude_min_deg, -90.0, 90.0);
  visit.number(
      {"latitude-max", "Highest latitude of viewpoints over the object's x-y plane, degrees"},
      range.latitude_max_deg, -90.0, 90.0);
  visit.number(
      {"longitude-min", "First longitude of viewpoints about the object's z axis, degrees"},
      range.longitude_min_deg, -360.0, 360.0);
  visit.number({"longitude-max", "Last longitude of viewpoints about the object's z axis, degrees"},
               range.longitude_max_deg, -360.0, 720.0);
}

}  // namespace

void describe(TemplateOptions& o, OptionVisitor& visit) {
  visit.group("Templates");
  visit.number({"distance-min",
                "Smallest distance from the camera to an object's centre, m. 0, with "
                "--distance-max 0: where the object spans the image's larger side; scout takes it "
                "from the views",
                OptionLevel::Basic},
               o.distance_min_m, 0.0, FARTHEST_M);
  visit.number({"distance-max",
                "Largest distance from the camera to an object's centre, m. 0, with "
                "--distance-min 0: where the object spans a twentieth of the image's larger side; "
                "scout takes it from the views",
                OptionLevel::Basic},
               o.distance_max_m, 0.0, FARTHEST_M);
  visit.number({"distance-ratio", "Ratio of neighbouring distances that templates are made for"},
               o.distance_ratio, 1.001, 2.0);
  visit.number({"viewpoints",
                "Frequency f of the icosphere of viewpoints around an object, which has "
                "10 f^2 + 2 of them"},
               o.frequency, 1, 16);
  visit.number({"in-plane-steps", "Number of rotations of each template about the line of sight"},
               o.in_plane_steps, 1, 360);
  describe_range(o.range, visit);
  describe(o.edges, visit);
}

void TemplateOptions::validate() const {
  const auto fail = [](const std::string& field, double found, const std::string& bound) {
    throw InputError("options", field, std::to_string(found), bound);
  };
  edges.validate();
  check_bounds(*this, "templates");
  const std::string min = option_name("distance-min"), max = option_name("distance-max");
  if ((distance_min_m == 0) != (distance_max_m == 0))
    fail(distance_min_m == 0 ? min : max, 0, "both " + min + " and " + max + ", or neither");
  if (distance_max_m < distance_min_m) fail(max, distance_max_m, "at least " + min);
  if (range.latitude_min_deg > range.latitude_max_deg)
    fail(option_name("latitude-min"), range.latitude_min_deg,
         "at most " + option_name("latitude-max"));
}

TemplateOptions with_default_distances(TemplateOptions options, double diameter_m,
                                       const Camera& camera) {
  if (options.distance_min_m > 0) return options;
  options.distance_min_m =
      distance_at_size_m(diameter_m, std::max(camera.width, camera.height), camera);
  options.distance_max_m = 20 * options.distance_min_m;
  if (options.distance_max_m > FARTHEST_M)
    throw InputError("model", "diameter",
                     metres(diameter_m) + ", which spans a twentieth of the image at " +
                         metres(options.distance_max_m),
                     "one that does so within " + metres(FARTHEST_M) + ": another unit (" +
                         option_name("unit") + "), or " + option_name("distance-min") + " and " +
                         option_name("distance-max"));
  return options;
}

void require_distances_of_size(const std::string& name, double diameter_m,
                               const TemplateOptions& options) {
  constexpr double most_diameters = 1000;
  if (options.distance_min_m <= most_diameters * diameter_m) return;
  throw InputError(name, "distances",
                   metres(options.distance_min_m) + " and more of a part with a diameter of " +
                       metres(diameter_m),
                   "at most a thousand diameters: " + option_name("distance-min") + " and " +
                       option_name("distance-max") + " in metres, or another unit of the part (" +
                       option_name("unit") + ")");
}

std::vector<DistanceRange> distance_scales(const TemplateOptions& options) {
  check(options.distance_min_m > 0, "distance_scales: distances not set");
  constexpr double largest_ratio = 2.5;
  const double span = std::log(options.distance_max_m / options.distance_min_m);
  const int count = std::max(1, int(std::ceil(span / std::log(largest_ratio) - 1e-9)));
  if (count == 1) return {{options.distance_min_m, options.distance_max_m}};
  std::vector<DistanceRange> scales;
  for (int i = 0; i < count; ++i)
    scales.push_back({options.distance_min_m * std::exp(span * i / count),
                      options.distance_min_m * std::exp(span * (i + 1) / count)});
  return scales;
}

std::vector<double> template_distances_m(const TemplateOptions& options,
                                         const DistanceRange& scale) {
  const double span = std::log(scale.max_m / scale.min_m);
  const int steps =
      std::max(0, static_cast<int>(std::ceil(span / std::log(options.distance_ratio) - 1e-9)));
  std::vector<double> distances;
  for (int i = 0; i <= steps; ++i)
    distances.push_back(scale.min_m * std::exp(steps ? span * i / steps : 0));
  return distances;
}

std::vector<double> template_distances_m(const TemplateOptions& options) {
  std::vector<double> distances;
  for (const DistanceRange& scale : distance_scales(options))
    for (const double distance_m : template_distances_m(options, scale))
      distances.push_back(distance_m);
  return distances;
}

namespace {

// Where the camera stands for the visible points of all distances. Within one scale they hardly
// depend on it. Rays to the object's rim turn with the inverse of the distance, so over several
// scales the harmonic mean errs least: by less than the viewpoints' spacing.
double viewing_distance_m(const TemplateOptions& options) {
  const DistanceRange range{options.distance_min_m, options.distance_max_m};
  if (distance_scales(options).size() == 1) return range.middle_m();
  return 2 / (1 / range.min_m + 1 / range.max_m);
}

}  // namespace

TemplateSet without_views(const Object& object) {
  return {object.id, object.symmetries, {}, make_edge_model(object.mesh), {}};
}

TemplateSet build_templates(const Object& object, const TemplateOptions& options, Backend& backend,
                            const std::function<void(int, int)>& progress) {
  options.validate();
  require_distances_of_size(object.mesh.name, object.mesh.diameter_m, options);
  check(options.distance_min_m > 0, "build_templates: distances not set");
  TemplateSet set;
  set.object_id = object.id;
  set.symmetries = object.symmetries;
  set.options = options;
  set.model = make_edge_model(object.mesh, options.edges);
  const std::vector<Eigen::Vector3d> directions =
      viewpoints_in(options.range, object.symmetries, options.frequency);
  const double distance = std::max(viewing_distance_m(options), 1.2 * set.model.radius_m);
  constexpr std::size_t chunk = 32;
  for (std::size_t first = 0; first < directions.size(); first += chunk) {
    std::vector<Se3> poses;
    for (std::size_t i = first; i < std::min(directions.size(), first + chunk); ++i) {
      const Eigen::Quaterniond rotation = looking_from(directions[i]);
      poses.push_back({rotation, Eigen::Vector3d(0, 0, distance) - rotation * set.model.center_m});
    }
    std::vector<std::vector<ModelPoint>> points = visible_edges(set.model, poses, backend);
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (!points[i].empty()) set.views.push_back({poses[i].rotation, std::move(points[i])});
    if (progress) progress(int(std::min(directions.size(), first + chunk)), int(directions.size()));
  }
  if (set.views.empty())
    throw InputError(object.mesh.name, "templates", "no viewpoint that shows an edge",
                     "a wider range of viewpoints or a mesh with edges");
  return set;
}

}  // namespace edgescout
