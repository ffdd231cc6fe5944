#include <cstring>
#include <map>

#include "host/io/binary_file.h"
#include "kernels/error.h"
#include "tests/fuzz/memory_limit.h"
#include "tests/fuzz/readers.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {

namespace {

// Of BinaryReader: eight bytes that name the kind, four for the version; length; checksum.
constexpr std::size_t length_at = 12, checksum_at = 20, payload_at = 28;

void set_length_and_checksum(std::string& bytes) {
  if (bytes.size() < payload_at) return;
  const std::uint64_t length = bytes.size() - payload_at,
                      sum = checksum(std::string_view(bytes).substr(payload_at));
  std::memcpy(bytes.data() + length_at, &length, sizeof length);
  std::memcpy(bytes.data() + checksum_at, &sum, sizeof sum);
}

// The same for all inputs: a folder a time would take longer than most readers.
const TemporaryFolder& folder_of(const FuzzedReader& reader) {
  static std::map<std::string, TemporaryFolder> folders;
  return folders[reader.name];
}

}  // namespace

void read_bytes(const FuzzedReader& reader, std::span<const std::uint8_t> bytes) {
  std::string content(bytes.begin(), bytes.end());
  if (reader.has_checksum) set_length_and_checksum(content);
  const std::filesystem::path file = folder_of(reader).path() / reader.file_name;
  std::ofstream(file, std::ios::binary) << content;
  try {
    const MemoryLimit limit(64 * content.size() + (std::size_t{64} << 20));
    reader.read(file);
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.find(reader.file_name) == std::string::npos)
      throw LogicError("a refusal that does not name the file: " + message);
    if (message.find('\n') != std::string::npos)
      throw LogicError("a refusal of several lines: " + message);
  }
}

}  // namespace edgescout::test
