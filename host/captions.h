// Places captions beside points of a picture, so that they can be read where points are close.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace edgescout {

struct Caption {
  Eigen::Vector2d point_px;  // what it belongs to
  Eigen::Vector2i size_px;
};

// The left upper corner of each caption, px: right of its point and above it. Where an earlier
// caption stands there, or the picture ends, it moves to the nearest free place around the point.
// Where none is free, it takes the place at which it covers least of the others.
std::vector<Eigen::Vector2i> place_captions(std::span<const Caption> captions,
                                            const Eigen::Vector2i& picture_px);

}  // namespace edgescout
