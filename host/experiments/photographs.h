// Photographs of known poses below the data folder: brackets (three views of one pile, one image of
// flat ones), the cat, and the triangle (one part twice from nearly the same place; a regular
// prism, which looks alike in six poses).
#pragma once

#include "host/experiments/known_scene.h"

namespace edgescout {

struct Photographs {
  std::string set;                      // "brackets", "cat", "triangle"
  std::filesystem::path scene, models;  // folders
  std::vector<int> images;              // ids
  // Of the part, in words (host/model/axis_symmetry.h), where its models_info.json says nothing of
  // it.
  std::vector<std::string> symmetry = {};
};

// Of the intervals in reports of their images one by one: scenes are too few to draw.
inline constexpr const char* PHOTOGRAPHS_COUNT_APART =
    "Photographs count as independent images in the intervals, also those of one scene, which show "
    "the same "
    "parts: the intervals say less than they seem to.";

// Those below `data`, none where it is empty. `every`: of the cat's frames. InputError naming the
// first file that is missing.
std::vector<Photographs> photographs_in(const std::filesystem::path& data, int every);

// Its images as one scene.
KnownScene photographed_scene(const Photographs& source);

// All images one by one, each with its cell's name: "brackets/000001_000002".
struct NamedPhotograph {
  std::string name;
  Photographs source;  // of one image
};
std::vector<NamedPhotograph> single_photographs(const std::filesystem::path& data, int every);

}  // namespace edgescout
