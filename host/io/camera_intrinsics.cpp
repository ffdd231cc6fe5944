// Focal lengths, principal point and skew, in all the forms that files have.
#include <algorithm>
#include <cmath>

#include "host/io/camera_reader.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

struct Pinhole {
  std::optional<double> fx, fy, cx, cy, skew;
  std::string field;
};

constexpr const char* rows_of_matrix = "the rows fx 0 cx, 0 fy cy, 0 0 1";

// Open3D and MATLAB (IntrinsicMatrix) write the matrix by columns. Under other names that is a
// mistake of the program that wrote it.
Pinhole from_matrix(std::vector<double> k, const JsonField& field, bool may_be_transposed) {
  if (std::ranges::all_of(k, [](double x) { return x == 0; }))
    field.fail("only zeros", "the matrix of a calibrated camera: " + std::string(rows_of_matrix));
  const bool is_transposed = k[2] == 0 && k[5] == 0 && (k[6] != 0 || k[7] != 0);
  if (is_transposed && !may_be_transposed) field.fail("a transposed matrix", rows_of_matrix);
  if (is_transposed) {
    std::swap(k[1], k[3]);
    std::swap(k[2], k[6]);
    std::swap(k[5], k[7]);
  }
  if (k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1)
    field.fail("a matrix of another form", rows_of_matrix);
  // A pose at the origin, or what a program writes before it is calibrated.
  if (k[0] == 1 && k[4] == 1 && k[2] == 0 && k[5] == 0 && k[1] == 0)
    field.fail("the identity",
               "the matrix of a calibrated camera, in px: " + std::string(rows_of_matrix));
  return {k[0], k[4], k[2], k[5], k[1], field.path};
}

// The 3x3 matrix of a 3x4 or 4x4 matrix without a translation.
std::vector<double> without_last_column(const std::vector<double>& m, const JsonField& field) {
  std::vector<double> k;
  for (std::size_t i = 0; i < 12; ++i)
    if (i % 4 != 3)
      k.push_back(m[i]);
    else if (m[i] != 0)
      field.fail("a projection matrix with a translation", "the intrinsics alone");
  return k;
}

Pinhole from_list(const JsonField& field) {
  const std::vector<double> k = numbers_in_field(field);
  const std::string written = field.path.substr(field.path.rfind('/') + 1);
  const bool may_be_transposed = plain_name(written).find("intrinsic") != std::string::npos;
  if (k.size() == 9) return from_matrix(k, field, may_be_transposed);
  if (k.size() == 4) return {k[0], k[1], k[2], k[3], {}, field.path};
  if (k.size() == 12 || k.size() == 16)
    return from_matrix(without_last_column(k, field), field, false);
  field.fail(std::to_string(k.size()) + " numbers", "9 (a 3x3 matrix by row), or fx fy cx cy");
}

std::optional<double> number_if_any(CameraFields& fields,
                                    std::initializer_list<std::string_view> names,
                                    std::string& path) {
  const auto field = fields.take(names);
  if (!field) return {};
  if (path.empty()) path = field->path;
  return number_in_field(*field);
}

// A pair of numbers, or one for both.
void set_pair(const std::optional<JsonField>& field, std::optional<double>& x,
              std::optional<double>& y, bool one_is_both) {
  if (!field) return;
  const std::vector<double> pair = numbers_in_field(*field);
  if (pair.size() != 2 && !(one_is_both && pair.size() == 1))
    field->fail(std::to_string(pair.size()) + " numbers", "2");
  if (x || y) field->fail("the values twice", "them once");
  x = pair.front();
  y = pair.back();
}

// A focal length of one axis and the ratio of the two are no camera that all programs agree on.
void set_focal_lengths(CameraFields& fields, Pinhole& found) {
  const auto focal = fields.take({"focallength", "f", "focal", "focallengthpx", "fc"});
  set_pair(focal, found.fx, found.fy, true);
  if (!focal || numbers_in_field(*focal).size() == 2) return;
  const auto ratio = fields.take({"aspectratio", "aspect", "pixelaspectratio", "pixelaspect"});
  if (ratio && !is_trivial(ratio->value) && number_in_field(*ratio) != 1)
    ratio->fail(ratio->value.dump(), "1, or the focal lengths of both axes (fx, fy)");
}

Pinhole from_numbers(CameraFields& fields) {
  Pinhole found;
  std::string& path = found.field;
  if (fields.has({"u0"}) && fields.has({"v0"})) {  // ViSP's names
    found.fx = number_if_any(fields, {"px"}, path);
    found.fy = number_if_any(fields, {"py"}, path);
  }
  if (!found.fx)
    found.fx = number_if_any(fields, {"fx", "flx", "fu", "focalx", "focallengthx", "mu"}, path);
  if (!found.fy)
    found.fy = number_if_any(fields, {"fy", "fly", "fv", "focaly", "focallengthy", "mv"}, path);
  found.cx = number_if_any(
      fields, {"cx", "ppx", "cu", "u0", "x0", "principalx", "principalpointx", "centerx"}, path);
  found.cy = number_if_any(
      fields, {"cy", "ppy", "cv", "v0", "y0", "principaly", "principalpointy", "centery"}, path);
  found.skew = number_if_any(fields, {"skew"}, path);
  // In a lens's data sheet the focal length is in mm: where fx stands, it is not read.
  if (!found.fx && !found.fy) set_focal_lengths(fields, found);
  if (!found.cx && !found.cy)
    set_pair(fields.take({"principalpoint", "pp", "opticalcenter", "principalpointpx", "c", "cc"}),
             found.cx, found.cy, false);
  // Bouguet's toolbox: the tangent of the angle by which the axes are not square.
  if (const auto alpha = fields.take({"alphac"}); alpha && found.fx)
    found.skew = *found.fx * number_in_field(*alpha);
  return found;
}

void join_value(std::optional<double>& value, const std::optional<double>& other,
                const std::string& name, const JsonField& field) {
  if (value && other && std::abs(*value - *other) > 1e-3 * std::max(1.0, std::abs(*value)))
    field.fail(name + " " + std::to_string(*other),
               name + " " + std::to_string(*value) + " as in another field of the file");
  if (!value) value = other;
}

void join(Pinhole& pinhole, const Pinhole& other, const JsonField& field) {
  join_value(pinhole.fx, other.fx, "fx", field);
  join_value(pinhole.fy, other.fy, "fy", field);
  join_value(pinhole.cx, other.cx, "cx", field);
  join_value(pinhole.cy, other.cy, "cy", field);
  join_value(pinhole.skew, other.skew, "skew", field);
}

// OpenCV 1 wrote Intrinsics.xml and Distortion.xml.
[[noreturn]] void fail_without_matrix(const CameraFields& fields, const Camera& camera) {
  const bool has_lens = std::ranges::any_of(camera.distortion, [](double k) { return k != 0; });
  throw InputError(fields.source(), fields.at("camera_matrix"),
                   has_lens ? "the distortion alone" : "nothing",
                   std::string("a 3x3 matrix (camera_matrix, K, cam_K ..), or fx, fy, cx and cy") +
                       (has_lens ? ", in one file with the distortion" : ""));
}

}  // namespace

void read_intrinsics(CameraFields& fields, Camera& camera) {
  Pinhole found = from_numbers(fields);
  bool has_matrix = false;
  for (const JsonField& field : fields.take_all([](std::string_view name, const json&value) {
         return is_matrix_name(name) && is_list(value);
       })) {
    join(found, from_list(field), field);
    has_matrix = true;
  }
  if (!has_matrix && !found.fx && !found.fy && !found.cx && !found.cy)
    fail_without_matrix(fields, camera);
  for (const auto& [name, value] :
       {std::pair{"fx", found.fx}, {"fy", found.fy}, {"cx", found.cx}, {"cy", found.cy}})
    if (!value) throw InputError(fields.source(), fields.at(name), "nothing", "a number, px");
  camera.fx = *found.fx;
  camera.fy = *found.fy;
  camera.cx = *found.cx;
  camera.cy = *found.cy;
  camera.skew = found.skew.value_or(0);
}

}  // namespace edgescout
