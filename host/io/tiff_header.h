// Internal to host/io: what the first directory of a TIFF file states of its pixels.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "host/io/image_header.h"

namespace edgescout {

// Also of a file beyond 4 GiB (BigTIFF). The other functions take such files alone.
bool is_tiff(std::string_view bytes);

// 0: the file does not say.
StatedSize tiff_size(std::string_view bytes);

// Pixels that OpenCV does not decode. Empty: none.
std::string tiff_trouble(std::string_view bytes);

// The largest of the values that a file has whose 0 is white (photometric interpretation 0), where
// its decoder leaves them so: those of more than 8 bits. Nothing for other files.
std::optional<int> black_of_inverted(std::string_view bytes);

// The file with its orientation set to 1: its decoder would turn the pixels. Other files come back
// unchanged.
std::string as_stored(const std::string& bytes);

// Whether there is a page after the first one. False for other files.
bool has_more_pages(std::string_view bytes);

}  // namespace edgescout
