// Internal to host: keeps results that can be computed again as files of one folder.
//
// An entry is a file named by the SHA-256 of its key. It holds the whole key, which is compared, so
// no other key's entry is ever read. Several programs may use a folder at the same time: entries
// appear and disappear as a whole. No fault of the folder is an error: an entry that cannot be used
// is as none, and one that cannot be written is not kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

#include "host/io/binary_file.h"

namespace edgescout {

class FileCache {
 public:
  // Without a folder (an empty path) nothing is kept. The folder is made with the first entry. Its
  // entries take at most `max_bytes`.
  FileCache(std::filesystem::path folder, const BinaryFormat& format, std::uint64_t max_bytes);

  // Calls `get` with what was written with this key, and marks the entry as used now. Returns
  // false where there is no entry, or where it is damaged or that of another key, which is logged
  // as a warning. An InputError of `get` means such damage; what it read must then be dropped.
  bool read(std::string_view key, const std::function<void(BinaryReader&)>& get) const;

  // Writes what `put` puts in place of the entry with this key. Removes the least recently used
  // entries that exceed the limit, and what killed programs left. Logs the first failure as a
  // warning.
  void write(std::string_view key, const std::function<void(BinaryWriter&)>& put);

  std::filesystem::path file_of(std::string_view key) const;

 private:
  void remove_least_recently_used() const;

  std::filesystem::path folder_;
  BinaryFormat format_;
  std::uint64_t max_bytes_;
  bool has_warned_ = false;
};

}  // namespace edgescout
