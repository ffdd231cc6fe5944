// A scan's hits, judged by all images of the scene.
//
// In one image thousands of places fit a template as well as an object does that is half hidden. Where other
// images show the same static scene, the right pose fits there too and a chance one does not. A hit's
// distance is what its own image knows least, so each is tried at several distances along its ray and keeps
// the one that all images together like best (docs/evaluation.md: what that is worth).
#pragma once

#include "host/detect/coarse_scan.h"

namespace edgescout {

// The hits of a scan of `own`, moved along their rays, with `rank` the mean over all views of what
// ScanHit::rank is in one; mean_px stays that of their own view. Other views in which a hit lies behind the
// camera or in no image count as chance; of what known objects hide there (RegisterView::occluders) a view
// says nothing, and counts the less. `points` as for the scan. In the order given.
std::vector<ScanHit> judged_by_all(const TemplateSet& set, std::span<const ScanHit> hits,
                                   const Observation& own, std::span<const Observation> others,
                                   Backend& backend, const ScanOptions& options);

}  // namespace edgescout
