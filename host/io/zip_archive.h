// Internal to host/io: reads files out of a ZIP archive, by minizip.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace edgescout {

// The contents of the files whose names end in `ending`, one after the other. InputError naming the
// archive: it is none, is damaged, or all files in it together have more than `most_bytes`.
std::string read_zipped(const std::filesystem::path& archive, const std::string& ending,
                        std::uintmax_t most_bytes);

}  // namespace edgescout
