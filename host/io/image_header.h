// Internal to host/io: what the first bytes of an image file state, read before anything is
// decoded.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace edgescout {

struct StatedSize {
  std::uint64_t width = 0, height = 0;
};

// "640x480"
std::string text_of_size(const StatedSize& size);

// InputError naming `source`: more pixels than 2^28, or a side that OpenCV does not take.
void require_size(const StatedSize& size, const std::string& source);

// The size in the header of a PNG, JPEG, BMP, TIFF, WebP, JPEG 2000, OpenEXR, Sun raster, Radiance
// or portable (PBM to PFM) file. Nothing for other files, and where the header is cut short.
std::optional<StatedSize> stated_size(std::string_view bytes);

// Whether these are the first bytes, 16 or more, of a file of such a format.
bool begins_as_image(std::string_view bytes);

// The bytes that a file without compression (BMP, PGM, PPM, PAM) has at least. 0: not known.
std::uint64_t stated_bytes(std::string_view bytes);

// The value of white that a PGM, PPM or PAM file states, other than 255 and 65535, which cameras
// write whatever they fill. Decoders do not apply it.
std::optional<double> stated_white(std::string_view bytes);

// What a file holds that OpenCV would refuse in several lines of its own. Empty: nothing known.
std::string undecodable(std::string_view bytes);

}  // namespace edgescout
