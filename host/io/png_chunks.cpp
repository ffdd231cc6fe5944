#include "host/io/png_chunks.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "host/io/byte_numbers.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
constexpr const char* whole_png = "a whole PNG file";

// PNG's checksum, of the name and the content of a chunk (CRC-32 of ISO 3309).
class Checksum {
 public:
  constexpr Checksum() {
    for (std::uint32_t byte = 0; byte < table_.size(); ++byte) {
      std::uint32_t rest = byte;
      for (int bit = 0; bit < 8; ++bit) rest = rest % 2 ? polynomial ^ rest / 2 : rest / 2;
      table_[byte] = rest;
    }
  }
  std::uint32_t of(std::string_view bytes) const {
    std::uint32_t rest = ~std::uint32_t{0};
    for (const unsigned char byte : bytes) rest = table_[(rest ^ byte) & 0xff] ^ rest >> 8;
    return ~rest;
  }

 private:
  static constexpr std::uint32_t polynomial = 0xedb88320;
  std::array<std::uint32_t, 256> table_{};
};

constexpr Checksum chunk_checksum;

struct Chunk {
  std::string_view name, all;  // with its length and its checksum
};

std::string shown(std::string_view name) {
  std::string text(name);
  std::ranges::replace_if(
      text, [](unsigned char c) { return !std::isalnum(c); }, '?');
  return text;
}

Chunk chunk_at(std::string_view bytes, std::size_t at, const std::string& source) {
  constexpr std::size_t frame = 12;  // length, name and checksum
  const ByteNumbers numbers{bytes};
  const std::uint64_t length = numbers.at(at, 4);
  if (at + frame + length > bytes.size())
    throw InputError(source, "image", "a file cut short", whole_png);
  const Chunk chunk{bytes.substr(at + 4, 4), bytes.substr(at, frame + length)};
  if (chunk_checksum.of(bytes.substr(at + 4, 4 + length)) != numbers.at(at + 8 + length, 4))
    throw InputError(source, "image", "damaged bytes in the chunk " + shown(chunk.name), whole_png);
  return chunk;
}

}  // namespace

std::string needed_png_chunks(const std::string& bytes, const std::string& source) {
  if (!bytes.starts_with(signature))
    throw InputError(source, "image", "damaged first bytes, as by a transfer of text", whole_png);
  std::string needed(signature);
  needed.reserve(bytes.size());
  bool has_pixels = false, has_end = false;
  for (std::size_t at = signature.size(); !has_end;) {
    const Chunk chunk = chunk_at(bytes, at, source);
    at += chunk.all.size();
    // Names of chunks that a decoder may skip begin with a small letter.
    if (std::islower(static_cast<unsigned char>(chunk.name[0])) && chunk.name != "tRNS") continue;
    constexpr std::string_view known[] = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
    if (std::ranges::find(known, chunk.name) == std::end(known))
      throw InputError(source, "image", "the chunk " + shown(chunk.name),
                       "the chunks of PNG's standard");
    has_pixels = has_pixels || chunk.name == "IDAT";
    has_end = chunk.name == "IEND";
    needed += chunk.all;
  }
  if (!has_pixels) throw InputError(source, "image", "no pixels (chunk IDAT)", whole_png);
  return needed;
}

std::string png_chunk(const std::string& name, const std::string& content) {
  const auto big_endian = [](std::size_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
    return bytes;
  };
  const std::string named = name + content;
  return big_endian(content.size()) + named + big_endian(chunk_checksum.of(named));
}

}  // namespace edgescout
