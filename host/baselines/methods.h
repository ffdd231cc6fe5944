// One pose at a time by each method that works point by point. Private to host/baselines and its
// tests.
#pragma once

#include "host/baselines/baseline.h"
#include "host/baselines/scalar_image.h"
#include "host/register/lm_state.h"

namespace edgescout {

// From a start (world_from_object) and its visible points, a list a view.
using PoseSolver =
    std::function<LmState(const Se3& start, std::span<const std::vector<ModelPoint>> points)>;

PoseSolver prepare_dc_icp(std::span<const RegisterView> views, const BaselineOptions& options);
PoseSolver prepare_lm_icp(std::span<const RegisterView> views, const BaselineOptions& options);
PoseSolver prepare_c_icp(std::span<const RegisterView> views, const BaselineOptions& options);
PoseSolver prepare_direct(std::span<const RegisterView> views, const BaselineOptions& options);

// What LM-ICP minimises: rho of the distance (px, an image a view) under every projected point;
// outside the image the border's value and the distance to it, as the tensor has it.
WorldSystem distance_system(std::span<const RegisterView> views,
                            std::span<const std::vector<ModelPoint>> points,
                            std::span<const ScalarImage> distances, const Se3& world_from_object,
                            double loss_scale_px);

// What Direct minimises on one level: r^2 / 2 with r = 1 - magnitude. Pyramids a view, finest level
// first; a view with fewer levels gives its coarsest.
using MagnitudePyramid = std::vector<ScalarImage>;
WorldSystem magnitude_system(std::span<const RegisterView> views,
                             std::span<const std::vector<ModelPoint>> points,
                             std::span<const MagnitudePyramid> pyramids, int level,
                             const Se3& world_from_object);

}  // namespace edgescout
