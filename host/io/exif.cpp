#include "host/io/exif.h"

#include <cstddef>

namespace edgescout {

namespace {

// Numbers of a TIFF header, whose first two letters say how they are stored. Beyond the end: 0.
struct TiffNumbers {
  std::string_view bytes;
  bool big_endian;

  unsigned at(std::size_t place, int size) const {
    unsigned number = 0;
    for (int i = 0; i < size; ++i) {
      const std::size_t from = place + static_cast<std::size_t>(big_endian ? i : size - 1 - i);
      const unsigned byte = from < bytes.size() ? static_cast<unsigned char>(bytes[from]) : 0;
      number = 256 * number + byte;
    }
    return number;
  }
};

int orientation_in_tiff(std::string_view tiff) {
  constexpr unsigned orientation_tag = 0x0112;
  constexpr std::size_t entry_size = 12;
  if (!tiff.starts_with("MM") && !tiff.starts_with("II")) return 1;
  const TiffNumbers numbers{tiff, tiff.starts_with("MM")};
  const std::size_t directory = numbers.at(4, 4);
  const unsigned count = numbers.at(directory, 2);
  for (unsigned i = 0; i < count; ++i) {
    const std::size_t entry = directory + 2 + i * entry_size;
    if (entry + entry_size > tiff.size()) break;
    if (numbers.at(entry, 2) != orientation_tag) continue;
    const unsigned value = numbers.at(entry + 8, 2);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

}  // namespace

int exif_orientation(std::string_view bytes) {
  constexpr std::string_view exif("Exif\0\0", 6);
  if (!bytes.starts_with("\xff\xd8")) return 1;
  const TiffNumbers numbers{bytes, true};
  // Segments: a mark of two bytes, then their length with these two bytes of length.
  for (std::size_t at = 2; at + 4 <= bytes.size() && bytes[at] == '\xff';) {
    const unsigned mark = numbers.at(at + 1, 1), length = numbers.at(at + 2, 2);
    constexpr unsigned app1 = 0xe1, scan = 0xda;
    if (mark == scan || length < 2) return 1;
    const std::string_view content = bytes.substr(at + 4, length - 2);
    if (mark == app1 && content.starts_with(exif))
      return orientation_in_tiff(content.substr(exif.size()));
    at += 2 + length;
  }
  return 1;
}

}  // namespace edgescout
