// Former names of options. They are accepted for one version, with a warning that gives the new
// one.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace edgescout {

// Replaces former names on a command line without the program's name. Ablations are options of
// `edgescout bench experiments` alone: with another verb, InputError says so.
std::vector<std::string> with_present_names(std::vector<std::string> arguments);

// The name of a key of the file `source` that the running verb does not know: its new name if the
// verb has that (`is_known`), else the key itself. InputError: an ablation with another verb.
std::string present_name(const std::string& key, const std::string& source,
                         const std::function<bool(const std::string&)>& is_known);

}  // namespace edgescout
