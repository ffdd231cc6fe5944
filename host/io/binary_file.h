// Internal to host: reads and writes the project's own binary files.
//
// A file has a header (magic, version, length, checksum) that is checked before the payload is
// read. The payload is plain little-endian numbers.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "host/core/se3.h"
#include "host/io/files.h"

namespace edgescout {

// Identifies one kind of file.
struct BinaryFormat {
  std::array<char, 8> magic;
  std::uint32_t version;
  const char* name;  // "a template file", for errors
};

class BinaryWriter {
 public:
  template <typename T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <typename T>
  void put_list(const std::vector<T>& list) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(static_cast<std::uint64_t>(list.size()));
    bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes.append(text);
  }
  void put_rotation(const Eigen::Quaterniond& rotation) {
    for (double v : {rotation.w(), rotation.x(), rotation.y(), rotation.z()}) put(v);
  }
  void put_point(const Eigen::Vector3d& point) {
    for (int i = 0; i < 3; ++i) put(point[i]);
  }
  void put_pose(const Se3& pose) {
    put_rotation(pose.rotation);
    put_point(pose.translation_m);
  }
  std::string bytes;
};

// Reads the payload of a file piece by piece, each straight to its place: a large file takes no
// memory besides what is made of it. Throws InputError naming the file where a list is longer than
// the rest of the file.
class BinaryReader {
 public:
  // Opens the file, reads it once to compare its checksum, and goes back to the payload. InputError
  // naming the file: it is cut short, of another version or another kind, its checksum is wrong, or
  // it is no file that can be read twice.
  BinaryReader(const std::filesystem::path& file, const BinaryFormat& format);
  // The same of an open file. `source` is its name in errors.
  BinaryReader(std::ifstream stream, std::string source, const BinaryFormat& format);
  template <typename T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    take(&value, sizeof value);
    return value;
  }
  template <typename T>
  std::vector<T> get_list() {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> list(count(sizeof(T)));
    take(list.data(), list.size() * sizeof(T));
    return list;
  }
  std::string get_text() {
    std::string text(count(1), '\0');
    take(text.data(), text.size());
    return text;
  }
  Eigen::Quaterniond get_rotation();
  Se3 get_pose();
  // Reads the number of elements that follow. Each takes at least `element_bytes`.
  std::size_t count(std::size_t element_bytes);
  bool at_end() const { return remaining_ == 0; }

 private:
  void take(void* to, std::size_t size);
  // Returns the checksum of the payload that the header states.
  std::uint64_t read_header(const BinaryFormat& format);
  std::uint64_t checksum_of_rest();

  std::ifstream stream_;
  std::uint64_t remaining_ = 0;  // bytes
  std::string source_, whole_;   // of errors
};

// FNV-1a, 64 bit. `before` is the checksum of what precedes the bytes.
std::uint64_t checksum(std::string_view bytes, std::uint64_t before = 14695981039346656037u);

// Writes header and payload atomically.
void write_binary_file(const std::filesystem::path& file, const BinaryFormat& format,
                       std::string_view payload, Flush flush = Flush::Yes);

}  // namespace edgescout
