#include "host/io/exif.h"

#include "host/io/byte_numbers.h"

namespace edgescout {

namespace {

int orientation_in_tiff(std::string_view tiff) {
  constexpr unsigned orientation_tag = 0x0112;
  constexpr std::size_t entry_size = 12;
  if (!tiff.starts_with("MM") && !tiff.starts_with("II")) return 1;
  const ByteNumbers numbers{tiff, tiff.starts_with("MM")};
  const std::size_t directory = numbers.at(4, 4);
  const std::uint64_t count = numbers.at(directory, 2);
  for (unsigned i = 0; i < count; ++i) {
    const std::size_t entry = directory + 2 + i * entry_size;
    if (entry + entry_size > tiff.size()) break;
    if (numbers.at(entry, 2) != orientation_tag) continue;
    const std::uint64_t value = numbers.at(entry + 8, 2);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

int orientation_in_jpeg(std::string_view bytes) {
  constexpr std::string_view exif("Exif\0\0", 6);
  const ByteNumbers numbers{bytes};
  // Segments: a mark of two bytes, then their length with these two bytes of length.
  for (std::size_t at = 2; at + 4 <= bytes.size() && bytes[at] == '\xff';) {
    const std::uint64_t mark = numbers.at(at + 1, 1), length = numbers.at(at + 2, 2);
    constexpr unsigned app1 = 0xe1, scan = 0xda;
    if (mark == scan || length < 2) return 1;
    const std::string_view content = bytes.substr(at + 4, length - 2);
    if (mark == app1 && content.starts_with(exif))
      return orientation_in_tiff(content.substr(exif.size()));
    at += 2 + length;
  }
  return 1;
}

// Chunks of a length, a name of four letters and content: those of PNG are followed by a checksum,
// those of WebP by a byte that makes the length even.
struct ChunkLayout {
  std::string_view name;
  bool big_endian, length_first, padded;
  std::size_t start, after;
};

int orientation_in_chunks(std::string_view bytes, const ChunkLayout& layout) {
  constexpr std::size_t head = 8;
  const ByteNumbers numbers{bytes, layout.big_endian};
  for (std::size_t at = layout.start; at + head <= bytes.size();) {
    const std::size_t length_at = at + (layout.length_first ? 0 : 4),
                      name_at = at + (layout.length_first ? 4 : 0);
    const std::uint64_t length = numbers.at(length_at, 4);
    if (bytes.substr(name_at, 4) == layout.name)
      return orientation_in_tiff(bytes.substr(at + head, length));
    at += head + length + (layout.padded ? length % 2 : 0) + layout.after;
  }
  return 1;
}

}  // namespace

int exif_orientation(std::string_view bytes) {
  if (bytes.starts_with("\xff\xd8")) return orientation_in_jpeg(bytes);
  if (bytes.starts_with("\x89PNG"))
    return orientation_in_chunks(bytes, {"eXIf", true, true, false, 8, 4});
  if (bytes.starts_with("RIFF"))
    return orientation_in_chunks(bytes, {"EXIF", false, false, true, 12, 0});
  return orientation_in_tiff(bytes);
}

}  // namespace edgescout
