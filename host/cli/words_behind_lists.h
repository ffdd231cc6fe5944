// Images that stand behind an option that takes a list.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace edgescout {

// An option that takes any number of values takes all words up to the next option. Of a verb of
// images, the words behind such a list from the first image, video or folder on are inputs: they
// are moved to the front of the verb's words. "--templates T IMAGE --out R" -> "IMAGE --templates T
// --out R". The first value of an option stays.
std::vector<std::string> with_inputs_in_front(const CLI::App& program,
                                              std::vector<std::string> words);

}  // namespace edgescout
