// A scan's hits, judged by all images of the scene.
//
// In one image thousands of places fit a template as well as an object does that is half hidden.
// Where other images show the same static scene, the right pose fits there too and a chance one
// does not. A hit's distance is what its own image knows least, so each is tried at several
// distances along its ray and keeps the one that all images together like best (docs/next_view.md:
// what that is worth).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/detect/coarse_scan.h"

namespace edgescout {

// The hits of a scan of `own`, moved along their rays, with `rank` the mean over all views of what
// ScanHit::rank is in one; mean_px stays that of their own view. Another view sees the points of
// the viewpoint nearest to the hit's. Other views in which a hit lies behind the camera or in no
// image count as chance; of what known objects hide there (RegisterView::occluders) a view says
// nothing, and counts the less. A hit about whose distance nothing is said stays where it is.
// `points` as for the scan. In the order given.
std::vector<ScanHit> rescore_in_views(const TemplateSet& set, std::span<const ScanHit> hits,
                                      const Observation& own, std::span<const Observation> others,
                                      Backend& backend, const ScanOptions& options);

// Poses, in the camera frame of the last image, that are not looked for.
using PoseFilter = std::function<bool(const Se3& camera_from_object)>;

// The hits of all images, `hits[i]` of images[i], each judged by all images (of many others by as
// many as `support_views`, support_views.h), in the camera frame of the last one. What an image
// shows may be no more than one among thousands of hits there, and not be seen in the next image at
// all: with each further image to judge them the hits of earlier ones tell more. A quick look, at a
// third of the points and three of the five distances, leaves `most` of those that are not
// excluded, of ties all; what it says is not returned. An only image's hits stay as they are, those
// that are not excluded, however many. `most` from 1 up.
std::vector<ScanHit> pooled_hits(const TemplateSet& set, std::span<const Observation> images,
                                 std::span<const std::span<const ScanHit>> hits, int support_views,
                                 const PoseFilter& excluded, std::size_t most, Backend& backend,
                                 const ScanOptions& options);

}  // namespace edgescout
