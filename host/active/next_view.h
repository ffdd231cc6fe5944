// Where to look next: the information every possible view is expected to give about the particles
// (paper, Sec. 5.3, Eqs. 15-20), and the baselines of Sec. 6.4.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/active/particles.h"
#include "host/active/template_table.h"
#include "host/core/bit_matrix.h"

namespace edgescout {

enum class Strategy { Information, Disocclusion, Random, Fixed };
std::string to_string(Strategy strategy);         // "mi-max", "dis", "random", "fixed"
Strategy strategy_from(const std::string& word);  // InputError on another word

struct NextViewOptions {
  Strategy strategy = Strategy::Information;
  double reduction = 4;    // image px a map px, [1, 16]
  double cap_px = 40;      // of distances, image px; at most 15.9 map px
  double sigma_px = 4;     // of the mean distance, image px; at least cap_px / 141
  double tolerance = 0.1;  // of a candidate's diameter: nearer behind its surface it hides nothing
  bool use_paper_formula =
      false;  // the paper's own formula (kernels/mutual_information.h), all weights equal
  // A template point was seen in a real view if an edge of its image lies so near, along it; 0: if
  // it lies inside the image, as in the paper's own formula and in Strategy::Disocclusion always.
  // At most 8.
  double seen_px = 4;
  VisibilityOptions visibility{96, 0.01};
  // What nobody knows of (undetected parts, clutter, the heap itself) hides more the lower a camera
  // stands. A line of sight is free of it with probability cos^visibility_exponent of its angle to
  // straight above, and a view that is not tells nothing: an erasure, which leaves that share of
  // the information. Straight above is the mean direction from what the views look at to their
  // cameras; where they stand all around there is none, and all are free. 0: all are free, as in
  // the paper's own formula always. Views that look at no point in common (looked_at_m) are neither
  // hidden nor repeated.
  double visibility_exponent = 0.5;
  // Views near each other err alike: what misleads one (neighbours, shadows, a wrong pose's chance
  // agreement, what hides a part) misleads the other. Of what a view would tell, a real view at an
  // angle theta from it, as seen from what the views look at, has told exp(-(theta /
  // view_correlation_angle_rad)^2) already; the nearest one counts. 0: every view is new, as in the
  // paper's own formula always.
  double view_correlation_angle_rad = 0.45;
  // What no candidate is for may lie wherever no view has looked yet: a view that is new and open
  // is expected to tell so many nats of it (ViewInformation::discovery). Little beside what a
  // second view promises about the candidates; what is left to gain once they are decided. 0: no
  // information but about candidates, as in the paper, and in its own formula always.
  double exploration_bonus_nats = 0.5;
  double exploration_correlation_angle_rad =
      1;  // as view_correlation_angle_rad, of what is unknown
  // nats, taken off the information (Strategy::Information alone, and not the paper's own formula):
  // for the way from the last view's camera
  double motion_cost_per_m = 0;
  double motion_cost_per_rad = 0;
  std::function<bool(int view)> reachable;  // empty: all are
  std::vector<int> sequence;                // of Strategy::Fixed; empty: in the order of the views
  std::uint64_t seed = 1;                   // of Strategy::Random
  void validate() const;  // throws InputError naming the field and the violated bound
};

// All that a decision depends on. Spans must outlive the call.
struct Planning {
  std::span<const EdgeModel> models;
  std::span<const TemplateTable> tables;  // one an object
  Camera camera;                          // ideal, full resolution
  std::span<const Se3> views;             // camera_from_world of all possible views
  // one a view: nonzero where it was taken or cannot be reached; empty: all are open
  std::span<const char> closed;
  std::span<const RegisterView>
      real_views;  // the images so far, in order; of the tensors nothing is read
  std::span<const Detection> candidates;    // in the world
  const BitMatrix* combinations = nullptr;  // over the candidates; needed by Strategy::Information
  std::span<const Particle> particles;
};

struct ViewInformation {
  bool open = false;       // may be chosen; else the rest is 0
  double information = 0;  // Information: nats; Disocclusion: sum of psi times new visible points;
                           // Random: a draw from [0, 1); Fixed: falls along the sequence
  double share = 0;  // that visibility_exponent and view_correlation_angle_rad leave: information
                     // is so much of the mutual one
  double discovery = 0;    // nats expected of what is unknown; Strategy::Information alone
  double motion_cost = 0;  // from the last real view
  double expected() const { return information + discovery; }
  double value() const { return expected() - motion_cost; }
};

// One a view. Without particles, candidates or combinations, and for views that see nothing of
// them, the information is 0; where that is so of all open views a warning is logged.
std::vector<ViewInformation> view_information(const Planning& planning, Backend& backend,
                                              const NextViewOptions& options);

// The open view of most value, of equals the one of most share: far from the views taken and high,
// where nothing is known that information could be about and nothing expected of what is unknown.
// Nothing where none is open.
std::optional<int> best_view(std::span<const ViewInformation> views);

}  // namespace edgescout
