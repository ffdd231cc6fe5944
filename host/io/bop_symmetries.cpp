// Reads models_info.json and extends the symmetries listed there to the whole, sampled group.
#include <algorithm>
#include <numbers>

#include "host/core/symmetry_group.h"
#include "host/io/bop.h"
#include "host/io/json_fields.h"
#include "host/io/lower_case.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::size_t max_discrete =
    240;  // more than twice the largest finite rotation group of a solid

// Published symmetries are measured: the squares of LINEMOD's two half turns are 0.007 and 0.053
// rad, 0.15 and 0.06 mm off the identity.
constexpr double measured_angle_rad = 0.1;
constexpr double measured_share_of_diameter = 0.01;

// BOP lists every symmetry; other files may list generators. If the list generates no exact group,
// its members are treated as measured values. The resulting group is accepted if its members are
// clearly farther from each other than the measurement error (orders up to 31). Otherwise the list
// is taken as it is.
std::vector<Se3> group_of(std::span<const Se3> given, double diameter_m) {
  std::vector<Se3> group = generated_group(given, max_discrete);
  if (!group.empty()) return group;
  const MemberTolerance measured{measured_angle_rad, measured_share_of_diameter * diameter_m};
  group = generated_group(given, max_discrete, measured);
  if (!group.empty() && stand_apart(group, {2 * measured.angle_rad, 2 * measured.distance_m}))
    return group;
  return with_identity(given);
}

std::vector<Se3> read_discrete(const JsonField& object, ProjectedRotations& projected) {
  std::vector<Se3> given;
  if (!object.has("symmetries_discrete")) return {Se3{}};
  for (const JsonField& entry : object.at("symmetries_discrete").elements()) {
    const std::vector<double> m = entry.numbers(16);
    const Eigen::Matrix4d matrix =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(m.data());
    const std::optional<Se3> symmetry = nearest_rigid(
        matrix.topLeftCorner<3, 3>(), 1e-3 * matrix.topRightCorner<3, 1>(), projected);
    if (!symmetry)
      entry.fail("a matrix that is no rotation", "a rigid 4x4 transform by row, in mm");
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
      entry.fail("a last row other than 0 0 0 1 (a transposed matrix?)",
                 "a rigid 4x4 transform by row, in mm");
    given.push_back(*symmetry);
  }
  return group_of(given, object.has("diameter") ? 1e-3 * object.at("diameter").number() : 0);
}

// Rotations about every given axis in equal steps. Several axes (a ball) are sampled one by one, as
// BOP does.
std::vector<Se3> read_continuous(const JsonField& object, int steps) {
  std::vector<Se3> samples{Se3{}};
  if (!object.has("symmetries_continuous")) return samples;
  for (const JsonField& entry : object.at("symmetries_continuous").elements()) {
    for (const auto& [key, value] : entry.value.items())
      if (key != "axis" && key != "offset" && value.is_number())
        entry.at(key).fail(value.dump(), "axis and offset: the turn is any");
    const std::vector<double> a = entry.at("axis").numbers(3), o = entry.at("offset").numbers(3);
    const Eigen::Vector3d axis(a[0], a[1], a[2]),
        offset_m = 1e-3 * Eigen::Vector3d(o[0], o[1], o[2]);
    if (!(axis.norm() > 1e-9))
      entry.at("axis").fail("a vector of no length", "the direction of an axis");
    for (int i = 1; i < steps; ++i) {
      const Eigen::Quaterniond turn = so3_exp(2 * std::numbers::pi * i / steps * axis.normalized());
      add_unless_known(samples, {turn, offset_m - turn * offset_m});
    }
  }
  return samples;
}

// A symmetry under another name would be dropped without a word.
void require_known_symmetries(const JsonField& object) {
  if (!object.value.is_object()) object.fail(object.value.type_name(), "an object");
  for (const auto& [key, value] : object.value.items())
    if (lower_case(key).starts_with("sym") && key != "symmetries_discrete" &&
        key != "symmetries_continuous")
      object.at(key).fail("a field that is not known",
                          "symmetries_discrete or symmetries_continuous");
}

}  // namespace

std::map<int, Symmetries> load_symmetries(const std::filesystem::path& models_info,
                                          int continuous_steps) {
  check(continuous_steps >= 1, "load_symmetries: continuous_steps");
  const nlohmann::json content = read_json(models_info);
  const JsonField root{content, models_info.string(), ""};
  std::map<int, Symmetries> result;
  ProjectedRotations projected;
  for (const auto& [object_id, object] : numbered_fields(root)) {
    require_known_symmetries(object);
    const std::vector<Se3> continuous = read_continuous(object, continuous_steps);
    std::vector<Se3>& group = result[object_id].discrete;
    for (const Se3& discrete : read_discrete(object, projected))
      for (const Se3& turn : continuous) add_unless_known(group, turn * discrete);
  }
  warn_of_projected(projected, models_info.string());
  return result;
}

}  // namespace edgescout
