// The version of the program and the commit that it was built from.
#pragma once

#include <string>

namespace edgescout {

// "0.2.0, commit 1fc25a5"
std::string program_version();

}  // namespace edgescout
