// Rendered scenes in BOP's layout.
//
//   DATASET/models/obj_000001.ply ..   millimetres
//   DATASET/models/models_info.json    diameter, box, symmetries
//   DATASET/000000/gray/000000.png ..  one a view
//   DATASET/000000/scene_camera.json, scene_gt.json, scene_gt_info.json
#pragma once

#include <filesystem>
#include <map>
#include <span>

#include "host/render/renderer.h"

namespace edgescout {

// One scene's folder; `renderings` one a view. Truth stands for every target, foreign parts have
// none. InputError where the folder cannot be written.
void write_bop_scene(const Scene& scene, std::span<const Rendering> renderings,
                     const std::filesystem::path& folder);

// The models' folder. An object with an entry in `turning_axes` gets a continuous symmetry about
// that axis through its origin in place of its discrete ones.
void write_bop_models(std::span<const Object> objects,
                      const std::map<int, Eigen::Vector3d>& turning_axes,
                      const std::filesystem::path& folder);

}  // namespace edgescout
