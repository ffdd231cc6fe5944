// The camera.txt of DSO, which TUM's monoVO data and their successors have as well: a model with
// its parameters, the size of the image, and how to undistort it, which is not needed here.
#include <algorithm>
#include <array>

#include "host/core/words.h"
#include "host/io/camera_fields.h"
#include "host/io/camera_tree.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

struct DsoModel {
  std::string_view name;  // plain
  const char* word;
  std::size_t coefficients;
};
constexpr DsoModel dso_models[] = {{"pinhole", "pinhole", 1},
                                   {"fov", "fov", 1},
                                   {"radtan", "radtan", 4},
                                   {"equidistant", "equidistant", 4},
                                   {"kannalabrandt", "equidistant", 4}};

bool are_two_sides(const std::string& line) {
  const json sides = numbers_in(line);
  return sides.size() == 2 &&
         std::ranges::all_of(sides, [](const json& side) { return side.get<double>() >= 16; });
}

bool says_how_to_undistort(const std::string& line) {
  return is_any_of(plain_name(line), {"crop", "full", "none"}) || numbers_in(line).size() == 5;
}

// A first line of numbers alone is RadTan, or FOV; such a file must have all its four lines.
const DsoModel* unnamed_dso_model(const std::vector<std::string>& lines) {
  const std::size_t count = numbers_in(lines.front()).size();
  if (lines.size() != 4 || !says_how_to_undistort(lines[2]) || !are_two_sides(lines[3]))
    return nullptr;
  return count == 8 ? &dso_models[2] : count == 5 ? &dso_models[1] : nullptr;
}

const DsoModel* dso_model(const std::vector<std::string>& lines) {
  if (lines.size() < 2 || lines.size() > 4 || !are_two_sides(lines[1])) return nullptr;
  if (const DsoModel* model = unnamed_dso_model(lines)) return model;
  const std::string name = plain_name(words_of(lines.front()).front());
  const auto* model = std::ranges::find(dso_models, name, &DsoModel::name);
  return model == std::end(dso_models) ? nullptr : model;
}

// Parts of the image's sides where both numbers of the principal point are below 1. Then the corner
// of the first pixel is at 0, 0.
void set_dso_pinhole(json& camera, std::array<double, 4> k, const std::string& source) {
  const double width = camera["width"], height = camera["height"];
  const bool x_is_part = k[2] < 1, y_is_part = k[3] < 1;
  if (x_is_part != y_is_part)
    throw InputError(source, "cx, cy", json(k[2]).dump() + " and " + json(k[3]).dump(),
                     "both in px, or both in parts of the image's sides");
  if (x_is_part) k = {k[0] * width, k[1] * height, k[2] * width - 0.5, k[3] * height - 0.5};
  camera["fx"] = k[0];
  camera["fy"] = k[1];
  camera["cx"] = k[2];
  camera["cy"] = k[3];
}

void set_dso_lens(json& camera, const DsoModel& model, std::vector<double> coefficients,
                  const std::string& source) {
  const bool bends = std::ranges::any_of(coefficients, [](double k) { return k != 0; });
  const bool is_pinhole = model.word == std::string("pinhole");
  if (is_pinhole && bends)
    throw InputError(source, "Pinhole", json(coefficients.front()).dump() + " behind cy", "0");
  // FOV with an angle of 0 is a pinhole camera.
  camera["distortion_model"] = bends || coefficients.size() > 1 ? model.word : "pinhole";
  camera["D"] = bends || coefficients.size() > 1 ? coefficients : std::vector<double>{};
}

}  // namespace

json dso_camera(const std::vector<std::string>& lines, const std::string& source) {
  const DsoModel* model = dso_model(lines);
  if (!model) return nullptr;
  const std::string& first = lines.front();
  const bool is_named = numbers_in(first).is_null();
  const std::string word = words_of(first).front();
  const json numbers = numbers_in(std::string_view(first).substr(is_named ? word.size() : 0));
  const std::size_t expected = 4 + model->coefficients;
  if (numbers.size() != expected)
    throw InputError(source, word, std::to_string(numbers.size()) + " numbers of DSO's camera.txt",
                     std::to_string(expected) + ": fx fy cx cy and the coefficients");
  const json sides = numbers_in(lines[1]);
  json camera = {{"width", sides[0]}, {"height", sides[1]}};
  set_dso_pinhole(camera, {numbers[0], numbers[1], numbers[2], numbers[3]}, source);
  set_dso_lens(camera, *model, std::vector<double>(numbers.begin() + 4, numbers.end()), source);
  return camera;
}

}  // namespace edgescout
