// Meshes and templates.
#include <iterator>
#include <sstream>

#include "host/bindings/c/src/contents.h"
#include "host/bindings/c/src/limits.h"
#include "host/bindings/c/src/poses.h"
#include "host/bindings/c/src/structs.h"
#include "host/core/time_limit.h"
#include "host/io/mesh.h"
#include "host/model/axis_symmetry.h"
#include "host/model/template_cache.h"

namespace edgescout::c {

namespace {

Mesh mesh_of(const edgescout_mesh_arrays& given) {
  require(given.vertices_m, "arrays.vertices_m");
  require(given.triangles, "arrays.triangles");
  require_count(given.vertex_count, "arrays.vertex_count");
  require_count(given.triangle_count, "arrays.triangle_count");
  std::vector<Eigen::Vector3d> vertices_m;
  for (std::size_t i = 0; i < given.vertex_count; ++i)
    vertices_m.emplace_back(given.vertices_m[3 * i], given.vertices_m[3 * i + 1],
                            given.vertices_m[3 * i + 2]);
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t i = 0; i < given.triangle_count; ++i)
    triangles.push_back(
        {given.triangles[3 * i], given.triangles[3 * i + 1], given.triangles[3 * i + 2]});
  return make_mesh(given.name ? given.name : "mesh", std::move(vertices_m), std::move(triangles));
}

edgescout_mesh_info shown_mesh(const Mesh& mesh) {
  edgescout_mesh_info info{};
  info.name = mesh.name.c_str();
  info.vertex_count = mesh.vertices_m.size();
  info.triangle_count = mesh.triangles.size();
  info.diameter_m = mesh.diameter_m;
  Eigen::Map<Eigen::Vector3d>(info.box_min_m) = mesh.box_min_m;
  Eigen::Map<Eigen::Vector3d>(info.box_max_m) = mesh.box_max_m;
  return info;
}

Symmetries symmetries_of(const edgescout_part& part, const Mesh& mesh) {
  if (part.symmetry && part.symmetry_poses)
    refuse(EDGESCOUT_BAD_INPUT, "part.symmetry", "words and poses", "one of them");
  if (part.symmetry) {
    std::istringstream text(part.symmetry);
    const std::vector<std::string> words{std::istream_iterator<std::string>(text), {}};
    return axis_symmetries(mesh, words);
  }
  if (part.symmetry_pose_count == 0) return {};
  return symmetries_of_transforms(
      poses_of(part.symmetry_poses, part.symmetry_pose_count, "part.symmetry_poses"));
}

TemplateOptions distances_set(TemplateOptions options, const edgescout_camera* given,
                              const Mesh& mesh) {
  if (given) {
    const auto camera = shared(given);
    if (camera->width < 1)
      refuse(EDGESCOUT_BAD_INPUT, "part.camera", "one without a size", "a size, for the distances");
    return with_default_distances(options, mesh.diameter_m, undistorted(*camera));
  }
  if (!(options.distance_min_m > 0 && options.distance_max_m > 0))
    refuse(EDGESCOUT_BAD_INPUT, "part.options: distance-min, distance-max", "0",
           "both, or a camera");
  return options;
}

PartTemplates with_models(std::vector<TemplateSet> sets) {
  std::vector<EdgeModel> models = models_of(sets);
  return {std::move(sets), std::move(models)};
}

PartTemplates templates_of(const edgescout_part& part) {
  const TimeLimit limit = limit_of(part.limit);
  const auto mesh = shared(part.mesh);
  const Object object{part.object_id, *mesh, symmetries_of(part, *mesh)};
  const TemplateOptions options =
      distances_set(options_of<TemplateOptions>(part.options), part.camera, *mesh);
  const auto backend = exclusive(part.backend);
  const auto progress = [&](int, int) {
    if (limit.is_over()) refuse(EDGESCOUT_CANCELLED, "templates", "the limit over", "more time");
  };
  std::vector<TemplateSet> sets;
  if (part.cache_folder) {
    TemplateCacheOptions cache{.program = "c"};
    if (part.cache_folder[0] != '\0') cache.folder = part.cache_folder;
    sets.push_back(TemplateCache(cache).get(object, options, *backend->backend, progress).set);
  } else {
    sets.push_back(build_templates(object, options, *backend->backend, progress));
  }
  return with_models(std::move(sets));
}

PartTemplates joined(const edgescout_templates* const* parts, std::size_t count) {
  require(parts, "parts");
  require_count(count, "part_count");
  PartTemplates all;
  for (std::size_t i = 0; i < count; ++i) {
    const auto part = shared(parts[i]);
    all.sets.insert(all.sets.end(), part->sets.begin(), part->sets.end());
    all.models.insert(all.models.end(), part->models.begin(), part->models.end());
  }
  if (all.sets.empty()) refuse(EDGESCOUT_BAD_INPUT, "part_count", "0", "at least 1");
  return all;
}

edgescout_templates_info shown_templates(const TemplateSet& set) {
  edgescout_templates_info info{};
  info.object_id = set.object_id;
  info.name = set.model.mesh.name.c_str();
  info.diameter_m = set.model.mesh.diameter_m;
  info.distance_min_m = set.options.distance_min_m;
  info.distance_max_m = set.options.distance_max_m;
  info.symmetry_count = set.symmetries.discrete.size();
  return info;
}

void copy_mesh(const Mesh& mesh, double* vertices_m, std::int32_t* triangles) {
  for (std::size_t i = 0; vertices_m && i < mesh.vertices_m.size(); ++i)
    Eigen::Map<Eigen::Vector3d>(vertices_m + 3 * i) = mesh.vertices_m[i];
  for (std::size_t i = 0; triangles && i < mesh.triangles.size(); ++i)
    std::ranges::copy(mesh.triangles[i], triangles + 3 * i);
}

}  // namespace

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_mesh_load(const char* file, const char* unit, edgescout_mesh** out) {
  return create(out, [&] {
    require(file, "file");
    if (!unit) return edgescout::load_mesh(file);
    return edgescout::load_mesh(file, edgescout::length_unit(unit));
  });
}

edgescout_status edgescout_mesh_create(const edgescout_mesh_arrays* arrays, edgescout_mesh** out) {
  return create(out, [&] { return mesh_of(read_struct(arrays, "arrays")); });
}

edgescout_status edgescout_mesh_get(const edgescout_mesh* mesh, edgescout_mesh_info* out) {
  return guarded([&] { write_struct(shown_mesh(*shared(mesh)), out, "out"); });
}

edgescout_status edgescout_mesh_copy(const edgescout_mesh* mesh, double* vertices_m,
                                     int32_t* triangles) {
  return guarded([&] { copy_mesh(*shared(mesh), vertices_m, triangles); });
}

edgescout_status edgescout_templates_build(const edgescout_part* part, edgescout_templates** out) {
  return create(out, [&] { return templates_of(read_struct(part, "part")); });
}

edgescout_status edgescout_templates_join(const edgescout_templates* const* parts,
                                          size_t part_count, edgescout_templates** out) {
  return create(out, [&] { return joined(parts, part_count); });
}

edgescout_status edgescout_templates_load(const char* file, edgescout_templates** out) {
  return create(out, [&] {
    require(file, "file");
    std::vector<edgescout::TemplateSet> sets;
    sets.push_back(edgescout::load_templates(file));
    return with_models(std::move(sets));
  });
}

edgescout_status edgescout_templates_save(const edgescout_templates* templates, const char* file) {
  return guarded([&] {
    const auto given = shared(templates);
    require(file, "file");
    if (given->sets.size() != 1)
      refuse(EDGESCOUT_BAD_INPUT, "templates", std::to_string(given->sets.size()) + " parts", "1");
    edgescout::save_templates(given->sets.front(), file);
  });
}

edgescout_status edgescout_templates_count(const edgescout_templates* templates, size_t* out) {
  return guarded([&] {
    require(out, "out");
    *out = shared(templates)->sets.size();
  });
}

edgescout_status edgescout_templates_at(const edgescout_templates* templates, size_t index,
                                        edgescout_templates_info* out) {
  return guarded([&] {
    const auto given = shared(templates);
    require_index(index, given->sets.size(), "index");
    write_struct(shown_templates(given->sets[index]), out, "out");
  });
}
