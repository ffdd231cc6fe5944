// Symmetries said in a word, for models that come without BOP's models_info.json.
#pragma once

#include <span>
#include <string>

#include "host/core/types.h"

namespace edgescout {

// Each word is an axis of the object frame and how often the object looks the same in one turn
// about it: "z2" is a half turn about z, "x4" four quarter turns; an axis alone ("z") is a surface
// of revolution, sampled in `continuous_steps` turns. The axes run through the surface's centroid,
// which every symmetry of a surface keeps. Several words stand for the group that their turns
// generate ("x4 z4": a cube's 24); surfaces of revolution multiply it by their samples. InputError
// on another word, on turns that generate no finite group.
Symmetries axis_symmetries(const Mesh& mesh, std::span<const std::string> words,
                           int continuous_steps = 64);

}  // namespace edgescout
