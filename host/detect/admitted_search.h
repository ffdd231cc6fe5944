// What a prior in the world leaves of the search of one scale.
#pragma once

#include <optional>
#include <vector>

#include "host/detect/scan_regions.h"
#include "host/detect/search_space.h"
#include "host/detect/searched_scale.h"

namespace edgescout {

class AdmittedSearch {
 public:
  AdmittedSearch(const SearchedScale& scale, const ObjectView& view, const ScanOptions& options);

  // By distance: the smallest part of a region with all anchors where the object's centre may be.
  std::vector<std::optional<ScanRegion>> parts_of(const ScanRegion& region) const;

  bool admits(const ScoredTemplate& scored) const;

 private:
  std::optional<ScanRegion> part_at(double distance_m, const ScanRegion& region) const;

  // How far beside the pose that it stands for a hit may lie.
  SearchSlack slack_at(double distance_m) const;

  const SearchedScale& scale_;
  int anchor_step_;
  SearchSpace space_;
};

}  // namespace edgescout
