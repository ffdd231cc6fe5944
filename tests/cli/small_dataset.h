// A small rendered scene as a BOP dataset, in the layouts of its sets.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/cli/small_scene.h"

namespace edgescout::test {

// Which camera saw the view of a scene, in which folder, under which ending.
struct CameraOfView {
  std::string camera;  // empty: scene_camera.json
  std::string folder;
  std::string ending = ".png";
};

using Views = std::vector<CameraOfView>;

// DATASET/models and DATASET/test/000003.
class SmallDataset {
 public:
  // Camera i saw view i of the scene. The images of each camera are numbered from 0.
  explicit SmallDataset(const Views& cameras, const std::string& split = "test",
                        const std::string& models = "models")
      : made(static_cast<int>(cameras.size())) {
    scene = root / split / "000003";
    const BopScene all = load_bop_scene(made.scene);
    std::map<std::string, BopScene> scenes;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      BopScene& of_camera = scenes[cameras[i].camera];
      of_camera.camera_name = cameras[i].camera;
      BopImage image = all.images[i];
      image.image_id = static_cast<int>(of_camera.images.size());
      of_camera.truth[image.image_id] = all.truth.at(static_cast<int>(i));
      fs::create_directories(scene / cameras[i].folder);
      fs::copy(image.file,
               scene / cameras[i].folder / (six_digits(image.image_id) + cameras[i].ending));
      of_camera.images.push_back(image);
    }
    for (const auto& [camera, of_camera] : scenes) save_bop_scene(of_camera, scene);
    fs::create_directories(root / models);
    fs::copy(part_file(1), root / models / "obj_000001.ply");
    fs::copy(examples() / "parts/models_info.json", root / models);
  }

  // Of the dataset with its own models, or with `--split` among `more` unless the input is a scene.
  std::vector<std::string> detect(const fs::path& input,
                                  const std::vector<std::string>& more = {}) const {
    return made.detect(input, joined({few_templates(), {"--no-overlays"}, more}));
  }
  std::vector<std::string> model() const {
    return {"--model", root / "models/obj_000001.ply", "--unit", "mm"};
  }

  SmallScene made;
  fs::path root = made.folder.path() / "set";
  fs::path scene;
  fs::path out = made.out;
};

inline SmallDataset industrial_set() {
  return SmallDataset(Views{{"cam1", "rgb_cam1"}, {"cam2", "gray_cam2", ".tif"}});
}

// The result nearest to the truth, m.
inline double off_truth_m(const std::vector<BopResult>& results, const BopScene& scene,
                          int image_id) {
  double least_m = 1;
  for (const BopResult& result : results)
    if (result.image_id == image_id &&
        (result.camera_name.empty() || result.camera_name == scene.camera_name))
      for (const BopTruth& truth : scene.truth.at(image_id))
        least_m = std::min(least_m,
                           distance_between_m(result.camera_from_object, truth.camera_from_object));
  return least_m;
}

}  // namespace edgescout::test
