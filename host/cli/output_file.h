// The file that a verb writes in place of a folder of results.
#pragma once

#include <filesystem>

namespace edgescout {

// "." for a bare name.
inline std::filesystem::path parent_of_output(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

}  // namespace edgescout
