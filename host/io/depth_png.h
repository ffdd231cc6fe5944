// Writes depth images as PNG of 16 bit.
//
// Public header.
#pragma once

#include <filesystem>

#include "host/core/depth_image.h"

namespace edgescout {

// Values are whole units; 0 is missing, and so is what is too far for 16 bit or below half a unit.
// Atomically. InputError: the file cannot be written. LogicError: another number of values than the
// size says.
void write_depth_png(const DepthImage& depth, double unit_m, const std::filesystem::path& file);

}  // namespace edgescout
