#include "host/io/camera_programs.h"

#include "host/io/camera_reader.h"

namespace edgescout {

using nlohmann::json;

json with_common_fields(json tree, const std::string& source) {
  const JsonField root{tree, source, ""};
  if (is_of_opensfm(tree)) return opensfm_cameras(root);
  if (is_of_alicevision(tree)) return alicevision_cameras(root);
  if (is_of_aria(tree)) return aria_cameras(root);
  return tree;
}

std::optional<std::string> program_that_is_not_read(const std::string& text) {
  constexpr std::pair<std::string_view, const char*> marks[] = {
      {"<projection>frame", "Agisoft Metashape"},
      {"capturingreality.com", "RealityCapture"},
      {"# Bundle file", "Bundler"},
      {"calibu_", "Calibu"},
      {"# kapture format", "kapture"},
      {"coefficients for the DIRECT mapping", "OCamCalib (Scaramuzza's model)"}};
  for (const auto& [mark, program] : marks)
    if (text.find(mark) != std::string::npos) return program;
  return {};
}

}  // namespace edgescout
