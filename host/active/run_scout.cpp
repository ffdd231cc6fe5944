// Algorithm 2's loop: propose a view, take its image, add it.
#include "host/active/scout.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Nothing where the source fails or its shot cannot be used: then the view is marked as failed.
std::optional<Shot> acquire(Scout& scout, ViewSource& source, int view) {
  try {
    Shot shot = source.acquire(view);
    scout.require_fitting(shot);
    return shot;
  } catch (const AcquisitionError& error) {
    scout.unreachable(view, error.what());
  } catch (const InputError& error) {
    scout.unreachable(view, error.what());
  }
  return {};
}

}  // namespace

void run_scout(Scout& scout, ViewSource& source,
               const std::function<void(const ScoutState&)>& on_step) {
  while (const std::optional<ScoutDecision> proposal = scout.propose()) {
    if (const std::optional<Shot> shot = acquire(scout, source, proposal->view))
      scout.give(proposal->view, *shot);
    if (on_step) on_step(scout.state());
  }
}

}  // namespace edgescout
