// Experiment 4: where to look next. MI-MAX against Random, DIS and a fixed sequence in bins of
// piled parts: how many instances are localised, and how many false ones reported, after every view
// (paper, Sec. 6.4, figure 15).
#pragma once

#include "host/experiments/experiment.h"

namespace edgescout {

// What rows say of photographed bins in place of their kind of parts.
inline constexpr char PHOTOGRAPHED_BINS[] = "photographs";

Experiment nbv_experiment();

// Private to the experiment: its table and plots.
Report nbv_report(const ExperimentSettings& settings, const Table& table);

}  // namespace edgescout
