// The template file: a header that can be checked before anything is believed, then plain little-endian numbers.
#include <array>
#include <cstring>

#include "host/io/files.h"
#include "host/io/mesh.h"
#include "host/model/template_set.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::array<char, 8> magic{'E', 'S', 'C', 'O', 'U', 'T', 'T', 'S'};
constexpr std::uint32_t version = 1;

// FNV-1a, 64 bit.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ull;
  return hash;
}

class Writer {
 public:
  template <typename T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <typename T>
  void put_list(const std::vector<T>& list) {
    put(static_cast<std::uint64_t>(list.size()));
    bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
  }
  std::string bytes;
};

class Reader {
 public:
  Reader(std::string_view bytes, std::string source) : bytes_(bytes), source_(std::move(source)) {}
  template <typename T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  template <typename T>
  std::vector<T> get_list() {
    const std::uint64_t count = get<std::uint64_t>();
    if (count > bytes_.size() / sizeof(T)) throw InputError(source_, "payload", "a list longer than the file", "a whole template file");
    std::vector<T> list(count);
    if (count > 0) std::memcpy(list.data(), take(count * sizeof(T)), count * sizeof(T));
    return list;
  }

 private:
  const char* take(std::size_t size) {
    if (size > bytes_.size()) throw InputError(source_, "payload", "fewer bytes than its lists need", "a whole template file");
    const char* at = bytes_.data();
    bytes_.remove_prefix(size);
    return at;
  }
  std::string_view bytes_;
  std::string source_;
};

void put_options(Writer& out, const TemplateOptions& o) {
  out.put(o.frequency);
  for (double v : {o.range.latitude_min_deg, o.range.latitude_max_deg, o.range.longitude_min_deg, o.range.longitude_max_deg}) out.put(v);
  out.put(o.in_plane_steps);
  for (double v : {o.distance_min_m, o.distance_max_m, o.distance_ratio, o.edges.crease_angle_deg, o.edges.raster_step_m}) out.put(v);
}

TemplateOptions get_options(Reader& in) {
  TemplateOptions o;
  o.frequency = in.get<int>();
  for (double* v : {&o.range.latitude_min_deg, &o.range.latitude_max_deg, &o.range.longitude_min_deg, &o.range.longitude_max_deg}) *v = in.get<double>();
  o.in_plane_steps = in.get<int>();
  for (double* v : {&o.distance_min_m, &o.distance_max_m, &o.distance_ratio, &o.edges.crease_angle_deg, &o.edges.raster_step_m}) *v = in.get<double>();
  o.validate();
  return o;
}

void put_rotation(Writer& out, const Eigen::Quaterniond& q) {
  for (double v : {q.w(), q.x(), q.y(), q.z()}) out.put(v);
}
Eigen::Quaterniond get_rotation(Reader& in) {
  const double w = in.get<double>(), x = in.get<double>(), y = in.get<double>(), z = in.get<double>();
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

std::string payload_of(const TemplateSet& set) {
  Writer out;
  out.put(set.object_id);
  out.put_list(std::vector<char>(set.model.mesh.name.begin(), set.model.mesh.name.end()));
  put_options(out, set.options);
  out.put(static_cast<std::uint64_t>(set.symmetries.discrete.size()));
  for (const Se3& s : set.symmetries.discrete) {
    put_rotation(out, s.rotation);
    for (int i = 0; i < 3; ++i) out.put(s.translation_m[i]);
  }
  std::vector<std::array<double, 3>> vertices;
  for (const Eigen::Vector3d& v : set.model.mesh.vertices_m) vertices.push_back({v.x(), v.y(), v.z()});
  out.put_list(vertices);
  out.put_list(set.model.mesh.triangles);
  out.put(static_cast<std::uint64_t>(set.views.size()));
  for (const TemplateView& view : set.views) {
    put_rotation(out, view.camera_from_object);
    out.put_list(view.points);
  }
  return std::move(out.bytes);
}

TemplateSet set_from(std::string_view payload, const std::string& source) {
  Reader in(payload, source);
  TemplateSet set;
  set.object_id = in.get<int>();
  const std::vector<char> name = in.get_list<char>();
  set.options = get_options(in);
  set.symmetries.discrete.clear();
  for (std::uint64_t i = in.get<std::uint64_t>(); i > 0; --i) {
    Se3 s{get_rotation(in), {}};
    for (int k = 0; k < 3; ++k) s.translation_m[k] = in.get<double>();
    set.symmetries.discrete.push_back(s);
  }
  std::vector<Eigen::Vector3d> vertices;
  for (const auto& v : in.get_list<std::array<double, 3>>()) vertices.emplace_back(v[0], v[1], v[2]);
  const Mesh mesh = make_mesh(std::string(name.begin(), name.end()), std::move(vertices), in.get_list<std::array<int, 3>>());
  set.model = make_edge_model(mesh, set.options.edges);
  for (std::uint64_t i = in.get<std::uint64_t>(); i > 0; --i) {
    TemplateView view{get_rotation(in), {}};
    view.points = in.get_list<ModelPoint>();
    set.views.push_back(std::move(view));
  }
  return set;
}

}  // namespace

void save_templates(const TemplateSet& set, const std::filesystem::path& file) {
  const std::string payload = payload_of(set);
  Writer out;
  out.put(magic);
  out.put(version);
  out.put(static_cast<std::uint64_t>(payload.size()));
  out.put(checksum(payload));
  write_file_atomically(file, out.bytes + payload);
}

TemplateSet load_templates(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  constexpr std::size_t header = magic.size() + sizeof(std::uint32_t) + 2 * sizeof(std::uint64_t);
  if (bytes.size() < magic.size() || std::memcmp(bytes.data(), magic.data(), magic.size()) != 0)
    throw InputError(file.string(), "magic", "another kind of file", "a template file");
  if (bytes.size() < header) throw InputError(file.string(), "header", std::to_string(bytes.size()) + " bytes", "a whole template file");
  Reader in(std::string_view(bytes).substr(magic.size()), file.string());
  if (const auto found = in.get<std::uint32_t>(); found != version)
    throw InputError(file.string(), "version", std::to_string(found), std::to_string(version));
  const auto size = in.get<std::uint64_t>();
  const auto expected = in.get<std::uint64_t>();
  const std::string_view payload = std::string_view(bytes).substr(header);
  if (payload.size() != size)
    throw InputError(file.string(), "length", std::to_string(payload.size()) + " bytes", std::to_string(size) + " bytes");
  if (checksum(payload) != expected) throw InputError(file.string(), "checksum", "another one", "the one in the header");
  return set_from(payload, file.string());
}

}  // namespace edgescout
