#include "host/experiments/data_mark.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "host/io/binary_file.h"
#include "host/io/files.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

constexpr const char* SETS[] = {"d2co-starts", "brackets", "cat", "triangle", "cad"};
constexpr const char* NEEDED[] = {"d2co-starts/ground_truth.json",
                                  "d2co-starts/starts.csv",
                                  "brackets/000001/scene_camera.json",
                                  "brackets/000001/scene_gt.json",
                                  "brackets/000002/scene_camera.json",
                                  "brackets/000002/scene_gt.json",
                                  "cat/scene_camera.json",
                                  "cat/scene_gt.json",
                                  "triangle/scene_camera.json",
                                  "triangle/scene_gt.json",
                                  "brackets/models/models_info.json",
                                  "brackets/models/obj_000001.ply",
                                  "cat/models/obj_000001.ply",
                                  "triangle/models/obj_000001.ply",
                                  "cad/AX-01_bearing_box.stl",
                                  "cad/flange.stl",
                                  "cad/t13.stl"};

}  // namespace

std::string data_mark(const fs::path& data) {
  for (const char* file : NEEDED) read_file(data / file);
  std::vector<fs::path> files;
  for (const char* set : SETS)
    for (const auto& entry : fs::recursive_directory_iterator(
             data / set, fs::directory_options::follow_directory_symlink))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::ranges::sort(files);
  std::string marks;
  for (const fs::path& file : files)
    marks += fmt::format("{} {:016x}\n", file.lexically_relative(data).generic_string(),
                         checksum(read_file(file)));
  return fmt::format("{:016x}", checksum(marks));
}

}  // namespace edgescout
