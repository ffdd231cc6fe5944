#include "host/captions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace edgescout {

namespace {

using Box = Eigen::AlignedBox2i;

constexpr int GAP_PX = 6;     // from the point
constexpr int MOST_ROWS = 8;  // up and down from there

int covered_px2(const Box& box, std::span<const Box> others) {
  int area = 0;
  for (const Box& other : others) {
    const Box both = box.intersection(other);
    if (!both.isEmpty()) area += both.volume();
  }
  return area;
}

// Left upper corners, the nearest to the point first.
std::vector<Eigen::Vector2i> places_around(const Caption& caption) {
  const Eigen::Vector2i point = caption.point_px.array().round().cast<int>();
  const int width = caption.size_px.x(), height = caption.size_px.y();
  std::vector<Eigen::Vector2i> places;
  for (int row = 0; row < MOST_ROWS; ++row)
    for (const int y : {-GAP_PX - height - row * height, GAP_PX + row * height})
      for (const int x : {GAP_PX, -GAP_PX - width}) places.push_back(point + Eigen::Vector2i(x, y));
  return places;
}

Eigen::Vector2i moved_inside(const Eigen::Vector2i& corner, const Caption& caption,
                             const Eigen::Vector2i& picture_px) {
  const Eigen::Vector2i last = (picture_px - caption.size_px).cwiseMax(0);
  return corner.cwiseMin(last).cwiseMax(0);
}

}  // namespace

std::vector<Eigen::Vector2i> place_captions(std::span<const Caption> captions,
                                            const Eigen::Vector2i& picture_px) {
  std::vector<Eigen::Vector2i> corners;
  std::vector<Box> taken;
  for (const Caption& caption : captions) {
    Eigen::Vector2i best;
    int least_px2 = std::numeric_limits<int>::max();
    for (const Eigen::Vector2i& place : places_around(caption)) {
      const Eigen::Vector2i corner = moved_inside(place, caption, picture_px);
      const int px2 = covered_px2({corner, corner + caption.size_px}, taken);
      if (px2 < least_px2) best = corner, least_px2 = px2;
      if (px2 == 0) break;
    }
    corners.push_back(best);
    taken.emplace_back(best, best + caption.size_px);
  }
  return corners;
}

}  // namespace edgescout
