#include "host/io/binary_file.h"

#include <algorithm>

#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

std::uint64_t checksum(std::string_view bytes, std::uint64_t before) {
  std::uint64_t hash = before;
  for (unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ull;
  return hash;
}

BinaryReader::BinaryReader(const std::filesystem::path& file, const BinaryFormat& format)
    : BinaryReader(open_file(file), file.string(), format) {}

BinaryReader::BinaryReader(std::ifstream stream, std::string source, const BinaryFormat& format)
    : stream_(std::move(stream)),
      source_(std::move(source)),
      whole_(std::string("a whole ") + format.name) {
  stream_.seekg(0, std::ios::end);
  const std::streamoff bytes = stream_.tellg();
  stream_.seekg(0);
  if (!stream_)
    throw InputError(source_, "file", "one that can be read only once", "a file on a disk");
  remaining_ = static_cast<std::uint64_t>(bytes);
  const std::uint64_t expected = read_header(format), payload = remaining_;
  const std::streamoff start = stream_.tellg();
  if (checksum_of_rest() != expected)
    throw InputError(source_, "checksum", "another one", "the one in the header");
  stream_.seekg(start);
  remaining_ = payload;
}

std::uint64_t BinaryReader::read_header(const BinaryFormat& format) {
  const std::uint64_t bytes = remaining_;
  constexpr std::size_t header =
      sizeof format.magic + sizeof format.version + 2 * sizeof(std::uint64_t);
  if (bytes < sizeof format.magic || get<decltype(format.magic)>() != format.magic)
    throw InputError(source_, "magic", "another kind of file", std::string("a ") + format.name);
  if (bytes < header) throw InputError(source_, "header", std::to_string(bytes) + " bytes", whole_);
  if (const auto found = get<std::uint32_t>(); found != format.version)
    throw InputError(source_, "version", std::to_string(found), std::to_string(format.version));
  const auto size = get<std::uint64_t>();
  const auto expected = get<std::uint64_t>();
  if (remaining_ != size)
    throw InputError(source_, "length", std::to_string(remaining_) + " bytes",
                     std::to_string(size) + " bytes");
  return expected;
}

std::uint64_t BinaryReader::checksum_of_rest() {
  std::uint64_t sum = checksum({});
  std::array<char, 1 << 16> piece;
  while (remaining_ > 0) {
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(remaining_, piece.size()));
    take(piece.data(), size);
    sum = checksum({piece.data(), size}, sum);
  }
  return sum;
}

Eigen::Quaterniond BinaryReader::get_rotation() {
  const double w = get<double>(), x = get<double>(), y = get<double>(), z = get<double>();
  return Eigen::Quaterniond(w, x, y, z);
}

Se3 BinaryReader::get_pose() {
  Se3 pose{get_rotation(), {}};
  for (int i = 0; i < 3; ++i) pose.translation_m[i] = get<double>();
  return pose;
}

std::size_t BinaryReader::count(std::size_t element_bytes) {
  const std::uint64_t count = get<std::uint64_t>();
  if (count > remaining_ / element_bytes)
    throw InputError(source_, "payload", "a list longer than the file", whole_);
  return count;
}

void BinaryReader::take(void* to, std::size_t size) {
  if (size > remaining_)
    throw InputError(source_, "payload", "fewer bytes than its lists need", whole_);
  if (!stream_.read(static_cast<char*>(to), static_cast<std::streamsize>(size)))
    throw InputError(source_, "file", "a read error", "a readable file");
  remaining_ -= size;
}

void write_binary_file(const std::filesystem::path& file, const BinaryFormat& format,
                       std::string_view payload, Flush flush) {
  BinaryWriter header;
  header.put(format.magic);
  header.put(format.version);
  header.put(static_cast<std::uint64_t>(payload.size()));
  header.put(checksum(payload));
  write_parts_atomically(file, {header.bytes, payload}, flush);
}

}  // namespace edgescout
