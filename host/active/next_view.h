// Chooses the next view: the information that every possible view is expected to give about the
// particles (paper, Sec. 5.3, Eqs. 15-20), and the baselines of Sec. 6.4.
//
// Public header.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/active/particles.h"
#include "host/active/template_table.h"
#include "host/active/unmeasured_space.h"
#include "host/core/bit_matrix.h"

namespace edgescout {

enum class Strategy { Information, Disocclusion, Random, Fixed };
std::string to_string(Strategy strategy);         // "mi-max", "dis", "random", "fixed"
Strategy strategy_from(const std::string& word);  // InputError on another word

struct NextViewOptions {
  Strategy strategy = Strategy::Information;
  double reduction = 4;    // image px per map px, [1, 16]
  double cap_px = 40;      // largest distance that counts, image px; at most 15.9 map px
  double sigma_px = 4;     // of the mean distance, image px; at least cap_px / 141
  double tolerance = 0.1;  // fraction of a candidate's diameter: it hides nothing that lies less
                           // than this behind its surface
  // The paper's own formula (kernels/mutual_information.h), with equal weights of all particles.
  bool use_paper_formula = false;
  // A template point was seen in a real view if an edge of the image lies within this distance
  // along the point's direction, image px, [0, 8]. 0: if the point lies inside the image, as in the
  // paper's own formula and always with Strategy::Disocclusion.
  double seen_px = 4;
  VisibilityOptions visibility{96, 0.01};

  // The paper's own formula does not use the next four. Where the possible views look at no common
  // point (looked_at_m, views.h), all of them are free and independent.

  // Unknown things (undetected parts, clutter, the heap itself) hide more from a camera that stands
  // low. A line of sight is free with probability cos(angle to straight above) ^
  // visibility_exponent; a view that is not free gives no information, so this share of the
  // information remains. No unit, [0, 100]. Straight above is the mean direction from the common
  // point to the cameras. Where cameras stand all around there is none, and all views are free. 0:
  // all views are free.
  double visibility_exponent = 0.5;
  // Errors of near views are correlated: what misleads one view (neighbours, shadows, chance
  // agreement of a wrong pose, an occluder) also misleads the other. A real view at an angle theta,
  // seen from the common point, has already given exp(-(theta / view_correlation_angle_rad)^2) of
  // the information; the nearest real view counts. rad, [0, 100]. 0: every view is independent.
  double view_correlation_angle_rad = 0.45;
  // Objects without a candidate may be where no view has looked. An independent, free view is
  // expected to give this much information about them (ViewInformation::discovery). nats, [0,
  // 1000]. It is little against what a second view promises about the candidates, and decides once
  // they are certain. 0: only information about candidates counts, as in the paper.
  double exploration_bonus_nats = 0.5;
  // As view_correlation_angle_rad, for the exploration bonus. rad, [0, 100]. Where a real view has
  // depth, some of the space has nothing more to find: of the bonus the share v / (v + o) is left,
  // where v is the volume of unmeasured space (unmeasured_space.h) that the view sees and o that of
  // the smallest object's bounding box.
  double exploration_correlation_angle_rad = 1;

  // Costs of the motion from the last view's camera, nats per m and nats per rad; taken off the
  // information. Only with Strategy::Information, and not with the paper's own formula.
  double motion_cost_per_m = 0;
  double motion_cost_per_rad = 0;
  std::function<bool(int view)> reachable;  // empty: all are
  std::vector<int> sequence;                // of Strategy::Fixed; empty: in the order of the views
  std::uint64_t seed = 1;                   // of Strategy::Random
  void validate() const;                    // InputError naming the field and the violated bound
};
// Returns whether views are valued in nats: by information, and not by the paper's own formula.
// Only then do shares, exploration bonus and motion costs apply.
bool is_in_nats(const NextViewOptions& options);

// Names to `visit` how the next view is chosen, for the verb that moves a camera.
void describe_strategy(NextViewOptions& options, OptionVisitor& visit);
// Names to `visit` what the expected information is computed with.
void describe(NextViewOptions& options, OptionVisitor& visit);
// Names to `visit` the variants that the experiments compare with the defaults.
void describe_ablations(NextViewOptions& options, OptionVisitor& visit);

// Everything that a decision depends on. Refers to data of the caller.
struct NextViewProblem {
  Scene scene;  // the views are the images so far, in order; their tensors are not used
  std::span<const TemplateTable> tables;  // one per object
  Camera camera;                          // ideal, full resolution
  std::span<const Se3> possible_views;    // camera_from_world
  // One per possible view: nonzero where it was taken or cannot be reached. Empty: all are open.
  std::span<const char> closed;
  std::span<const Detection> candidates;    // in the world
  const BitMatrix* combinations = nullptr;  // of the candidates; for Strategy::Information
  std::span<const Particle> particles;
  std::optional<Workspace> workspace = {};  // where objects may be
};

// What is expected of one possible view.
struct ViewInformation {
  bool open = false;  // may be chosen; else the rest is 0
  // Information: nats. Disocclusion: sum of psi times new visible points. Random: a draw from
  // [0, 1). Fixed: falls along the sequence.
  double information = 0;
  // Fraction that visibility_exponent and view_correlation_angle_rad leave of the mutual
  // information; `information` contains it.
  double share = 0;
  double discovery = 0;    // exploration bonus, nats; Strategy::Information alone
  double motion_cost = 0;  // from the last real view, nats
  double expected() const { return information + discovery; }
  double value() const { return expected() - motion_cost; }
};

// Returns what is expected of each possible view. The information is 0 without particles,
// candidates or combinations, and for views that see nothing of them. Where it is 0 for all open
// views, a warning is logged. Once the scene's limit is over, it is 0 for the views that are left.
// InputError: options out of bounds; LogicError: another number of tables or of `closed`,
// combinations of other candidates.
std::vector<ViewInformation> view_information(const NextViewProblem& problem,
                                              const NextViewOptions& options);

// Returns the open view of the largest value; of equal ones that with the largest share, which is
// high and far from the views taken. Nothing where no view is open.
std::optional<int> best_view(std::span<const ViewInformation> views);

}  // namespace edgescout
