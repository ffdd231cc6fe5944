// The registration methods that the paper compares D2CO with (Sec. 6, "Object Registration"), and
// D2CO as the paper states it.
//
// All start from one pose, without search or polish, and share what they can: the visible points,
// taken once at the start pose; the loss, Huber's (Eq. 8's); what ends a least-squares solve,
// `inner_iterations` or a small step, be it of the whole (D2CO, LM-ICP), of one association (the
// ICPs) or of a level (Direct): "the same inner loop's stopping criteria". They are plain,
// single-threaded code: only visible points, and D2CO's systems, come from the backend. Several
// views are summed up (Eq. 11) by all.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "host/register/d2co.h"

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

// All there are, in the order of the paper's table.
std::vector<Method> all_methods();
// "d2co", "dc-icp", "lm-icp", "c-icp", "direct".
std::string to_string(Method method);
// InputError listing the names on another word.
Method method_from(const std::string& name);

struct BaselineOptions {
  int outer_iterations = 50;   // associations of the ICPs, which alone have any. [1, 1000]
  int inner_iterations = 100;  // steps of one least-squares solve. [1, 1000]
  double min_step_m =
      2e-6;  // a step, or an association's move, smaller than both ends it; in [0, 1]
  double min_step_rad = 2e-5;
  double loss_scale_px =
      1;  // of the Huber loss; not of Direct, whose residuals are bounded. (0, 1000]
  int pyramid_levels = 3;  // of Direct, the image itself included. [1, 8]
  VisibilityOptions visibility;
  void validate() const;  // throws InputError naming field and bound
};

// Results in the order of the hypotheses. In a result `cost_px2` and `mean_px` are the method's
// own: Direct's have no unit.
using Registrar = std::function<std::vector<Registration>(std::span<const ObjectPose>)>;

// What a method makes of the images alone (distance transforms, pyramids; D2CO's are the tensors of
// the views), once for all hypotheses: the time of the registrations themselves is that of the
// function returned. Models, views and backend must outlive it. Orientation weighs in DC-ICP as in
// the view's tensor (lambda). The ICPs need the views' edges, Direct their images: LogicError
// without.
Registrar prepare_method(Method method, std::span<const EdgeModel> models,
                         std::span<const RegisterView> views, Backend& backend,
                         const BaselineOptions& options = {});

// Both in one.
std::vector<Registration> register_with(Method method, std::span<const EdgeModel> models,
                                        std::span<const ObjectPose> hypotheses,
                                        std::span<const RegisterView> views, Backend& backend,
                                        const BaselineOptions& options = {});

}  // namespace edgescout
