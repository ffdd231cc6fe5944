// Selects detections from registered candidates: poses that can exist together, refined once more.
#pragma once

#include <span>
#include <vector>

#include "host/detect/detect_options.h"
#include "host/detect/detect_trace.h"
#include "host/model/template_set.h"

namespace edgescout {

// Returns the detection that an estimate with features makes. Its probability is of all views of
// them.
Detection to_detection(const PoseEstimate& estimate);

// `candidates` are of all objects, in the world of scene.views, with features. Most probable first.
//
// 1. Keeps the candidates of at least 0.05, or options.min_probability if that is less, that
//    options.scan.world admits.
// 2. Drops those that collide with more probable ones (plausible_pairs.h).
// 3. Lets the rest compete for the image's edges (edge_claims.h).
// 4. Refines the winners again from turned starts: a wrong local optimum loses to a right one near
// it.
// 5. Repeats 2 and 3 with all poses.
// 6. Lets each share its odds with its alternatives (alternatives.h).
// 7. Reports those of options.min_probability or more.
//
// `sets` is by object. `trace`, where given, receives the poses that competed and those that were
// selected.
std::vector<Detection> select_detections(const Scene& scene, std::span<const TemplateSet> sets,
                                         std::span<const PoseEstimate> candidates,
                                         const DetectOptions& options,
                                         SelectionTrace* trace = nullptr);

}  // namespace edgescout
