// Photographs with known poses in the data folder.
//
//   brackets   three views of one pile, and one image of parts that lie flat
//   cat        frames of one object
//   triangle   a regular prism, which looks alike in six poses, twice from nearly the same place
#pragma once

#include "host/experiments/known_scene.h"

namespace edgescout {

struct Photographs {
  std::string set;                      // "brackets", "cat", "triangle"
  std::filesystem::path scene, models;  // folders
  std::vector<int> images;              // ids
  // Symmetry of the part in the words of model/axis_symmetry.h, if its models_info.json has none.
  std::vector<std::string> symmetry = {};
};

// A note on the intervals in reports. The images are resampled one by one, since there are too few
// scenes to resample.
inline constexpr const char* PHOTOGRAPHS_COUNT_APART =
    "Photographs count as independent images in the intervals, also those of one scene, which show "
    "the same "
    "parts: the intervals say less than they seem to.";

// Returns the photographs in `data`; none if `data` is empty. Uses every `every`-th frame of the
// cat. InputError naming the first missing file.
std::vector<Photographs> photographs_in(const std::filesystem::path& data, int every);

// Its images as one scene.
KnownScene photographed_scene(const Photographs& source);

// One image with the name of its cell: "brackets/000001_000002".
struct NamedPhotograph {
  std::string name;
  Photographs source;  // of one image
};
std::vector<NamedPhotograph> single_photographs(const std::filesystem::path& data, int every);

}  // namespace edgescout
