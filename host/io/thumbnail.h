// Small pictures of drawn images, for pages that show thousands of them.
//
// A PNG file carries its own: a JPEG in the chunk thMB, before the pixels. Decoders skip it. So the
// small picture is written, replaced and removed with the file, and is read without its pixels.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host/io/image.h"

namespace edgescout {

inline constexpr int THUMBNAIL_SIDE_PX = 200;  // the longer side at most

// Writes the image as PNG with its thumbnail, atomically. InputError: the file cannot be written.
void save_png_with_thumbnail(const RgbImage& image, const std::filesystem::path& file);

// Returns the bytes of the JPEG that the PNG file carries. Of a file without one it is made from
// the pixels. Nothing: there is no such file, or it is no whole PNG.
std::optional<std::string> thumbnail_in(const std::filesystem::path& file);

}  // namespace edgescout
