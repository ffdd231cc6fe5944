#include "host/io/binary_file.h"

#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ull;
  return hash;
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
  if (count > bytes_.size() / element_bytes)
    throw InputError(source_, "payload", "a list longer than the file",
                     std::string("a whole ") + name_);
  return count;
}

const char* BinaryReader::take(std::size_t size) {
  if (size > bytes_.size())
    throw InputError(source_, "payload", "fewer bytes than its lists need",
                     std::string("a whole ") + name_);
  const char* at = bytes_.data();
  bytes_.remove_prefix(size);
  return at;
}

void write_binary_file(const std::filesystem::path& file, const BinaryFormat& format,
                       std::string_view payload) {
  BinaryWriter out;
  out.put(format.magic);
  out.put(format.version);
  out.put(static_cast<std::uint64_t>(payload.size()));
  out.put(checksum(payload));
  out.bytes.append(payload);
  write_file_atomically(file, out.bytes);
}

std::string read_binary_file(const std::filesystem::path& file, const BinaryFormat& format) {
  std::string bytes = read_file(file);
  constexpr std::size_t header =
      sizeof format.magic + sizeof format.version + 2 * sizeof(std::uint64_t);
  const std::string whole = std::string("a whole ") + format.name;
  if (!bytes.starts_with(std::string_view(format.magic.data(), format.magic.size())))
    throw InputError(file.string(), "magic", "another kind of file",
                     std::string("a ") + format.name);
  if (bytes.size() < header)
    throw InputError(file.string(), "header", std::to_string(bytes.size()) + " bytes", whole);
  BinaryReader in(std::string_view(bytes).substr(format.magic.size()), file.string(), format.name);
  if (const auto found = in.get<std::uint32_t>(); found != format.version)
    throw InputError(file.string(), "version", std::to_string(found),
                     std::to_string(format.version));
  const auto size = in.get<std::uint64_t>();
  const auto expected = in.get<std::uint64_t>();
  std::string payload = bytes.substr(header);
  if (payload.size() != size)
    throw InputError(file.string(), "length", std::to_string(payload.size()) + " bytes",
                     std::to_string(size) + " bytes");
  if (checksum(payload) != expected)
    throw InputError(file.string(), "checksum", "another one", "the one in the header");
  return payload;
}

}  // namespace edgescout
