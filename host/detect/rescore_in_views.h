// Scores the hits of one image's scan again in other images of the same static scene.
//
// In one image thousands of places fit a template as well as a half hidden object does. In other
// images the right pose fits again and a chance hit does not. One image determines the distance of
// a hit least, so each hit is tried at several distances along its ray and keeps the one that fits
// best in all images together (docs/research/next_view.md has the gain).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/core/stopwatch.h"
#include "host/detect/coarse_scan.h"

namespace edgescout {

// Where an object is looked for. Refers to data of the caller.
struct ObjectSearch {
  const TemplateSet& set;
  const ObjectView& view;               // the image that is searched
  std::span<const ObjectView> support;  // other images of the same static scene
  Backend& backend;
  Stopwatch* watch = nullptr;        // null: no stage is measured
  const TimeLimit* limit = nullptr;  // null: none
};

// The hits of a scan of `search.view`, moved along their rays, in the order given. `rank` becomes
// the mean of ScanHit::rank over all views; mean_px stays that of their own view.
//
// A supporting view sees the points of the viewpoint nearest to its camera. A hit behind that
// camera or outside its image counts as chance there. Points that known objects hide there
// (ObjectView::occluders) do not count, and the view weighs less. A hit whose distance no view
// determines stays where it is.
std::vector<ScanHit> rescore_in_views(const ObjectSearch& search, std::span<const ScanHit> hits,
                                      const ScanOptions& options);

// Whether a pose, in the camera frame of the last image, is not searched for.
using PoseFilter = std::function<bool(const Se3& camera_from_object)>;

// What pooled_hits keeps.
struct PoolOptions {
  ScanOptions scan;
  int support_views = 4;   // that rescore the hits of one image (support_views.h)
  std::size_t most = 1;    // hits that a quick rescoring keeps, ties included; from 1 up. Each
                           // scale gets its share_of_scale
  PoseFilter is_excluded;  // hits that are dropped; empty: none
};

// The hits of all images, `hits[i]` of images[i], each rescored in the other images (of many in
// those that support_views chooses), in the camera frame of the last one. An object may be one of
// thousands of hits in one image and be invisible in the next one: every further image ranks the
// hits of earlier ones better.
//
// A quick rescoring, at a third of the points and three of the five distances, keeps `most` of the
// hits that are not excluded. The ranks returned are those of the full rescoring. The hits of a
// single image stay as they are, however many, without the excluded ones.
std::vector<ScanHit> pooled_hits(const TemplateSet& set, std::span<const ObjectView> images,
                                 std::span<const std::span<const ScanHit>> hits, Backend& backend,
                                 const PoolOptions& options);

}  // namespace edgescout
