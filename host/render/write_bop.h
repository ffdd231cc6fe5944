// Writes rendered scenes in BOP's layout.
//
//   DATASET/models/obj_000001.ply ..   millimetres
//   DATASET/models/models_info.json    diameter, box, symmetries
//   DATASET/000000/gray/000000.png ..  one per view
//   DATASET/000000/depth/000000.png .. of the same names, if the options have a depth sensor
//   DATASET/000000/scene_camera.json, scene_gt.json, scene_gt_info.json
#pragma once

#include <filesystem>
#include <map>
#include <span>

#include "host/render/renderer.h"

namespace edgescout {

// Writes the folder of one scene. `renderings` has one entry per view. Ground truth is written for
// every target, not for foreign parts. InputError: the folder cannot be written.
void write_bop_scene(const SimulatedScene& scene, std::span<const Rendering> renderings,
                     const std::filesystem::path& folder);

// Writes the folder of the models. An object with an entry in `turning_axes` gets a continuous
// symmetry about that axis through its origin, in place of its discrete symmetries.
void write_bop_models(std::span<const Object> objects,
                      const std::map<int, Eigen::Vector3d>& turning_axes,
                      const std::filesystem::path& folder);

}  // namespace edgescout
