#include "host/experiments/data_mark.h"

#include <fmt/format.h>

#include "host/io/binary_file.h"
#include "host/io/files.h"

namespace edgescout {

std::string data_mark(const std::filesystem::path& data) {
  std::string contents = read_file(data / "d2co-starts/ground_truth.json");
  contents += read_file(data / "d2co-starts/starts.csv");
  for (const char* scene : {"brackets/000001", "brackets/000002", "cat"})
    for (const char* file : {"scene_camera.json", "scene_gt.json"})
      contents += read_file(data / scene / file);
  return fmt::format("{:016x}", checksum(contents));
}

}  // namespace edgescout
