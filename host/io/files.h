// Reads and writes whole files safely.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace edgescout {

// InputError naming the file: it is missing or unreadable.
std::string read_file(const std::filesystem::path& file);

// Writes a temporary file in the same folder, flushes it and renames it. A reader sees the old file
// or the whole new one. InputError naming the file and the system's reason (full disk, no
// permission); then no temporary file remains.
void write_file_atomically(const std::filesystem::path& file, std::string_view content);

// Removes the results of an earlier run, so that nobody mistakes them for those of the next run.
// Missing files are ignored. InputError naming the file that cannot be removed.
void remove_earlier_files(std::span<const std::filesystem::path> files);

// Checks that the folder can be written. If it does not exist, checks its nearest existing parent.
// Leaves no file behind. InputError: it cannot be written.
void require_writable_place(const std::filesystem::path& folder);

// Creates the folder (and parents), checks that a file can be written in it, and removes temporary
// files (.NAME.part) that killed runs have left there. InputError: the folder cannot be created or
// written.
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace edgescout
