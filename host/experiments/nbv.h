// Experiment 4: the next best view in bins of piled parts (paper, Sec. 6.4, figure 15).
//
// Compares MI-MAX with Random, DIS and a fixed sequence: how many instances are localised and how
// many false ones are reported after every view.
#pragma once

#include "host/experiments/experiment.h"

namespace edgescout {

// The kind of parts in the rows of photographed bins.
inline constexpr char PHOTOGRAPHED_BINS[] = "photographs";

Experiment nbv_experiment();

// Private to the experiment: its table and plots.
Report nbv_report(const ExperimentSettings& settings, const Table& table);

}  // namespace edgescout
