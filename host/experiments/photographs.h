// Photographs of known poses below the data folder: brackets (three views of one pile, one image of flat
// ones), the cat, and the triangle (one part twice from nearly the same place).
#pragma once

#include "host/experiments/known_scene.h"

namespace edgescout {

struct Photographs {
  std::string set;                      // "brackets", "cat", "triangle"
  std::filesystem::path scene, models;  // folders
  std::vector<int> images;              // ids
};

// Those below `data`, none where it is empty. `every`: of the cat's frames. InputError naming the first file
// that is missing.
std::vector<Photographs> photographs_in(const std::filesystem::path& data, int every);

// All images one by one, each with its cell's name: "brackets/000001_000002".
struct NamedPhotograph {
  std::string name;
  Photographs source;
  int image = 0;
};
std::vector<NamedPhotograph> single_photographs(const std::filesystem::path& data, int every);

}  // namespace edgescout
