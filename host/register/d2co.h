// D2CO: registration of object poses directly on the DCD tensors of one or several views (paper,
// Secs. 4.1 and 4.3).
//
// Minimises E(pose) = sum over views, points of rho(DT3_view(x_i, xi_i)) by Levenberg-Marquardt
// over the tangent of core/se3.h at world_from_object (Eqs. 8 and 11). Views with depth add the
// distances of the visible surface to what was measured (depth_systems.h). Projections and
// orientations are recomputed at every evaluation; the visible points at the start of every round.
// All poses of a call are refined side by side: one kernel call gives the systems of all of them in
// all views.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/register/d2co_options.h"
#include "host/register/points_in_views.h"
#include "host/register/pose_estimate.h"
#include "host/register/scene.h"

namespace edgescout {

struct TemplateSet;

// Estimates in the order of the starts, without features. InputError: options out of bounds;
// LogicError: no view, a view or a start whose pose is not finite, an object without a model.
std::vector<PoseEstimate> register_poses(const Scene& scene, std::span<const ObjectPose> starts,
                                         const D2coOptions& options = {});

// As register_poses for the poses of one object, on points that are looked up in its templates
// (template_points.h). register_poses draws depth maps to find them, which costs more than a short
// registration itself. scene.models holds the model of the set. Ignores D2coOptions::visibility and
// D2coOptions::solver.
std::vector<PoseEstimate> register_on_templates(const Scene& scene, const TemplateSet& set,
                                                std::span<const ObjectPose> starts,
                                                const D2coOptions& options = {});

// What is visible of poses in views, object frame.
struct VisiblePoints {
  PointsInViews<ModelPoint> edges;
  PointsInViews<SurfacePoint> surface;  // compared with measured depth; ignored in views without it
};
// Looks points up, of each pose and view at most as many as the round takes.
using FindPoints =
    std::function<VisiblePoints(std::span<const ObjectPose> poses, const D2coRound& round)>;

// The same with points that the caller looks up before every round. Of scene.models only the
// diameters count. LogicError besides: ranges of another number of poses or views.
std::vector<PoseEstimate> register_points(const Scene& scene, std::span<const ObjectPose> starts,
                                          const FindPoints& find_points,
                                          const D2coOptions& options = {});

// LogicError: no view, a view or a start whose pose is not finite, an object without a model.
void check_problem(std::span<const ObjectPose> starts, std::size_t models,
                   std::span<const ObjectView> views);

}  // namespace edgescout
