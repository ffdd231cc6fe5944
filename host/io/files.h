// Whole files, read and written safely.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace edgescout {

// InputError naming the file where it is missing or unreadable.
std::string read_file(const std::filesystem::path& file);

// Writes beside the target, flushes and renames: a reader sees the old file or the whole new one.
// InputError naming the file and the system's reason (full disk, no permission); nothing is left
// behind then.
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

// Results of an earlier run, which must not be taken for those of the next; one that is not there
// is none. InputError naming the file that cannot be removed.
void remove_earlier_files(std::span<const std::filesystem::path> files);

// Proves that the folder, or while it is not there its nearest parent, can be written, and leaves
// nothing in it; InputError otherwise.
void require_writable_place(const std::filesystem::path& folder);

// Creates the folder (and parents) and proves that a file can be written in it; InputError
// otherwise.
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace edgescout
