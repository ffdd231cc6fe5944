// Takes parts of photographs for backgrounds, boards and reflections.
#pragma once

#include <filesystem>
#include <vector>

#include "host/core/random.h"
#include "host/core/types.h"

namespace edgescout {

// Files of images, by the folder that holds them. A folder is drawn first, then an image in it, so
// that a long sequence counts no more than a single image.
using PhotographFolders = std::vector<std::vector<std::filesystem::path>>;

// The images in a folder and the folders below it, sorted. InputError: no such folder, no image in
// it.
PhotographFolders list_photographs(const std::filesystem::path& folder);

// Returns a random part of one of the photographs, scaled to this size, grey, perhaps mirrored.
// InputError naming the file: it cannot be read as a grey image of 8 bit.
Image random_crop(const PhotographFolders& photographs, int width, int height, Random random);

// Covers a square with copies of the image, every second one mirrored.
Image mirrored_tiles(const Image& image, int side_px);

// The light that a grey level of a photograph stands for; 1 is white.
double light_of_grey(double grey);

}  // namespace edgescout
