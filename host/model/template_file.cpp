// The template file (io/binary_file.h).
#include <array>
#include <fstream>

#include "host/io/binary_file.h"
#include "host/io/mesh.h"
#include "host/model/template_set.h"

namespace edgescout {

namespace {

constexpr BinaryFormat format{{'E', 'S', 'C', 'O', 'U', 'T', 'T', 'S'}, 1, "template file"};

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

std::string payload_of(const TemplateSet& set) {
  BinaryWriter out;
  out.put(set.object_id);
  out.put_text(set.model.mesh.name);
  put_options(out, set.options);
  out.put(static_cast<std::uint64_t>(set.symmetries.discrete.size()));
  for (const Se3& s : set.symmetries.discrete) out.put_pose(s);
  std::vector<std::array<double, 3>> vertices;
  for (const Eigen::Vector3d& v : set.model.mesh.vertices_m)
    vertices.push_back({v.x(), v.y(), v.z()});
  out.put_list(vertices);
  out.put_list(set.model.mesh.triangles);
  out.put(static_cast<std::uint64_t>(set.views.size()));
  for (const TemplateView& view : set.views) {
    out.put_rotation(view.camera_from_object);
    out.put_list(view.points);
  }
  return std::move(out.bytes);
}

TemplateSet set_from(std::string_view payload, const std::string& source) {
  BinaryReader in(payload, source, format.name);
  TemplateSet set;
  set.object_id = in.get<int>();
  const std::string name = in.get_text();
  set.options = get_options(in);
  set.symmetries.discrete.clear();
  for (std::size_t i = in.count(7 * sizeof(double)); i > 0; --i)
    set.symmetries.discrete.push_back(in.get_pose());
  std::vector<Eigen::Vector3d> vertices;
  for (const auto& v : in.get_list<std::array<double, 3>>())
    vertices.emplace_back(v[0], v[1], v[2]);
  const Mesh mesh = restore_mesh(name, std::move(vertices), in.get_list<std::array<int, 3>>());
  set.model = make_edge_model(mesh, set.options.edges);
  for (std::size_t i = in.count(4 * sizeof(double)); i > 0; --i) {
    TemplateView view{in.get_rotation(), {}};
    view.points = in.get_list<ModelPoint>();
    set.views.push_back(std::move(view));
  }
  return set;
}

}  // namespace

void save_templates(const TemplateSet& set, const std::filesystem::path& file) {
  write_binary_file(file, format, payload_of(set));
}

TemplateSet load_templates(const std::filesystem::path& file) {
  return set_from(read_binary_file(file, format), file.string());
}

bool is_template_file(const std::filesystem::path& file) {
  std::array<char, 8> start{};
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  return start == format.magic;
}

}  // namespace edgescout
