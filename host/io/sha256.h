// Internal to host: SHA-256 of bytes.
#pragma once

#include <string>
#include <string_view>

namespace edgescout {

// 64 hexadecimal digits, lower case.
std::string sha256_hex(std::string_view bytes);

}  // namespace edgescout
