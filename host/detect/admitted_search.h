// What a prior in the world and measured depth leave of the search of one scale.
#pragma once

#include <optional>
#include <vector>

#include "host/detect/depth_prior.h"
#include "host/detect/scan_regions.h"
#include "host/detect/search_space.h"
#include "host/detect/searched_scale.h"

namespace edgescout {

// Of an image with a prior or with depth.
class AdmittedSearch {
 public:
  AdmittedSearch(const SearchedScale& scale, const ObjectView& view, const ScanOptions& options);

  // By distance: the smallest part of a region with all anchors where the object's centre may be.
  std::vector<std::optional<ScanRegion>> parts_of(const ScanRegion& region) const;

  bool admits(const ScoredTemplate& scored) const;

  // What depth leaves of all places and distances, (0, 1].
  double share() const { return depth_.share(); }

 private:
  std::optional<ScanRegion> part_at(std::size_t distance, const ScanRegion& region) const;

  // How far beside the pose that it stands for a hit may lie.
  SearchSlack slack_at(double distance_m) const;

  const SearchedScale& scale_;
  int anchor_step_;
  SearchSpace space_;
  DepthPrior depth_;
};

}  // namespace edgescout
