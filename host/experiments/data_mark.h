// Which data an experiment ran on.
#pragma once

#include <filesystem>
#include <string>

namespace edgescout {

// What tells the data below a folder from others, wherever the folder lies: a checksum of the files that say
// what is in it (truths, cameras, starts). InputError naming one of these that is missing.
std::string data_mark(const std::filesystem::path& data);

}  // namespace edgescout
