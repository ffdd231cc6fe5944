#include "host/io/scene_text.h"

#include <string>

#include "host/io/files.h"
#include "host/io/lower_case.h"
#include "host/io/mesh.h"
#include "host/io/text_tokens.h"
#include "host/io/zip_archive.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// The value of an attribute of the first element of that name; empty if there is none.
std::string_view attribute(std::string_view xml, const std::string& element,
                           const std::string& name) {
  std::size_t at = xml.find("<" + element + " ");
  if (at == std::string_view::npos) return {};
  const std::string_view tag = xml.substr(at, xml.find('>', at) - at);
  at = tag.find(" " + name + "=");
  if (at == std::string_view::npos) return {};
  const std::string_view value = tag.substr(at + name.size() + 2);
  if (value.size() < 2) return {};
  const std::size_t end = value.find(value[0], 1);
  return end == std::string_view::npos ? std::string_view{} : value.substr(1, end - 1);
}

double unit_of_3mf(std::string_view model, const std::string& source) {
  const std::string_view word = attribute(model, "model", "unit");
  if (word.empty() || word == "millimeter") return metres_per(LengthUnit::Millimetre);
  if (word == "micron") return 1e-6;
  if (word == "centimeter") return metres_per(LengthUnit::Centimetre);
  if (word == "inch") return metres_per(LengthUnit::Inch);
  if (word == "foot") return 0.3048;
  if (word == "meter") return metres_per(LengthUnit::Metre);
  throw InputError(source, "unit", std::string(word.substr(0, 40)),
                   "micron, millimeter, centimeter, inch, foot or meter");
}

// Assimp reads past the end of a transform that is too short.
void require_transforms(std::string_view model, const std::string& source) {
  constexpr std::string_view mark = " transform=";
  for (std::size_t at = model.find(mark); at != std::string_view::npos; at = model.find(mark, at)) {
    at += mark.size();
    const std::size_t end =
        at < model.size() ? model.find(model[at], at + 1) : std::string_view::npos;
    if (end == std::string_view::npos) return;  // assimp refuses the file
    TextTokens numbers(model.substr(at + 1, end - at - 1), source + ": transform");
    for (int i = 0; i < 12; ++i) numbers.number("one of 12 numbers");
  }
}

double check_3mf(const std::filesystem::path& file) {
  const std::string source = file.string();
  const std::string model = read_zipped(file, ".model", most_scene_bytes);
  if (model.empty()) throw InputError(source, "3MF", "no model in the archive", "3D/3dmodel.model");
  require_transforms(model, source);
  return unit_of_3mf(model, source);
}

void check_gltf(std::string_view text, const std::string& source) {
  for (const char* packing : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"})
    if (text.find(packing) != std::string_view::npos)
      throw InputError(source, "extensions", packing, "geometry that is not compressed");
}

double unit_of_collada(std::string_view text, const std::string& source) {
  const std::string_view word = attribute(text, "unit", "meter");
  if (word.empty()) return 1;
  const double metres = TextTokens(word, source + ": unit").number("metres");
  if (!(metres > 1e-9 && metres < 1e9))
    throw InputError(source, "unit", std::string(word), "a length in metres");
  return metres;
}

}  // namespace

bool is_collada(const std::filesystem::path& file) {
  return lower_case(file.extension().string()) == ".dae";
}

double check_scene_text(const std::filesystem::path& file) {
  const std::string source = file.string();
  std::error_code unknown;
  if (std::filesystem::file_size(file, unknown) > most_scene_bytes && !unknown)
    throw InputError(source, "size", "more than 256 MiB", "a smaller file, or STL or PLY");
  if (lower_case(file.extension().string()) == ".3mf") return check_3mf(file);
  const std::string text = read_file(file);
  if (is_collada(file)) return unit_of_collada(text, source);
  check_gltf(text, source);
  return 1;
}

}  // namespace edgescout
