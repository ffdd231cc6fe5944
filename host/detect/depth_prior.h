// What a depth image leaves of the search of one scale: where which distances fit.
#pragma once

#include <cstdint>
#include <vector>

#include "host/detect/searched_scale.h"

namespace edgescout {

// The centre of an object lies behind the surface that the camera sees of it, and not farther than
// the object is large. A distance fits at an anchor if a share of the measured pixels around lies
// no farther before or behind it than the object's radius, besides noise and the steps of the
// templates' distances. Where too little is measured, all distances fit.
class DepthPrior {
 public:
  // Without a depth image everything fits.
  DepthPrior(const SearchedScale& scale, const ObjectView& view, int anchor_step);

  // `distance`: its index in scale.numbering; (column, row): coarse px of an anchor.
  bool fits(std::size_t distance, int column, int row) const {
    return fits_.empty() ||
           fits_[distance][std::size_t(row / anchor_step_) * std::size_t(columns_) +
                           std::size_t(column / anchor_step_)];
  }
  // Of all places and distances, (0, 1].
  double share() const { return share_; }

 private:
  int anchor_step_, columns_ = 0;
  std::vector<std::vector<std::uint8_t>> fits_;  // by distance, then by anchor
  double share_ = 1;
};

}  // namespace edgescout
