// How the tests call edgescout register.
#pragma once

#include "tests/cli/example_scene.h"

namespace edgescout::test {

inline std::vector<std::string> register_in(const fs::path& input, const fs::path& poses,
                                            const fs::path& out,
                                            const std::vector<std::string>& more = {}) {
  return joined({{"register", input, "--poses", poses, "--out", out, "--device", "cpu"},
                 part_models(),
                 more});
}

}  // namespace edgescout::test
