#include "host/io/file_cache.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <functional>
#include <utility>
#include <vector>

#include "host/core/log.h"
#include "host/io/files.h"
#include "host/io/sha256.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view entry_extension = ".cached";

// Files of other names in the folder are not the cache's: they are neither counted nor removed.
bool is_entry_name(const std::string& name) {
  return name.size() == 64 + entry_extension.size() && name.ends_with(entry_extension) &&
         name.find_first_not_of("0123456789abcdef") == 64;
}

struct CacheEntry {
  fs::path file;
  std::uint64_t bytes = 0;
  fs::file_time_type used;
};

// Another program may remove an entry at any time: such a one is left out.
std::vector<CacheEntry> cache_entries(const fs::path& folder) {
  std::vector<CacheEntry> entries;
  std::error_code failure;
  for (fs::directory_iterator file(folder, failure), end; !failure && file != end;
       file.increment(failure)) {
    std::error_code gone;
    if (!is_entry_name(file->path().filename().string()) || !file->is_regular_file(gone)) continue;
    CacheEntry entry{file->path(), file->file_size(gone), {}};
    if (!gone) entry.used = file->last_write_time(gone);
    if (!gone) entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace

FileCache::FileCache(fs::path folder, const BinaryFormat& format, std::uint64_t max_bytes)
    : folder_(std::move(folder)), format_(format), max_bytes_(max_bytes) {}

fs::path FileCache::file_of(std::string_view key) const {
  return folder_ / (sha256_hex(key) + std::string(entry_extension));
}

bool FileCache::read(std::string_view key, const std::function<void(BinaryReader&)>& get) const {
  if (folder_.empty()) return false;
  const fs::path file = file_of(key);
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  std::ifstream stream(file, std::ios::binary);
  if (!stream && errno == ENOENT) return false;  // another program has removed it just now
  try {
    BinaryReader in(std::move(stream), file.string(), format_);
    if (in.get_text() != key)
      throw InputError(file.string(), "key", "another one", "the one that its name is of");
    get(in);
    if (!in.at_end()) throw InputError(file.string(), "payload", "more than an entry", "one entry");
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
    return true;
  } catch (const InputError& error) {
    log(LogLevel::Warning, std::string(error.what()) + "; it is made anew");
    return false;
  }
}

void FileCache::write(std::string_view key, const std::function<void(BinaryWriter&)>& put) {
  if (folder_.empty()) return;
  BinaryWriter out;
  out.put_text(key);
  put(out);
  if (out.bytes.size() > max_bytes_) return;
  try {
    std::error_code failure;
    fs::create_directories(folder_, failure);
    if (failure)
      throw InputError(folder_.string(), "cache folder", failure.message(),
                       "a folder that can be created");
    remove_abandoned_files(folder_);
    // A checksum tells a file that a crash of the system left without its content.
    write_binary_file(file_of(key), format_, out.bytes, Flush::No);
  } catch (const InputError& error) {
    if (!has_warned_) log(LogLevel::Warning, std::string(error.what()) + "; nothing is kept there");
    has_warned_ = true;
  }
  remove_least_recently_used();
}

void FileCache::remove_least_recently_used() const {
  std::vector<CacheEntry> entries = cache_entries(folder_);
  std::ranges::sort(entries, std::greater{}, &CacheEntry::used);
  std::uint64_t total = 0;
  for (const CacheEntry& entry : entries) {
    total += entry.bytes;
    std::error_code ignored;
    if (total > max_bytes_) fs::remove(entry.file, ignored);
  }
}

}  // namespace edgescout
