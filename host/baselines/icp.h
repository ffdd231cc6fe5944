// Iterative closest points between a model's edges and an image's: associate, solve, repeat.
// Private to host/baselines and its tests.
#pragma once

#include "host/baselines/methods.h"

namespace edgescout {

// The edge point of a model point at (x, y) with direction theta in a view. Null where there is
// none.
using Associate =
    std::function<const EdgePoint*(std::size_t view, double x_px, double y_px, double theta_rad)>;

// The edge point of every model point, one list per view. Null where the point lies behind the
// camera or has no edge point.
using Pairs = std::vector<std::vector<const EdgePoint*>>;
Pairs associate_all(std::span<const ObjectView> views,
                    std::span<const std::vector<ModelPoint>> points, const Se3& world_from_object,
                    const Associate& associate);

// Sum over the pairs of rho(|x_i - e_i|) in the image: two residuals per point with one weight.
WorldSystem pair_system(std::span<const ObjectView> views,
                        std::span<const std::vector<ModelPoint>> points, const Pairs& pairs,
                        const Se3& world_from_object, double loss_scale_px);

LmState iterate_closest_points(const Se3& start, std::span<const ObjectView> views,
                               std::span<const std::vector<ModelPoint>> points,
                               const Associate& associate, const BaselineOptions& options);

}  // namespace edgescout
