// Reads and writes whole files safely.
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace edgescout {

// InputError naming the file: it is missing or unreadable.
std::ifstream open_file(const std::filesystem::path& file);
std::string read_file(const std::filesystem::path& file);

// Whether a written file is waited for until it is on the disk. Where it is not, a crash of the
// system can leave a file without its content.
enum class Flush { Yes, No };

// Writes a temporary file in the same folder, flushes it and renames it. A reader sees the old file
// or the whole new one. InputError naming the file and the system's reason (full disk, no
// permission); then no temporary file remains.
void write_file_atomically(const std::filesystem::path& file, std::string_view content,
                           Flush flush = Flush::Yes);
// The same of a content in parts, one after the other.
void write_parts_atomically(const std::filesystem::path& file,
                            std::initializer_list<std::string_view> parts, Flush flush);

class TemporaryFile;  // files.cpp

// The same of a content that is made part by part and does not fit into memory. A file that is not
// finished leaves nothing behind.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path file);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();
  void write(std::string_view part);
  void finish(Flush flush = Flush::Yes);

 private:
  std::filesystem::path file_;
  std::unique_ptr<TemporaryFile> temporary_;
};

// Removes the results of an earlier run, so that nobody mistakes them for those of the next run.
// Missing files are ignored. InputError naming the file that cannot be removed.
void remove_earlier_files(std::span<const std::filesystem::path> files);

// Checks that the folder can be written. If it does not exist, checks its nearest existing parent.
// Leaves no file behind. InputError: it cannot be written.
void require_writable_place(const std::filesystem::path& folder);

// Removes temporary files (.NAME.part) that killed runs have left in the folder. Those that another
// run writes now stay. Younger ones than `least_age` stay too: one may be about to be locked.
void remove_abandoned_files(const std::filesystem::path& folder,
                            std::chrono::seconds least_age = std::chrono::seconds(10));

// Creates the folder (and parents), checks that a file can be written in it, and calls
// remove_abandoned_files. InputError: the folder cannot be created or written.
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace edgescout
