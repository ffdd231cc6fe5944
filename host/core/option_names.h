// How messages name the options of the interface that was used.
//
// Public header.
#pragma once

#include <string>

namespace edgescout {

// Returns how messages name an option: of "distance-min" its field in C++, "distance_min", or what
// the interface calls it.
std::string option_name(const std::string& name);

// Sets what option_name returns, for the whole process. The program sets "--distance-min" before
// its first message; a binding for another language may set its own.
void set_option_naming(std::string (*name_of)(const std::string& name));

}  // namespace edgescout
