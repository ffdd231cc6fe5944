#include "host/io/tiff_header.h"

#include <algorithm>

#include "host/io/byte_numbers.h"

namespace edgescout {

namespace {

ByteNumbers numbers_of(std::string_view bytes) { return {bytes, bytes.starts_with("MM")}; }

// Places and widths of the numbers in the directories of a TIFF file, and of one beyond 4 GiB.
struct TiffLayout {
  std::size_t first_directory_at, offset_bytes, count_bytes, entry_bytes;
};

TiffLayout tiff_layout(const ByteNumbers& numbers) {
  constexpr unsigned big = 43;
  return numbers.at(2, 2) == big ? TiffLayout{8, 8, 8, 20} : TiffLayout{4, 4, 2, 12};
}

std::size_t tiff_directory(const ByteNumbers& numbers) {
  const TiffLayout layout = tiff_layout(numbers);
  return numbers.at(layout.first_directory_at, layout.offset_bytes);
}

// Of the directory's entries, those that the file has.
std::uint64_t tiff_entries(const ByteNumbers& numbers) {
  const TiffLayout layout = tiff_layout(numbers);
  return std::min<std::uint64_t>(numbers.at(tiff_directory(numbers), layout.count_bytes),
                                 numbers.bytes.size() / layout.entry_bytes);
}

// Where the value of a tag stands in the first directory, and its bytes. 0: it has none.
struct TiffValue {
  std::size_t at = 0, bytes = 4;
};

TiffValue tiff_value(const ByteNumbers& numbers, std::uint64_t tag) {
  const TiffLayout layout = tiff_layout(numbers);
  const std::size_t entries = tiff_directory(numbers) + layout.count_bytes;
  for (std::uint64_t i = 0; i < tiff_entries(numbers); ++i) {
    const std::size_t entry = entries + i * layout.entry_bytes;
    if (numbers.at(entry, 2) != tag) continue;
    constexpr unsigned two_bytes = 3, eight_bytes = 16;
    const std::uint64_t type = numbers.at(entry + 2, 2);
    return {entry + 4 + layout.offset_bytes, type == two_bytes     ? 2u
                                             : type == eight_bytes ? 8u
                                                                   : 4u};
  }
  return {};
}

std::uint64_t tiff_number(const ByteNumbers& numbers, std::uint64_t tag, std::uint64_t otherwise) {
  const TiffValue value = tiff_value(numbers, tag);
  return value.at == 0 ? otherwise : numbers.at(value.at, value.bytes);
}

constexpr unsigned bits_tag = 258, colours_tag = 262, channels_tag = 277, format_tag = 339;
constexpr unsigned whole_numbers = 1;  // a value of the last

}  // namespace

bool is_tiff(std::string_view bytes) {
  const ByteNumbers numbers = numbers_of(bytes);
  return (bytes.starts_with("MM") || bytes.starts_with("II")) &&
         (numbers.at(2, 2) == 42 || numbers.at(2, 2) == 43);
}

StatedSize tiff_size(std::string_view bytes) {
  const ByteNumbers numbers = numbers_of(bytes);
  constexpr unsigned width_tag = 256, height_tag = 257;
  return {tiff_number(numbers, width_tag, 0), tiff_number(numbers, height_tag, 0)};
}

std::string tiff_trouble(std::string_view bytes) {
  const ByteNumbers numbers = numbers_of(bytes);
  constexpr unsigned real = 3, mosaic = 32803, linear_raw = 34892;
  const std::uint64_t colours = tiff_number(numbers, colours_tag, 1);
  if (colours == mosaic || colours == linear_raw)
    return "TIFF with the raw values of a sensor (photometric interpretation " +
           std::to_string(colours) + ")";
  // Of several channels the number is a place in the file.
  if (tiff_number(numbers, channels_tag, 1) != 1) return "";
  const std::uint64_t bits = tiff_number(numbers, bits_tag, 1),
                      format = tiff_number(numbers, format_tag, whole_numbers);
  if (format == real && bits == 16) return "TIFF with real numbers of 16 bit";
  if (format == whole_numbers && bits > 16)
    return "TIFF with whole numbers of " + std::to_string(bits) + " bit";
  return "";
}

std::optional<int> black_of_inverted(std::string_view bytes) {
  if (!is_tiff(bytes)) return {};
  const ByteNumbers numbers = numbers_of(bytes);
  const std::uint64_t bits = tiff_number(numbers, bits_tag, 1);
  if (tiff_number(numbers, colours_tag, 1) != 0 || tiff_number(numbers, channels_tag, 1) != 1 ||
      tiff_number(numbers, format_tag, whole_numbers) != whole_numbers || bits <= 8 || bits > 16)
    return {};
  return (1 << bits) - 1;
}

std::string as_stored(const std::string& bytes) {
  constexpr unsigned orientation_tag = 274;
  if (!is_tiff(bytes)) return bytes;
  const bool big_endian = bytes.starts_with("MM");
  const TiffValue value = tiff_value({bytes, big_endian}, orientation_tag);
  if (value.at == 0 || value.at + value.bytes > bytes.size()) return bytes;
  std::string stored = bytes;
  for (std::size_t i = 0; i < value.bytes; ++i)
    stored[value.at + i] = i == (big_endian ? value.bytes - 1 : 0) ? '\1' : '\0';
  return stored;
}

bool has_more_pages(std::string_view bytes) {
  if (!is_tiff(bytes)) return false;
  const ByteNumbers numbers = numbers_of(bytes);
  const TiffLayout layout = tiff_layout(numbers);
  const std::size_t next_at =
      tiff_directory(numbers) + layout.count_bytes + tiff_entries(numbers) * layout.entry_bytes;
  return numbers.at(next_at, layout.offset_bytes) != 0;
}

}  // namespace edgescout
