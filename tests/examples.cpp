#include "tests/examples.h"

namespace edgescout::test {

std::filesystem::path examples() { return EDGESCOUT_EXAMPLES; }

}  // namespace edgescout::test
