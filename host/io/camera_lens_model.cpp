#include "host/io/camera_lens_model.h"

#include <map>

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

}  // namespace

FoundModel read_lens_model(CameraFields& fields) {
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

void warn_of_lens_in_titles(const CameraFields& fields) {
  for (const JsonField& field : fields.find_all([](std::string_view, const json& value) {
         return value.is_string() &&
                contains_any_of(plain_name(value.get<std::string>()), {"fisheye", "equidistant"});
       }))
    log(LogLevel::Warning, one_line(field.source + ": " + field.path + ": found " +
                                    text_in_field(field).substr(0, 60) +
                                    ", expected a field that names the lens model "
                                    "(distortion_model): read as Brown-Conrady"));
}

}  // namespace edgescout
