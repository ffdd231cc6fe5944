// The files of docs/examples: parts, and two scenes rendered of them.
#pragma once

#include <filesystem>

namespace edgescout::test {

std::filesystem::path examples();

}  // namespace edgescout::test
