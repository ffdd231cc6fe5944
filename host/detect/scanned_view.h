// Keeps the scan's hits of an image, so that they can be rescored when later images arrive.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "host/detect/coarse_scan.h"

namespace edgescout {

// Hits of one object in one image; copies of a view share them.
using ScanHits = std::shared_ptr<const std::vector<ScanHit>>;

struct ScannedView {
  ObjectView view;
  std::vector<ScanHits> hits;  // by object; empty before the scan
};

// Fills ScannedView::hits by coarse_scan. Does nothing where they are already there. Where the
// limit is over, hits are missing.
void scan_once(std::span<const TemplateSet> sets, ScannedView& view, Backend& backend,
               const ScanOptions& options, const TimeLimit* limit = nullptr);

std::vector<ObjectView> views_of(std::span<const ScannedView> scanned);

}  // namespace edgescout
