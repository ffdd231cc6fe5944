// Internal to host: reads and writes the project's own binary files.
//
// A file has a header (magic, version, length, checksum) that is checked before the payload is
// read. The payload is plain little-endian numbers.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "host/core/se3.h"

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

// Throws InputError naming the file where a list is longer than the rest of the file.
class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, std::string source, const char* name)
      : bytes_(bytes), source_(std::move(source)), name_(name) {}
  template <typename T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  template <typename T>
  std::vector<T> get_list() {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> list(count(sizeof(T)));
    if (!list.empty())
      std::memcpy(list.data(), take(list.size() * sizeof(T)), list.size() * sizeof(T));
    return list;
  }
  std::string get_text() {
    const std::size_t size = count(1);
    return {take(size), size};
  }
  Eigen::Quaterniond get_rotation();
  Se3 get_pose();
  // Reads the number of elements that follow. Each takes at least `element_bytes`.
  std::size_t count(std::size_t element_bytes);
  bool at_end() const { return bytes_.empty(); }

 private:
  const char* take(std::size_t size);
  std::string_view bytes_;
  std::string source_;
  const char* name_;
};

// FNV-1a, 64 bit.
std::uint64_t checksum(std::string_view bytes);

// Writes header and payload atomically.
void write_binary_file(const std::filesystem::path& file, const BinaryFormat& format,
                       std::string_view payload);
// Returns the payload. InputError naming the file: it is cut short, of another version or another
// kind, or its checksum is wrong.
std::string read_binary_file(const std::filesystem::path& file, const BinaryFormat& format);

}  // namespace edgescout
