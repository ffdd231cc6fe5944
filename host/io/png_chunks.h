// Internal to host/io: the chunks of a PNG file, checked before its decoder sees them, and made.
#pragma once

#include <string>
#include <string_view>

namespace edgescout {

// The file without what a decoder of grey values does not need: text, times, colour profiles. Its
// decoder writes lines of its own about damage. So what it needs is whole here. InputError naming
// `source`: bytes that changed or are missing, a chunk that PNG does not know.
std::string needed_png_chunks(const std::string& bytes, const std::string& source);

// A chunk with its length and its checksum. `name`: four letters.
std::string png_chunk(const std::string& name, const std::string& content);

}  // namespace edgescout
