#include "host/io/image_header.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "host/io/byte_numbers.h"
#include "host/io/tiff_header.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

using MaybeSize = std::optional<StatedSize>;

constexpr std::size_t searched_bytes = 4096;  // within which text headers are searched

MaybeSize size_at(const ByteNumbers& numbers, std::size_t width_at, std::size_t height_at,
                  std::size_t bytes_each) {
  if (std::max(width_at, height_at) + bytes_each > numbers.bytes.size()) return {};
  return StatedSize{numbers.at(width_at, bytes_each), numbers.at(height_at, bytes_each)};
}

// Words between blanks; from a # to the end of its line there is none.
class HeaderWords {
 public:
  explicit HeaderWords(std::string_view text) : text_(text.substr(0, searched_bytes)) {}
  std::string_view next() {
    const auto is_blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#')) {
      if (text_[at_] == '#') at_ = std::min(text_.find('\n', at_), text_.size());
      if (at_ < text_.size()) ++at_;
    }
    const std::size_t start = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }
  // 0: no number.
  std::uint64_t number() {
    const std::string_view word = next();
    std::uint64_t value = 0;
    std::from_chars(word.data(), word.data() + word.size(), value);
    return value;
  }
  std::size_t end() const { return at_; }  // of the last word

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

MaybeSize portable_size(std::string_view bytes) {
  HeaderWords words(bytes);
  const std::string_view kind = words.next();
  StatedSize size;
  if (kind != "P7") {
    size.width = words.number();
    size.height = words.number();
    return size;
  }
  for (std::string_view word = words.next(); !word.empty() && word != "ENDHDR"; word = words.next())
    if (word == "WIDTH")
      size.width = words.number();
    else if (word == "HEIGHT")
      size.height = words.number();
  return size;
}

// Of portable files with binary whole numbers.
struct PortableLayout {
  std::uint64_t pixels = 0, channels = 1, white = 255;
  std::size_t pixels_at = 0;
};

std::optional<PortableLayout> portable_layout(std::string_view bytes) {
  HeaderWords words(bytes);
  const std::string_view kind = words.next();
  PortableLayout layout;
  if (kind == "P5" || kind == "P6") {
    layout.channels = kind == "P5" ? 1 : 3;
    layout.pixels = words.number() * words.number();
    layout.white = words.number();
  } else if (kind == "P7") {
    const MaybeSize size = portable_size(bytes);
    layout.pixels = size->width * size->height;
    for (std::string_view word = words.next(); word != "ENDHDR"; word = words.next()) {
      if (word.empty()) return {};
      if (word == "DEPTH") layout.channels = words.number();
      if (word == "MAXVAL") layout.white = words.number();
    }
  } else {
    return {};
  }
  layout.pixels_at = words.end() + 1;
  return layout;
}

// "-Y 480 +X 640" after the lines of Radiance's header.
MaybeSize radiance_size(std::string_view bytes) {
  HeaderWords words(bytes);
  StatedSize size;
  for (std::string_view word = words.next(); !word.empty(); word = words.next())
    if (word == "-Y" || word == "+Y")
      size.height = words.number();
    else if (word == "+X" || word == "-X")
      size.width = words.number();
  return size;
}

MaybeSize jpeg_size(const ByteNumbers& numbers) {
  const std::string_view bytes = numbers.bytes;
  for (std::size_t at = 2; at + 4 <= bytes.size() && bytes[at] == '\xff';) {
    const std::uint64_t mark = numbers.at(at + 1, 1);
    constexpr unsigned fill = 0xff, scan = 0xda;
    if (mark == fill) {
      ++at;
      continue;
    }
    // The marks of frames, less those of tables among them.
    if (mark >= 0xc0 && mark <= 0xcf && mark != 0xc4 && mark != 0xc8 && mark != 0xcc)
      return size_at(numbers, at + 7, at + 5, 2);
    if (mark == scan) return {};
    at += 2 + numbers.at(at + 2, 2);
  }
  return {};
}

MaybeSize bmp_size(const ByteNumbers& numbers) {
  constexpr std::size_t info_at = 14;
  constexpr unsigned oldest_info = 12;
  if (numbers.at(info_at, 4) == oldest_info) return size_at(numbers, 18, 20, 2);
  MaybeSize size = size_at(numbers, 18, 22, 4);
  constexpr std::uint64_t sign = 0x80000000, range = 0x100000000;
  if (size && size->height >= sign) size->height = range - size->height;  // rows from the top
  return size;
}

// Where the pixels of an uncompressed file end.
std::uint64_t bmp_end(const ByteNumbers& numbers) {
  constexpr unsigned oldest_info = 12;
  const MaybeSize size = bmp_size(numbers);
  if (!size || size->height == 0 || numbers.at(14, 4) == oldest_info || numbers.at(30, 4) != 0)
    return 0;
  const std::uint64_t row_bits = size->width * numbers.at(28, 2);
  return numbers.at(10, 4) + (row_bits + 31) / 32 * 4 * (size->height - 1) + (row_bits + 7) / 8;
}

MaybeSize webp_size(const ByteNumbers& numbers) {
  const std::string_view kind =
      numbers.bytes.substr(std::min<std::size_t>(12, numbers.bytes.size()), 4);
  MaybeSize size;
  if (kind == "VP8X" && (size = size_at(numbers, 24, 27, 3))) {
    ++size->width;  // stored less one
    ++size->height;
  } else if (kind == "VP8L" && numbers.bytes.size() >= 25) {
    const std::uint64_t bits = numbers.at(21, 4), mask = 0x3fff;
    size = {(bits & mask) + 1, (bits >> 14 & mask) + 1};
  } else if (kind == "VP8 " && (size = size_at(numbers, 26, 28, 2))) {
    size->width &= 0x3fff;  // two bits say how to scale it
    size->height &= 0x3fff;
  }
  return size;
}

MaybeSize jpeg_2000_size(const ByteNumbers& numbers) {
  constexpr std::size_t codestream_size_at = 8;
  if (numbers.bytes.starts_with("\xff\x4f"))
    return size_at(numbers, codestream_size_at, codestream_size_at + 4, 4);
  const std::size_t box = numbers.bytes.substr(0, searched_bytes).find("ihdr");
  if (box == std::string_view::npos) return {};
  return size_at(numbers, box + 8, box + 4, 4);
}

MaybeSize exr_size(const ByteNumbers& numbers) {
  constexpr std::string_view window("dataWindow\0box2i\0", 17);
  const std::size_t found = numbers.bytes.substr(0, 16 * searched_bytes).find(window);
  if (found == std::string_view::npos) return {};
  const std::size_t corners = found + window.size() + 4;  // after the length of what follows
  if (corners + 16 > numbers.bytes.size()) return {};
  std::array<std::int64_t, 4> window_px;
  for (std::size_t i = 0; i < window_px.size(); ++i)
    window_px[i] = static_cast<std::int32_t>(numbers.at(corners + 4 * i, 4));
  const auto span = [&](std::size_t from, std::size_t to) {
    return static_cast<std::uint64_t>(
        std::max<std::int64_t>(0, window_px[to] - window_px[from] + 1));
  };
  return StatedSize{span(0, 2), span(1, 3)};
}

enum class Kind {
  Unknown,
  Png,
  Jpeg,
  Bmp,
  Tiff,
  Webp,
  Jpeg2000,
  Exr,
  SunRaster,
  Radiance,
  Portable
};

bool is_portable(std::string_view bytes) {
  constexpr std::string_view kinds = "123456Ff";
  if (bytes.starts_with("P7\n")) return true;
  if (bytes.size() < 3 || bytes[0] != 'P' || kinds.find(bytes[1]) == std::string_view::npos)
    return false;
  HeaderWords words(bytes);
  return words.next().size() == 2 && words.number() > 0;
}

Kind kind_of(std::string_view bytes) {
  constexpr std::string_view jpeg_2000_box("\0\0\0\x0cjP  ", 8), reserved("\0\0\0\0", 4);
  const auto at = [&](std::size_t from) { return bytes.substr(std::min(from, bytes.size()), 4); };
  if (bytes.starts_with("\x89PNG")) return Kind::Png;
  if (bytes.starts_with("\xff\xd8\xff")) return Kind::Jpeg;
  if (bytes.starts_with("BM") && at(6) == reserved) return Kind::Bmp;
  if (is_tiff(bytes)) return Kind::Tiff;
  if (bytes.starts_with("RIFF") && at(8) == "WEBP") return Kind::Webp;
  if (bytes.starts_with(jpeg_2000_box) || bytes.starts_with("\xff\x4f\xff\x51"))
    return Kind::Jpeg2000;
  if (bytes.starts_with("\x76\x2f\x31\x01")) return Kind::Exr;
  if (bytes.starts_with("\x59\xa6\x6a\x95")) return Kind::SunRaster;
  if (bytes.starts_with("#?RADIANCE") || bytes.starts_with("#?RGBE")) return Kind::Radiance;
  return is_portable(bytes) ? Kind::Portable : Kind::Unknown;
}

}  // namespace

bool begins_as_image(std::string_view bytes) { return kind_of(bytes) != Kind::Unknown; }

std::string text_of_size(const StatedSize& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

void require_size(const StatedSize& size, const std::string& source) {
  constexpr std::uint64_t max_side_px = 1 << 20;  // OpenCV's
  constexpr std::uint64_t max_pixels = 1 << 28;   // 256 MiB for each byte of a pixel
  if (std::max(size.width, size.height) > max_side_px || size.width * size.height > max_pixels)
    throw InputError(source, "image size", text_of_size(size),
                     "at most " + std::to_string(max_pixels) + " pixels and sides of at most " +
                         std::to_string(max_side_px));
}

std::optional<StatedSize> stated_size(std::string_view bytes) {
  const ByteNumbers big{bytes, true}, little{bytes, false};
  switch (kind_of(bytes)) {
    case Kind::Png:
      return size_at(big, 16, 20, 4);
    case Kind::Jpeg:
      return jpeg_size(big);
    case Kind::Bmp:
      return bmp_size(little);
    case Kind::Tiff:
      return tiff_size(bytes);
    case Kind::Webp:
      return webp_size(little);
    case Kind::Jpeg2000:
      return jpeg_2000_size(big);
    case Kind::Exr:
      return exr_size(little);
    case Kind::SunRaster:
      return size_at(big, 4, 8, 4);
    case Kind::Radiance:
      return radiance_size(bytes);
    case Kind::Portable:
      return portable_size(bytes);
    case Kind::Unknown:
      break;
  }
  return {};
}

std::uint64_t stated_bytes(std::string_view bytes) {
  const Kind kind = kind_of(bytes);
  if (kind == Kind::Bmp) return bmp_end({bytes, false});
  const auto layout = kind == Kind::Portable ? portable_layout(bytes) : std::nullopt;
  if (!layout) return 0;
  return layout->pixels_at + layout->pixels * layout->channels * (layout->white > 255 ? 2 : 1);
}

std::optional<double> stated_white(std::string_view bytes) {
  const auto layout = kind_of(bytes) == Kind::Portable ? portable_layout(bytes) : std::nullopt;
  constexpr std::uint64_t largest = 65535;
  if (!layout || layout->white == 0 || layout->white == 255 || layout->white >= largest) return {};
  return static_cast<double>(layout->white);
}

std::string undecodable(std::string_view bytes) {
  const Kind kind = kind_of(bytes);
  if (kind == Kind::Tiff) return tiff_trouble(bytes);
  return kind == Kind::Unknown && !bytes.starts_with("BM") ? "data that no image decoder accepts"
                                                           : "";
}

}  // namespace edgescout
