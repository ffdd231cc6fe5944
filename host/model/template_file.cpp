// The template file (io/binary_file.h).
#include <array>
#include <fstream>

#include "host/io/mesh.h"
#include "host/io/one_line.h"
#include "host/model/template_parts.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr BinaryFormat format{{'E', 'S', 'C', 'O', 'U', 'T', 'T', 'S'}, 1, "template file"};

std::string payload_of(const TemplateSet& set) {
  BinaryWriter out;
  out.put(set.object_id);
  out.put_text(set.model.mesh.name);
  put_options(out, set.options);
  put_symmetries(out, set.symmetries);
  put_mesh(out, set.model.mesh);
  put_views(out, set.views);
  return std::move(out.bytes);
}

TemplateSet set_from(BinaryReader in) {
  TemplateSet set;
  set.object_id = in.get<int>();
  const std::string name = in.get_text();
  set.options = get_options(in);
  set.symmetries = get_symmetries(in);
  set.model = make_edge_model(get_mesh(in, name), set.options.edges);
  set.views = get_views(in);
  return set;
}

}  // namespace

void put_options(BinaryWriter& out, const TemplateOptions& o) {
  out.put(o.frequency);
  for (double v : {o.range.latitude_min_deg, o.range.latitude_max_deg, o.range.longitude_min_deg,
                   o.range.longitude_max_deg})
    out.put(v);
  out.put(o.in_plane_steps);
  for (double v : {o.distance_min_m, o.distance_max_m, o.distance_ratio, o.edges.crease_angle_deg,
                   o.edges.raster_step_m})
    out.put(v);
}

TemplateOptions get_options(BinaryReader& in) {
  TemplateOptions o;
  o.frequency = in.get<int>();
  for (double* v : {&o.range.latitude_min_deg, &o.range.latitude_max_deg,
                    &o.range.longitude_min_deg, &o.range.longitude_max_deg})
    *v = in.get<double>();
  o.in_plane_steps = in.get<int>();
  for (double* v : {&o.distance_min_m, &o.distance_max_m, &o.distance_ratio,
                    &o.edges.crease_angle_deg, &o.edges.raster_step_m})
    *v = in.get<double>();
  o.validate();
  return o;
}

void put_symmetries(BinaryWriter& out, const Symmetries& symmetries) {
  out.put(static_cast<std::uint64_t>(symmetries.discrete.size()));
  for (const Se3& s : symmetries.discrete) out.put_pose(s);
}

Symmetries get_symmetries(BinaryReader& in) {
  Symmetries symmetries{{}};
  for (std::size_t i = in.count(7 * sizeof(double)); i > 0; --i)
    symmetries.discrete.push_back(in.get_pose());
  return symmetries;
}

void put_mesh(BinaryWriter& out, const Mesh& mesh) {
  std::vector<std::array<double, 3>> vertices;
  for (const Eigen::Vector3d& v : mesh.vertices_m) vertices.push_back({v.x(), v.y(), v.z()});
  out.put_list(vertices);
  out.put_list(mesh.triangles);
}

Mesh get_mesh(BinaryReader& in, const std::string& name) {
  std::vector<Eigen::Vector3d> vertices;
  for (const auto& v : in.get_list<std::array<double, 3>>())
    vertices.emplace_back(v[0], v[1], v[2]);
  return restore_mesh(name, std::move(vertices), in.get_list<std::array<int, 3>>());
}

void put_occluding(BinaryWriter& out, const OccludingSurface& occluding) {
  out.put_list(occluding.vertices_m);
  out.put_list(occluding.triangles);
}

OccludingSurface get_occluding(BinaryReader& in) {
  OccludingSurface occluding;
  occluding.vertices_m = in.get_list<float>();
  occluding.triangles = in.get_list<std::uint32_t>();
  return occluding;
}

void put_views(BinaryWriter& out, const std::vector<TemplateView>& views) {
  std::size_t points = 0;
  for (const TemplateView& view : views) points += view.points.size();
  out.bytes.reserve(out.bytes.size() + 64 * (views.size() + 1) + points * sizeof(ModelPoint));
  out.put(static_cast<std::uint64_t>(views.size()));
  for (const TemplateView& view : views) {
    out.put_rotation(view.camera_from_object);
    out.put_list(view.points);
  }
}

std::vector<TemplateView> get_views(BinaryReader& in) {
  std::vector<TemplateView> views;
  for (std::size_t i = in.count(4 * sizeof(double)); i > 0; --i) {
    TemplateView view{in.get_rotation(), {}};
    view.points = in.get_list<ModelPoint>();
    views.push_back(std::move(view));
  }
  return views;
}

void save_templates(const TemplateSet& set, const std::filesystem::path& file) {
  write_binary_file(file, format, payload_of(set));
}

// What is wrong with a value in it is said without the file, and with the mesh's name as it stands
// there.
TemplateSet load_templates(const std::filesystem::path& file) {
  try {
    return set_from(BinaryReader(file, format));
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.starts_with(file.string())) throw;
    throw InputError(file.string() + ": " + one_line(message));
  }
}

bool is_template_file(const std::filesystem::path& file) {
  std::array<char, 8> start{};
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  return start == format.magic;
}

}  // namespace edgescout
