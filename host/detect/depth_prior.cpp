#include "host/detect/depth_prior.h"

#include <algorithm>
#include <cmath>

#include "host/register/measured_depth.h"

namespace edgescout {

namespace {

constexpr double WINDOW = 0.5;         // of the object's radius: half the side of a window
constexpr double MIN_MEASURED = 0.25;  // of a window's anchors: fewer say nothing
constexpr double MIN_FITTING = 0.15;   // of those measured
constexpr double SIGMAS = 3;

// One depth for every anchor of a coarse image.
struct AnchorDepths {
  int columns, rows;
  std::vector<float> z_m;
};

// The first measured of nine pixels around the anchor.
float depth_around(const DepthImage& depth, const Eigen::Vector2d& pixel, double spread_px) {
  for (const double dy : {0.0, -1.0, 1.0})
    for (const double dx : {0.0, -1.0, 1.0}) {
      const Eigen::Vector2d place =
          (pixel + spread_px * Eigen::Vector2d(dx, dy)).array().round().matrix();
      const bool is_inside =
          place.x() >= 0 && place.y() >= 0 && place.x() < depth.width && place.y() < depth.height;
      const float z_m = is_inside ? depth.at(int(place.x()), int(place.y())) : DEPTH_MISSING;
      if (z_m > 0) return z_m;
    }
  return DEPTH_MISSING;
}

AnchorDepths depths_at_anchors(const DepthImage& depth, const ReducedTensors& level, int step) {
  AnchorDepths anchors{
      (level.camera.width + step - 1) / step, (level.camera.height + step - 1) / step, {}};
  for (int row = 0; row < anchors.rows; ++row)
    for (int column = 0; column < anchors.columns; ++column) {
      const Eigen::Vector2d coarse(column * step, row * step);
      anchors.z_m.push_back(depth_around(depth,
                                         ((coarse.array() + 0.5) * level.reduction - 0.5).matrix(),
                                         0.33 * step * level.reduction));
    }
  return anchors;
}

// Sums over rectangles of anchors.
class AnchorSums {
 public:
  template <typename Value>
  AnchorSums(int columns, int rows, const Value& value)
      : columns_(columns), rows_(rows), sums_(std::size_t(columns + 1) * std::size_t(rows + 1)) {
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        at(row + 1, column + 1) =
            at(row, column + 1) + at(row + 1, column) - at(row, column) +
            int(value(std::size_t(row) * std::size_t(columns) + std::size_t(column)));
  }
  // Around an anchor, as far as there are anchors.
  int around(int column, int row, int reach) const {
    const int left = std::max(0, column - reach), right = std::min(columns_, column + reach + 1),
              top = std::max(0, row - reach), bottom = std::min(rows_, row + reach + 1);
    return at(bottom, right) - at(top, right) - at(bottom, left) + at(top, left);
  }

 private:
  int& at(int row, int column) {
    return sums_[std::size_t(row) * std::size_t(columns_ + 1) + std::size_t(column)];
  }
  int at(int row, int column) const {
    return sums_[std::size_t(row) * std::size_t(columns_ + 1) + std::size_t(column)];
  }
  int columns_, rows_;
  std::vector<int> sums_;
};

}  // namespace

DepthPrior::DepthPrior(const SearchedScale& scale, const ObjectView& view, int anchor_step)
    : anchor_step_(anchor_step) {
  if (!view.depth) return;
  const AnchorDepths anchors = depths_at_anchors(view.depth->image, scale.level, anchor_step);
  columns_ = anchors.columns;
  const Camera& camera = scale.level.camera;
  const double radius_m = scale.set.model.radius_m;
  const AnchorSums measured(anchors.columns, anchors.rows,
                            [&](std::size_t i) { return anchors.z_m[i] > 0; }),
      all(anchors.columns, anchors.rows, [](std::size_t) { return 1; });
  std::size_t fitting = 0;
  for (const double distance_m : scale.numbering.distances_m) {
    const double half_step_m = 0.5 * distance_m * (scale.set.options.distance_ratio - 1);
    const auto is_near = [&](std::size_t i) {
      const double z_m = anchors.z_m[i];
      const std::size_t column = i % std::size_t(columns_), row = i / std::size_t(columns_);
      const Eigen::Vector2d anchor(double(column) * anchor_step, double(row) * anchor_step);
      const double center_z_m = distance_m / ray_through(camera, anchor).norm();
      return z_m > 0 && std::abs(z_m - center_z_m) <=
                            radius_m + half_step_m + SIGMAS * view.depth->noise.sigma_m(z_m);
    };
    const AnchorSums near(anchors.columns, anchors.rows, is_near);
    const int reach =
        std::max(1, int(std::lround(WINDOW * camera.fx * radius_m / distance_m / anchor_step)));
    std::vector<std::uint8_t>& fits = fits_.emplace_back();
    for (int row = 0; row < anchors.rows; ++row)
      for (int column = 0; column < anchors.columns; ++column) {
        const int known = measured.around(column, row, reach);
        fits.push_back(known < MIN_MEASURED * all.around(column, row, reach) ||
                       near.around(column, row, reach) >= MIN_FITTING * known);
        fitting += fits.back();
      }
  }
  share_ = std::max(0.01, double(fitting) / double(fits_.size() * anchors.z_m.size()));
}

}  // namespace edgescout
