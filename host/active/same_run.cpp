// Whether a run can continue from a saved state.
#include <algorithm>
#include <climits>

#include "host/active/scout_state.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Collects the largest indices of objects and views in a state, and checks its decisions.
struct UsedIndices {
  int object = -1, view = -1;
  bool valid = true;  // decisions and enumerators

  explicit UsedIndices(const ScoutState& state) : views_(state.views.size()) {
    objects_in(state.candidates);
    objects_in(state.particles);
    objects_in(state.detections);
    check_decision(state.last_decision);
    for (const ScoutStep& step : state.steps) {
      check_decision(step.decision);
      objects_in(step.before);
      objects_in(step.after);
      objects_in(step.detections);
      note(view, step.decision.view);
    }
    valid = valid && is_one_of(state.end, ScoutEnd::TimeLimit);
    for (const FailedView& failed : state.failed) note(view, failed.view);
  }

 private:
  // A negative index is invalid, too.
  static void note(int& most, int index) { most = std::max(most, index < 0 ? INT_MAX : index); }
  template <typename Enum>
  static bool is_one_of(Enum value, Enum last) {
    return static_cast<int>(value) >= 0 && value <= last;
  }
  void check_decision(const ScoutDecision& decision) {
    objects_in(decision.candidates);
    for (const std::vector<int>* members : {&decision.likeliest, &decision.unlikeliest})
      for (const int member : *members)
        valid = valid && member >= 0 && member < static_cast<int>(decision.candidates.size());
    valid = valid && is_one_of(decision.strategy, Strategy::Fixed);
    valid = valid && (decision.views.empty() || decision.views.size() == views_);
  }
  static int object_of(const ModeDetection& x) { return x.detection.object; }
  static int object_of(const auto& x) { return x.object; }
  void objects_in(const auto& list) {
    for (const auto& x : list) note(object, object_of(x));
  }

  std::size_t views_;
};

bool same_place(const Se3& a, const Se3& b) {
  return distance_between_m(a, b) < 1e-6 && angle_between_rad(a, b) < 1e-6;
}

}  // namespace

void require_same_run(const ScoutState& saved, const ScoutState& run, const std::string& source) {
  if (!std::ranges::equal(saved.views, run.views, same_place))
    throw InputError(source, "views", "others", "those of this run");
  if (!same_camera(saved.camera, run.camera))
    throw InputError(source, "camera", "another", "that of this run");
  if (saved.objects != run.objects)
    throw InputError(source, "objects", "others", "those of this run");
  const UsedIndices used(saved);
  if (used.object >= static_cast<int>(run.objects.size()) ||
      used.view >= static_cast<int>(run.views.size()) || !used.valid)
    throw InputError(source, "indices", "an object, view or candidate that is none",
                     "those of this run");
}

}  // namespace edgescout
