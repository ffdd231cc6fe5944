// The methods that work point by point, on one pose at a time. Private to host/baselines and its
// tests.
#pragma once

#include "host/baselines/baseline.h"
#include "host/baselines/scalar_image.h"
#include "host/register/lm_state.h"

namespace edgescout {

// Registers from a start (world_from_object) and its visible points, one list per view.
using PoseSolver =
    std::function<LmState(const Se3& start, std::span<const std::vector<ModelPoint>> points)>;

PoseSolver prepare_dc_icp(std::span<const ObjectView> views, const BaselineOptions& options);
PoseSolver prepare_lm_icp(std::span<const ObjectView> views, const BaselineOptions& options);
PoseSolver prepare_c_icp(std::span<const ObjectView> views, const BaselineOptions& options);
PoseSolver prepare_direct(std::span<const ObjectView> views, const BaselineOptions& options);

// What LM-ICP minimises: the sum of rho of the distances (px, one image per view) at all projected
// points. Outside the image the distance is the border's value plus the distance to it, as in the
// tensor.
WorldSystem distance_system(std::span<const ObjectView> views,
                            std::span<const std::vector<ModelPoint>> points,
                            std::span<const ScalarImage> distances, const Se3& world_from_object,
                            double loss_scale_px);

// What Direct minimises on one level: the sum of r^2 / 2 with r = 1 - magnitude. One pyramid per
// view, finest level first. A view with fewer levels gives its coarsest.
using MagnitudePyramid = std::vector<ScalarImage>;
WorldSystem magnitude_system(std::span<const ObjectView> views,
                             std::span<const std::vector<ModelPoint>> points,
                             std::span<const MagnitudePyramid> pyramids, int level,
                             const Se3& world_from_object);

}  // namespace edgescout
