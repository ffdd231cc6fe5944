#include "host/detect/scanned_view.h"

namespace edgescout {

void scan_once(std::span<const TemplateSet> sets, ScannedView& view, Backend& backend,
               const ScanOptions& options, const TimeLimit* limit) {
  if (!view.hits.empty()) return;
  for (const TemplateSet& set : sets)
    view.hits.push_back(std::make_shared<std::vector<ScanHit>>(
        coarse_scan(set, view.view, backend, options, limit)));
}

std::vector<ObjectView> views_of(std::span<const ScannedView> scanned) {
  std::vector<ObjectView> views;
  for (const ScannedView& each : scanned) views.push_back(each.view);
  return views;
}

}  // namespace edgescout
