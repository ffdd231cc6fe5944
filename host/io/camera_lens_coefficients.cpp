#include "host/io/camera_lens_coefficients.h"

#include <algorithm>
#include <map>

#include "host/core/camera.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

// In the order of OpenCV, or of Kannala-Brandt.
std::optional<std::size_t> place_of(const std::string& coefficient, bool is_fisheye) {
  static const std::map<std::string, std::size_t> opencv{
      {"k1", 0}, {"k2", 1}, {"p1", 2}, {"p2", 3},  {"k3", 4},  {"k4", 5},    {"k5", 6},
      {"k6", 7}, {"s1", 8}, {"s2", 9}, {"s3", 10}, {"s4", 11}, {"taux", 12}, {"tauy", 13},
      {"d0", 0}, {"d1", 1}, {"d2", 2}, {"d3", 3},  {"d4", 4},  {"kud", 0}};
  static const std::map<std::string, std::size_t> kannala_brandt{
      {"k1", 0}, {"k2", 1}, {"k3", 2}, {"k4", 3}, {"k5", 4},
      {"k6", 5}, {"d0", 0}, {"d1", 1}, {"d2", 2}, {"d3", 3}};
  const auto& order = is_fisheye ? kannala_brandt : opencv;
  const auto place = order.find(coefficient);
  return place == order.end() ? std::nullopt : std::optional(place->second);
}

struct SingleCoefficient {
  double value;
  JsonField field;
};
using SingleCoefficients = std::map<std::string, SingleCoefficient>;

SingleCoefficients take_single_coefficients(CameraFields& fields) {
  // Without d0 it is not sure where d1 stands.
  const bool has_d0 = fields.has({"d0"});
  SingleCoefficients found;
  for (const JsonField& field : fields.take_all([&](std::string_view name, const json&value) {
         const std::string coefficient = coefficient_name(name);
         return !coefficient.empty() && !value.is_structured() && (has_d0 || coefficient[0] != 'd');
       })) {
    const std::string name =
        coefficient_name(plain_name(field.path.substr(field.path.find_last_of("/.") + 1)));
    const double value = number_in_field(field);
    const auto [other, is_new] = found.emplace(name, SingleCoefficient{value, field});
    if (!is_new && other->second.value != value)
      field.fail(field.value.dump(),
                 other->second.field.value.dump() + " as in " + other->second.field.path);
  }
  return found;
}

// k1 k2 k3 k4 are those of a fisheye lens, with p1 and p2 those of a polynomial of four terms; in
// OpenCV's rational model k4 divides, with k5 and k6.
void require_known_order(const SingleCoefficients& found, bool is_named) {
  const auto k4 = found.find("k4");
  const auto has = [&](const char* name) { return found.contains(name); };
  const auto bends = [&](const char* name) { return has(name) && found.at(name).value != 0; };
  const bool is_rational = k4 != found.end() && has("k5") && has("k6");
  for (const char* name : {"k4", "k5", "k6"})
    if (bends(name) && !is_rational)
      found.at(name).field.fail(
          found.at(name).field.value.dump() + " without all of k4, k5 and k6",
          "the lens model fisheye in a field (distortion_model), or rational_polynomial with k4, "
          "k5 and k6");
  const bool may_be_fisheye =
      k4 != found.end() && !is_named && !has("p1") && !has("p2") && !has("k5") && !has("k6");
  if (may_be_fisheye && (bends("k1") || bends("k2") || bends("k3")))
    k4->second.field.fail("k1 to k4 without p1 and p2",
                          "a field that names the lens model: distortion_model: fisheye, plumb_bob "
                          "..");
}

// Single coefficients in the order of the model.
FoundCoefficients single_coefficients(CameraFields& fields, const FoundModel& model) {
  const bool is_fisheye = model.word == LensWord::Fisheye;
  // camodocal begins at k2, and names the focal lengths mu and mv.
  const std::size_t first = is_fisheye && fields.has({"mu"}) ? 1 : 0;
  fields.take({"kdu"});  // ViSP's inverse of kud
  const SingleCoefficients singles = take_single_coefficients(fields);
  if (!is_fisheye) require_known_order(singles, model.word != LensWord::Pinhole);
  FoundCoefficients found;
  for (const auto& [name, single] : singles) {
    const std::optional<std::size_t> place = place_of(name, is_fisheye);
    if (!place || *place < first) {
      if (single.value != 0)
        single.field.fail(single.field.value.dump(), "a coefficient of the lens model");
      continue;
    }
    found.values.resize(LensCoefficients{}.size());
    found.values[*place - first] = single.value;
    if (found.field.empty()) found.field = single.field.path;
  }
  return found;
}

// MATLAB's, also single lists of other programs.
FoundCoefficients radial_and_tangential(CameraFields& fields) {
  const std::optional<JsonField> radial =
      fields.take({"radialdistortion", "radial", "radialcoefficients", "radialcoeffs"});
  const std::optional<JsonField> tangential = fields.take(
      {"tangentialdistortion", "tangential", "tangentialcoefficients", "tangentialcoeffs"});
  if (!radial && !tangential) return {};
  const std::vector<double> k = radial ? numbers_in_field(*radial) : std::vector<double>{};
  const std::vector<double> p = tangential ? numbers_in_field(*tangential) : std::vector<double>{};
  if (k.size() > 3) radial->fail(std::to_string(k.size()) + " coefficients", "at most 3");
  if (p.size() > 2) tangential->fail(std::to_string(p.size()) + " coefficients", "2");
  FoundCoefficients found{std::vector<double>(5), radial ? radial->path : tangential->path};
  constexpr std::size_t radial_places[] = {0, 1, 4};
  for (std::size_t i = 0; i < k.size(); ++i) found.values[radial_places[i]] = k[i];
  for (std::size_t i = 0; i < p.size(); ++i) found.values[2 + i] = p[i];
  return found;
}

// openMVG's k1, k1 k2 k3, k1 k2 k3 p1 p2: where each stands in OpenCV's order.
FoundCoefficients radial_before_tangential(CameraFields& fields) {
  const std::pair<std::string_view, std::vector<std::size_t>> orders[] = {
      {"distok1", {0}}, {"distok3", {0, 1, 4}}, {"distot2", {0, 1, 4, 2, 3}}};
  for (const auto& [name, places] : orders) {
    const std::optional<JsonField> field = fields.take({name});
    if (!field) continue;
    const std::vector<double> k = numbers_in_field(*field);
    if (k.size() != places.size())
      field->fail(std::to_string(k.size()) + " coefficients", std::to_string(places.size()));
    FoundCoefficients found{std::vector<double>(5), field->path};
    for (std::size_t i = 0; i < k.size(); ++i) found.values[places[i]] = k[i];
    return found;
  }
  return {};
}

FoundCoefficients listed_coefficients(CameraFields& fields) {
  FoundCoefficients found = radial_before_tangential(fields);
  for (const JsonField& field : fields.take_all([](std::string_view name, const json&value) {
         return is_distortion_name(name) && is_list(value);
       })) {
    const std::vector<double> values = numbers_in_field(field);
    if (!found.values.empty() && !values.empty() && values != found.values)
      field.fail("other coefficients", "those of " + found.field);
    if (found.values.empty()) found = {values, field.path};
  }
  return found;
}

bool are_equal(std::vector<double> a, std::vector<double> b) {
  a.resize(std::max(a.size(), b.size()));
  b.resize(a.size());
  return a == b;
}

}  // namespace

FoundCoefficients read_lens_coefficients(CameraFields& fields, const FoundModel& model) {
  FoundCoefficients found = radial_and_tangential(fields);
  for (const FoundCoefficients& other :
       {listed_coefficients(fields), single_coefficients(fields, model)}) {
    if (other.field.empty()) continue;
    if (!found.field.empty() && !are_equal(other.values, found.values))
      throw InputError(fields.source(), other.field, "other coefficients",
                       "those of " + found.field);
    if (found.field.empty()) found = other;
  }
  return found;
}

}  // namespace edgescout
