#include "host/io/camera_lens.h"

#include <algorithm>
#include <map>
#include <set>

#include "host/core/lens.h"
#include "host/core/log.h"
#include "host/core/words.h"
#include "host/io/one_line.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

constexpr const char* known_models =
    "pinhole, plumb_bob, radtan, rational_polynomial, thin_prism, equidistant, fisheye, "
    "kannala_brandt, fov, modified_brown_conrady or inverse_brown_conrady";

// What a word for a model says. Pinhole says how rays are projected, nothing of distortion.
enum class LensWord { Ideal, Pinhole, Brown, Modified, Fisheye, FieldOfView };

const std::map<std::string, LensWord, std::less<>> lens_words{
    {"none", LensWord::Ideal},
    {"nodistortion", LensWord::Ideal},
    {"undistorted", LensWord::Ideal},
    {"rectified", LensWord::Ideal},
    {"ideal", LensWord::Ideal},
    {"simplepinhole", LensWord::Ideal},
    {"perspectiveprojwithoutdistortion", LensWord::Ideal},
    {"pinhole", LensWord::Pinhole},
    {"pinholeplane", LensWord::Pinhole},
    {"rectilinear", LensWord::Pinhole},
    {"perspective", LensWord::Pinhole},
    {"linear", LensWord::Ideal},
    {"plumbbob", LensWord::Brown},
    {"radtan", LensWord::Brown},
    {"radialtangential", LensWord::Brown},
    {"pinholeradtan", LensWord::Brown},
    {"pinholeradialtangential", LensWord::Brown},
    {"rationalpolynomial", LensWord::Brown},
    {"rational", LensWord::Brown},
    {"pinholerational", LensWord::Brown},
    {"distortedpinhole", LensWord::Brown},  // Kalibr's classes
    {"equidistantpinhole", LensWord::Fisheye},
    {"fovpinhole", LensWord::FieldOfView},
    {"radtan8", LensWord::Brown},
    {"pinholeradtan8", LensWord::Brown},
    {"brownconrady", LensWord::Brown},
    {"brown", LensWord::Brown},
    {"polynomial", LensWord::Brown},
    {"standard", LensWord::Brown},
    {"opencv", LensWord::Brown},
    {"fullopencv", LensWord::Brown},
    {"pinholeopencv", LensWord::Brown},
    {"thinprism", LensWord::Brown},
    {"tilted", LensWord::Brown},
    {"pinholefull", LensWord::Brown},
    {"radial", LensWord::Brown},
    {"opencvpinhole", LensWord::Brown},
    {"perspectiveprojwithdistortion", LensWord::Brown},
    {"modifiedbrownconrady", LensWord::Modified},
    // librealsense computes with both alike: the coefficients distort.
    {"inversebrownconrady", LensWord::Modified},
    {"equidistant", LensWord::Fisheye},
    {"equi", LensWord::Fisheye},
    {"pinholeequi", LensWord::Fisheye},
    {"pinholeequidistant", LensWord::Fisheye},
    {"fisheye", LensWord::Fisheye},
    {"opencvfisheye", LensWord::Fisheye},
    {"cvfisheye", LensWord::Fisheye},  // cv::fisheye
    {"cv2fisheye", LensWord::Fisheye},
    {"pinholefisheye", LensWord::Fisheye},
    {"kannalabrandt", LensWord::Fisheye},
    {"kannalabrandt4", LensWord::Fisheye},
    {"kannalabrandt8", LensWord::Fisheye},
    {"kb", LensWord::Fisheye},
    {"kb4", LensWord::Fisheye},
    {"kb8", LensWord::Fisheye},
    {"fisheye624", LensWord::Fisheye},
    {"fov", LensWord::FieldOfView},
    {"fieldofview", LensWord::FieldOfView},
    {"pinholefov", LensWord::FieldOfView},
    {"atan", LensWord::FieldOfView},
    {"ftheta", LensWord::FieldOfView}};

// "distortion.inverse_brown_conrady", "RS2_DISTORTION_..", "CameraModelType.FISHEYE624".
std::string without_prefix(std::string word) {
  for (const std::string_view prefix :
       {"calibrationlensdistortionmodel", "k4acalibrationlensdistortionmodel", "rs2distortion",
        "cameramodeltype", "distortion"})
    if (word.starts_with(prefix) && word.size() > prefix.size()) return word.substr(prefix.size());
  return word;
}

std::optional<LensWord> word_in(const std::string& text) {
  const auto word = lens_words.find(without_prefix(plain_name(text)));
  return word == lens_words.end() ? std::nullopt : std::optional(word->second);
}

// Names under which other programs also keep the name of a product.
bool may_name_a_product(std::string_view name) {
  return is_any_of(name, {"model", "type", "cameratype", "camtype", "calibrationtype", "name"});
}

bool names_model(std::string_view name, const json& value) {
  if (value.is_structured() || is_list(value)) return false;
  if (contains_any_of(name,
                      {"distortionmodel", "distmodel", "distortiontype", "disttype", "lensmodel",
                       "lenstype", "cameramodel", "cammodel", "modeltype", "projectionmodel",
                       "projectiontype", "calibrationmodel", "calibmodel"}))
    return true;
  if (!may_name_a_product(name)) return is_any_of(name, {"projection", "distortion", "lens"});
  if (!value.is_string()) return false;
  const std::string text = plain_name(value.get<std::string>());
  return word_in(text).has_value() ||
         is_any_of(text, {"ds", "doublesphere", "eucm", "mei", "ucm"}) ||
         contains_any_of(
             text,
             {"fisheye",    "omni",          "distort",      "conrady",   "radial",   "polynomial",
              "scaramuzza", "ocam",          "unified",      "spherical", "division", "pinhole",
              "equirect",   "stereographic", "telecentric",  "orthogra",  "affine",   "cylindri",
              "panoram",    "catadioptric",  "hypercentric", "distortion"});
}

// RealSense numbers its models (rs2_distortion).
std::optional<LensWord> realsense_word(CameraFields& fields) {
  if (!fields.has({"ppx"})) return {};
  for (const JsonField& field : fields.take_all([](std::string_view name, const json&value) {
         return value.is_number() && is_any_of(name, {"model", "distortionmodel"});
       })) {
    constexpr LensWord words[] = {LensWord::Ideal,       LensWord::Modified, LensWord::Modified,
                                  LensWord::FieldOfView, LensWord::Brown,    LensWord::Fisheye};
    const int number = whole_number_in_field(field);
    if (number < 0 || number >= int(std::size(words)))
      field.fail(std::to_string(number), "a number of rs2_distortion, 0 to 5");
    return words[number];
  }
  return {};
}

// Luxonis numbers its models (dai::CameraModel).
std::optional<LensWord> luxonis_word(CameraFields& fields) {
  if (!fields.has({"spechfovdeg"})) return {};
  const auto type = fields.take({"cameratype"});
  if (!type || !type->value.is_number()) return {};
  const int number = whole_number_in_field(*type);
  if (number != 0 && number != 1)
    type->fail(std::to_string(number), "0 (perspective) or 1 (fisheye)");
  return number == 0 ? LensWord::Brown : LensWord::Fisheye;
}

struct FoundModel {
  LensWord word = LensWord::Pinhole;
  std::string field;  // that names it; empty: none does
};

// "fisheye_model: 1", "undistorted: true".
std::optional<FoundModel> model_of_switch(CameraFields& fields) {
  std::optional<FoundModel> model;
  for (const JsonField& field : fields.take_all([](std::string_view name, const json&value) {
         return !value.is_structured() &&
                is_any_of(name, {"fisheyemodel", "fisheye", "isfisheye", "usefisheye"});
       }))
    if (!is_trivial(field.value)) model = {LensWord::Fisheye, field.path};
  for (const JsonField& field : fields.take_all([](std::string_view name, const json&value) {
         return !value.is_structured() &&
                is_any_of(name, {"undistorted", "isundistorted", "rectified", "isrectified"});
       }))
    if (!is_trivial(field.value)) model = {LensWord::Ideal, field.path};
  return model;
}

void join(FoundModel& model, LensWord word, const JsonField& field) {
  if (word == LensWord::Pinhole && !model.field.empty()) return;
  if (model.word != LensWord::Pinhole && model.word != word)
    field.fail(text_in_field(field), "the same lens model as " + model.field);
  model = {word, field.path};
}

// "k1", "k_1", "radial_k1" -> "k1". Empty: no coefficient.
std::string coefficient_name(std::string_view name) {
  // What the SDK of Azure Kinect prints.
  if (name == "tangentialdistortioncoefficientx") return "p1";
  if (name == "tangentialdistortioncoefficienty") return "p2";
  for (const std::string_view prefix :
       {"camera", "cam", "distortion", "dist", "radial", "tangential", "prism", "lens"})
    if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  static const std::set<std::string, std::less<>> names{
      "k1", "k2",  "k3",  "k4",   "k5",   "k6", "p1", "p2", "s1", "s2", "s3",
      "s4", "sx1", "sy1", "taux", "tauy", "d0", "d1", "d2", "d3", "d4", "kud"};
  return names.contains(name) ? std::string(name) : "";
}

// What the name of an object says of the lens within it: "fisheye_params", "left_equidistant".
std::optional<LensWord> word_of_object(const std::string& written, const JsonField& field) {
  const std::string name = plain_name(written);
  if (contains_any_of(name, {"nonfisheye", "notfisheye", "defish"})) return {};
  const bool is_fisheye = contains_any_of(name, {"fisheye", "equidistant", "kannalabrandt"});
  if (is_fisheye && contains_any_of(name, {"undist", "rectif", "pinhole"})) return LensWord::Ideal;
  if (is_fisheye) return LensWord::Fisheye;
  if (is_any_of(name, {"omni", "mei", "ucm", "eucm", "ocam"}) ||
      contains_any_of(name, {"omnidir", "scaramuzza", "doublesphere", "catadioptric"}))
    throw InputError(field.source, field.path, "the lens model " + written, known_models);
  const std::optional<LensWord> word = word_in(written);
  const bool is_decisive =
      word == LensWord::Fisheye || word == LensWord::FieldOfView || word == LensWord::Modified;
  return is_decisive ? word : std::nullopt;
}

// Whether the path has the word from a camera's name rather than from a field.
bool is_title(const std::string& word, const CameraFields& fields) {
  return !fields
              .find_all([&](std::string_view, const json& value) {
                return value.is_string() && value.get_ref<const std::string&>() == word;
              })
              .empty();
}

bool is_of_lens_or_intrinsics(std::string_view name, const json& value) {
  if (is_list(value)) return is_matrix_name(name) || is_distortion_name(name);
  return is_any_of(name, {"fx", "fy"}) || !coefficient_name(name).empty();
}

// Files without a field for the model may name an object after it.
std::optional<FoundModel> model_of_path(const CameraFields& fields) {
  std::optional<FoundModel> model;
  for (const JsonField& field : fields.find_all(is_of_lens_or_intrinsics))
    for (const std::string& object : words_of(field.path, "/")) {
      if (is_title(object, fields)) continue;
      const std::optional<LensWord> word = word_of_object(object, field);
      if (word && model && model->word != *word)
        field.fail("the lens model of " + object, "the same lens model as " + model->field);
      if (word && !model) model = FoundModel{*word, field.path};
    }
  return model;
}

FoundModel read_model(CameraFields& fields) {
  FoundModel model;
  const std::optional<LensWord> realsense = realsense_word(fields);
  if (realsense) model = {*realsense, fields.at("model")};
  const std::optional<LensWord> luxonis = luxonis_word(fields);
  if (luxonis) model = {*luxonis, fields.at("cameraType")};
  for (const JsonField& field : fields.take_all(names_model)) {
    const std::string text = text_in_field(field);
    if (!field.value.is_string() && is_trivial(field.value)) continue;
    if (plain_name(text).empty()) continue;
    const std::optional<LensWord> word = word_in(text);
    if (!word) field.fail(text, known_models);
    join(model, *word, field);
  }
  const std::optional<FoundModel> of_switch = model_of_switch(fields);
  if (of_switch && model.word != LensWord::Pinhole && model.word != of_switch->word)
    throw InputError(fields.source(), model.field, "another lens model than " + of_switch->field,
                     "one lens model");
  if (of_switch) return *of_switch;
  return model.word == LensWord::Pinhole ? model_of_path(fields).value_or(model) : model;
}

// A name or a comment decides nothing: "camera_name: fisheye_left".
void warn_of_titles(const CameraFields& fields) {
  for (const JsonField& field : fields.find_all([](std::string_view, const json& value) {
         return value.is_string() &&
                contains_any_of(plain_name(value.get<std::string>()), {"fisheye", "equidistant"});
       }))
    log(LogLevel::Warning, one_line(field.source + ": " + field.path + ": found " +
                                    text_in_field(field).substr(0, 60) +
                                    ", expected a field that names the lens model "
                                    "(distortion_model): read as Brown-Conrady"));
}

struct Coefficients {
  std::vector<double> values;
  std::string field;  // empty: none are given
};

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
Coefficients single_coefficients(CameraFields& fields, const FoundModel& model) {
  const bool is_fisheye = model.word == LensWord::Fisheye;
  // camodocal begins at k2, and names the focal lengths mu and mv.
  const std::size_t first = is_fisheye && fields.has({"mu"}) ? 1 : 0;
  fields.take({"kdu"});  // ViSP's inverse of kud
  const SingleCoefficients singles = take_single_coefficients(fields);
  if (!is_fisheye) require_known_order(singles, model.word != LensWord::Pinhole);
  Coefficients found;
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
Coefficients radial_and_tangential(CameraFields& fields) {
  const std::optional<JsonField> radial =
      fields.take({"radialdistortion", "radial", "radialcoefficients", "radialcoeffs"});
  const std::optional<JsonField> tangential = fields.take(
      {"tangentialdistortion", "tangential", "tangentialcoefficients", "tangentialcoeffs"});
  if (!radial && !tangential) return {};
  const std::vector<double> k = radial ? numbers_in_field(*radial) : std::vector<double>{};
  const std::vector<double> p = tangential ? numbers_in_field(*tangential) : std::vector<double>{};
  if (k.size() > 3) radial->fail(std::to_string(k.size()) + " coefficients", "at most 3");
  if (p.size() > 2) tangential->fail(std::to_string(p.size()) + " coefficients", "2");
  Coefficients found{std::vector<double>(5), radial ? radial->path : tangential->path};
  constexpr std::size_t radial_places[] = {0, 1, 4};
  for (std::size_t i = 0; i < k.size(); ++i) found.values[radial_places[i]] = k[i];
  for (std::size_t i = 0; i < p.size(); ++i) found.values[2 + i] = p[i];
  return found;
}

// openMVG's k1, k1 k2 k3, k1 k2 k3 p1 p2: where each stands in OpenCV's order.
Coefficients radial_before_tangential(CameraFields& fields) {
  const std::pair<std::string_view, std::vector<std::size_t>> orders[] = {
      {"distok1", {0}}, {"distok3", {0, 1, 4}}, {"distot2", {0, 1, 4, 2, 3}}};
  for (const auto& [name, places] : orders) {
    const std::optional<JsonField> field = fields.take({name});
    if (!field) continue;
    const std::vector<double> k = numbers_in_field(*field);
    if (k.size() != places.size())
      field->fail(std::to_string(k.size()) + " coefficients", std::to_string(places.size()));
    Coefficients found{std::vector<double>(5), field->path};
    for (std::size_t i = 0; i < k.size(); ++i) found.values[places[i]] = k[i];
    return found;
  }
  return {};
}

Coefficients listed_coefficients(CameraFields& fields) {
  Coefficients found = radial_before_tangential(fields);
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

// Some programs write the same coefficients in two forms.
Coefficients read_coefficients(CameraFields& fields, const FoundModel& model) {
  Coefficients found = radial_and_tangential(fields);
  for (const Coefficients& other :
       {listed_coefficients(fields), single_coefficients(fields, model)}) {
    if (other.field.empty()) continue;
    if (!found.field.empty() && !are_equal(other.values, found.values))
      throw InputError(fields.source(), other.field, "other coefficients",
                       "those of " + found.field);
    if (found.field.empty()) found = other;
  }
  return found;
}

// The counts that a model may have; more only where they are zero.
std::vector<std::size_t> counts_of(LensModel lens) {
  switch (lens) {
    case LensModel::BrownConrady:
      return {0, 4, 5, 8, 12, 14};
    case LensModel::ModifiedBrownConrady:
      return {0, 4, 5};
    case LensModel::Fisheye:
      return {4, 12};
    case LensModel::ThinPrismFisheye:
      return {8};
    case LensModel::FieldOfView:
      return {1};
  }
  throw LogicError("counts_of: no such lens model");
}

LensModel model_of(LensWord word) {
  switch (word) {
    case LensWord::Modified:
      return LensModel::ModifiedBrownConrady;
    case LensWord::Fisheye:
      return LensModel::Fisheye;
    case LensWord::FieldOfView:
      return LensModel::FieldOfView;
    default:
      return LensModel::BrownConrady;
  }
}

}  // namespace

void set_lens(Camera& camera, LensModel lens, const std::vector<double>& coefficients,
              const std::string& source, const std::string& field) {
  std::vector<double> kept = coefficients;
  const std::vector<std::size_t> counts = counts_of(lens);
  const auto fits = [&] { return std::ranges::find(counts, kept.size()) != counts.end(); };
  while (!fits() && kept.size() > counts.front() && kept.back() == 0) kept.pop_back();
  std::string expected;
  for (std::size_t count : counts)
    expected += (expected.empty() ? "" : ", ") + std::to_string(count);
  if (!fits())
    throw InputError(source, field, std::to_string(coefficients.size()) + " coefficients",
                     expected + " of the lens model " + to_string(lens) + " (more only where 0)");
  camera.lens = lens;
  camera.distortion.fill(0);
  std::ranges::copy(kept, camera.distortion.begin());
}

void read_lens(CameraFields& fields, Camera& camera) {
  const FoundModel model = read_model(fields);
  if (model.word == LensWord::Pinhole) warn_of_titles(fields);
  const LensModel lens = model_of(model.word);
  const Coefficients found = read_coefficients(fields, model);
  const bool is_named = model.word != LensWord::Ideal && model.word != LensWord::Pinhole;
  if (is_named && found.field.empty())
    throw InputError(fields.source(), fields.at("distortion_coefficients"), "nothing",
                     "the coefficients of the model in " + model.field);
  const bool bends = std::ranges::any_of(found.values, [](double k) { return k != 0; });
  if (model.word == LensWord::Ideal && bends)
    throw InputError(fields.source(), found.field, "coefficients that are not 0",
                     "none, as " + model.field + " says");
  // RealSense's models have five coefficients, of which one or four count.
  set_lens(camera, bends || lens == LensModel::Fisheye ? lens : LensModel::BrownConrady,
           found.values, fields.source(), found.field);
}

}  // namespace edgescout
