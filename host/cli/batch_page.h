// Writes report.html of a batch: counts, probabilities, times, and the images page by page, those
// that failed first.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "host/cli/batch_results.h"
#include "host/cli/batch_tables.h"

namespace edgescout {

struct PagePictures {
  std::filesystem::path folder;  // of the page; PageImage::folder starts there
  int thumbnails = 0;            // images whose thumbnail is in the page, at most
};

// The page is one file that needs no network and no other file: the thumbnails that the overlays
// carry (thumbnail.h) are in it. It is written part by part, each thumbnail as soon as it is read.
// Of more overlays than `thumbnails` the others are shown where they lie, by relative links. Of
// more than 20,000 images the page lists all that failed or are missing first, then others up to
// that number, and says so.
void write_batch_page(const BatchTables& tables, const BatchSummary& summary,
                      const std::string& device, const PagePictures& pictures,
                      const std::function<void(std::string_view)>& write);

}  // namespace edgescout
