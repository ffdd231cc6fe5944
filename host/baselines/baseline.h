// The registration methods of the paper's comparison (Sec. 6, "Object Registration"), and D2CO as
// the paper states it.
//
// All start from one pose, without search or edge ICP. They share
// - the visible points, computed once at the start pose;
// - the loss, Huber's (Eq. 8);
// - the end of a least-squares solve: `inner_iterations` or a small step ("the same inner loop's
//   stopping criteria"). A solve is the whole registration (D2CO, LM-ICP), one association (the
//   ICPs) or one pyramid level (Direct);
// - the sum over several views (Eq. 11).
// They are plain, single-threaded code: only visible points and D2CO's systems use the backend.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "host/model/visible_edges.h"
#include "host/register/pose_estimate.h"
#include "host/register/scene.h"

namespace edgescout {

// DC-ICP is Liu et al.'s (IJRR 2012), LM-ICP Fitzgibbon's (BMVC 2001), C-ICP Besl and McKay's (PAMI
// 1992).
enum class Method {
  D2co,   // Eqs. 8 and 11 on the tensor: register_poses in one round
  DcIcp,  // closest edge point in place and direction, then Gauss-Newton on the pairs; repeated
  LmIcp,  // Levenberg-Marquardt on the undirected distance transform
  CIcp,   // closest edge point by that distance transform, then Gauss-Newton on the pairs; repeated
  Direct,  // gradient magnitude under the projected points, coarse to fine on a Gaussian pyramid
};

// All methods in the order of the paper's table.
std::vector<Method> all_methods();
// "d2co", "dc-icp", "lm-icp", "c-icp", "direct".
std::string to_string(Method method);
// InputError that lists the names on another word.
Method method_from(const std::string& name);

struct BaselineOptions {
  int outer_iterations = 50;   // associations, of the ICPs only; [1, 1000]
  int inner_iterations = 100;  // steps of one least-squares solve; [1, 1000]
  // A smaller step ends a solve; a smaller move in one association ends an ICP. In [0, 1].
  double min_step_m = 2e-6;
  double min_step_rad = 2e-5;
  // Of the Huber loss; (0, 1000]. Direct has none: its residuals are bounded.
  double loss_scale_px = 1;
  int pyramid_levels = 3;  // of Direct, including the image itself; [1, 8]
  VisibilityOptions visibility;
  void validate() const;  // InputError naming the field and the violated bound
};

// Estimates in the order of the starts. `cost_px2` and `mean_px` are the method's own; Direct's
// have no unit.
using Registrar = std::function<std::vector<PoseEstimate>(std::span<const ObjectPose> starts)>;

// Computes what a method needs of the images alone, once for all starts: distance transforms,
// pyramids (D2CO's are the tensors of the views). The time of the registrations is that of the
// function returned. The scene's models, views and backend must outlive it. Orientation has the
// same weight in DC-ICP as in the view's tensor (lambda). LogicError: no view, an ICP and a view
// without edges, Direct and a view without its image.
Registrar prepare_method(Method method, const Scene& scene, const BaselineOptions& options = {});

// Prepares and registers. LogicError besides: an object without a model.
std::vector<PoseEstimate> register_with(Method method, const Scene& scene,
                                        std::span<const ObjectPose> starts,
                                        const BaselineOptions& options = {});

}  // namespace edgescout
