// Which data an experiment ran on.
#pragma once

#include <filesystem>
#include <string>

namespace edgescout {

// What tells the data below a folder from others, wherever the folder lies: a checksum of all files
// of its sets. InputError naming one of those that no set can do without (truths, cameras, starts,
// meshes).
std::string data_mark(const std::filesystem::path& data);

}  // namespace edgescout
