#include "host/detect/scan_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kernels/error.h"

namespace edgescout {

namespace {

// Anchors of one row or column of the grid: from `begin` on, before `end`.
struct AnchorRange {
  int begin, end;
};

// The anchors of a coarse image between two places of the full image; at least one.
AnchorRange anchors_between(double from_px, double to_px, double reduction, int coarse_px,
                            int step) {
  const auto anchor_at = [&](double px) { return ((px + 0.5) / reduction - 0.5) / step; };
  const int count = (coarse_px + step - 1) / step,
            begin = std::min(int(std::ceil(anchor_at(from_px))), count - 1);
  return {begin, int(std::clamp(std::ceil(anchor_at(to_px)), double(begin + 1), double(count)))};
}

ScanRegion region_at(AnchorRange across, AnchorRange down, int step) {
  ScanRegion region{
      across.begin * step, down.begin * step, across.end - across.begin, down.end - down.begin, {}};
  region.middle = {std::round(region.x0 + 0.5 * step * (region.columns - 1)),
                   std::round(region.y0 + 0.5 * step * (region.rows - 1))};
  return region;
}

}  // namespace

std::vector<ScanRegion> cut_into_regions(const ObjectView& view, const ReducedTensors& level,
                                         const ScanOptions& options) {
  const ImageRegion& within = options.within;
  if (within.x >= view.camera.width || within.y >= view.camera.height)
    throw InputError(
        "options", "detect.region", fmt::format("a corner at {}, {}", within.x, within.y),
        fmt::format("one in an image of {}x{}", view.camera.width, view.camera.height));
  const int step = options.anchor_step;
  const auto end_px = [](double from_px, double size_px) {
    return size_px > 0 ? from_px + size_px : INFINITY;
  };
  const AnchorRange across = anchors_between(within.x, end_px(within.x, within.width),
                                             level.reduction, level.camera.width, step),
                    down = anchors_between(within.y, end_px(within.y, within.height),
                                           level.reduction, level.camera.height, step);
  std::vector<ScanRegion> regions;
  for (int r = down.begin; r < down.end; r += options.region_rows)
    for (int c = across.begin; c < across.end; c += options.region_columns)
      regions.push_back(region_at({c, std::min(c + options.region_columns, across.end)},
                                  {r, std::min(r + options.region_rows, down.end)}, step));
  return regions;
}

}  // namespace edgescout
