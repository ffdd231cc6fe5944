// Writes report.html of a batch: counts, probabilities, times, and the images page by page, those
// that failed first.
#pragma once

#include <string>

#include "host/cli/batch_results.h"
#include "host/cli/batch_tables.h"

namespace edgescout {

// The page is one file that needs no network. It shows the overlays where they lie, by relative
// links: those of 10,000 images are some GB, and the page stays at 1 MB. A browser loads those of
// the 48 images that it shows. Of more than 20,000 images the page lists all that failed or are
// missing first, then others up to that number, and says so.
std::string batch_page(const BatchTables& tables, const BatchSummary& summary,
                       const std::string& device);

}  // namespace edgescout
