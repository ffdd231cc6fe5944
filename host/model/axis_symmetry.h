// Symmetries from short words, for models without BOP's models_info.json.
//
// Public header.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

// Returns the symmetries that words name. A word is an axis of the object frame and the order of
// the symmetry about it: "z2" is a half turn about z, "x4" four quarter turns. An axis alone ("z")
// is a surface of revolution, sampled in `continuous_steps` turns. The axes pass through the
// surface's centroid, which every symmetry of a surface keeps. Several words give the group that
// their turns generate ("x4 z4": the 24 of a cube). Each surface of revolution multiplies it by its
// samples. InputError: another word, turns that generate no finite group.
Symmetries axis_symmetries(const Mesh& mesh, std::span<const std::string> words,
                           int continuous_steps = 64);

// Returns the symmetries of transforms that map the object onto itself. The identity comes first,
// given or not.
Symmetries symmetries_of_transforms(std::vector<Se3> transforms);

}  // namespace edgescout
