#include "host/cli/program_version.h"

#include "commit.h"

namespace edgescout {

std::string program_version() { return EDGESCOUT_VERSION ", commit " EDGESCOUT_COMMIT; }

}  // namespace edgescout
