#include "host/experiments/bin_types.h"

#include "host/experiments/bin.h"
#include "host/io/mesh.h"
#include "host/render/parts.h"

namespace edgescout {

namespace {

Mesh centred(const Mesh& mesh) {
  const Eigen::Vector3d middle_m = (mesh.box_min_m + mesh.box_max_m) / 2;
  std::vector<Eigen::Vector3d> vertices_m = mesh.vertices_m;
  for (Eigen::Vector3d& vertex_m : vertices_m) vertex_m -= middle_m;
  return make_mesh(mesh.name, std::move(vertices_m), mesh.triangles);
}

}  // namespace

const std::vector<Object>& bin_types() {
  static const std::vector<Object> parts{make_part("l_bracket"), make_part("bearing_block"),
                                         make_part("u_channel")};
  return parts;
}

std::vector<Object> cad_bin_types(const std::filesystem::path& data) {
  const std::filesystem::path cad = data / "cad";
  const Se3 half_turn_about_y{Eigen::Quaterniond(0, 0, 1, 0), Eigen::Vector3d::Zero()};
  return {{1, centred(load_mesh(cad / "AX-01_bearing_box.stl", LengthUnit::Millimetre)), {}},
          {2, centred(load_mesh(cad / "flange.stl", LengthUnit::Metre)), {}},
          {3,
           centred(load_mesh(cad / "t13.stl", LengthUnit::Millimetre)),
           {{Se3{}, half_turn_about_y}}}};
}

std::vector<TemplateSet> templates_between(std::span<const Object> types, double distance_min_m,
                                           double distance_max_m, Backend& backend) {
  TemplateOptions options;
  options.distance_min_m = distance_min_m;
  options.distance_max_m = distance_max_m;
  std::vector<TemplateSet> sets;
  for (const Object& type : types) sets.push_back(build_templates(type, options, backend));
  return sets;
}

std::vector<TemplateSet> bin_templates(std::span<const Object> types, Backend& backend) {
  const double radius_m = bin_views().radius_m;
  return templates_between(types, radius_m - BIN_DEPTH_MARGIN_M, radius_m + BIN_DEPTH_MARGIN_M,
                           backend);
}

}  // namespace edgescout
