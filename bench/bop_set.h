// A folder of BOP scenes with its models, as the programs take it that print the data of fits.
#pragma once

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "host/io/bop.h"
#include "kernels/error.h"

namespace edgescout::bench {

struct BopSet {
  std::string scenes, models, name;  // models has models_info.json and obj_NNNNNN.ply in mm

  // Sets what was not given. InputError: no scenes.
  void set_defaults() {
    if (scenes.empty())
      throw InputError("command line", "SCENES", "nothing", "a folder of BOP scenes");
    if (models.empty()) models = scenes + "/models";
    if (name.empty()) name = (std::filesystem::path(scenes) / "").parent_path().filename().string();
  }
};

inline std::vector<BopScene> load_scenes(const BopSet& set) {
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(set.scenes))
    if (is_bop_scene(entry.path())) folders.push_back(entry.path());
  std::ranges::sort(folders);
  std::vector<BopScene> scenes;
  for (const std::filesystem::path& folder : folders) scenes.push_back(load_bop_scene(folder));
  return scenes;
}

inline Object load_object(const BopSet& set, int id, const Symmetries& symmetries) {
  char file[32];
  std::snprintf(file, sizeof file, "obj_%06d.ply", id);
  return {id, load_mesh(std::filesystem::path(set.models) / file, LengthUnit::Millimetre),
          symmetries};
}

// A scene's files do not tell the size of its images.
inline Camera camera_of(const BopImage& image, const Image& pixels) {
  Camera camera = image.camera;
  camera.width = pixels.width;
  camera.height = pixels.height;
  return camera;
}

}  // namespace edgescout::bench
