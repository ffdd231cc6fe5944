// Identifies the data that an experiment ran on.
#pragma once

#include <filesystem>
#include <string>

namespace edgescout {

// Returns a checksum of all files of the sets in the folder. It does not depend on the place of the
// folder. InputError naming a missing file that a set needs (truths, cameras, starts, meshes).
std::string data_mark(const std::filesystem::path& data);

}  // namespace edgescout
