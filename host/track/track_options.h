// Options of tracking (tracker.h).
//
// Public header.
#pragma once

#include "host/core/options.h"
#include "host/pipeline.h"
#include "host/register/refine.h"

namespace edgescout {

struct TrackOptions {
  int max_points = 300;       // of each object, searched along their normals
  double search_px = 8;       // to both sides of the predicted edges
  double far_search_px = 24;  // where that finds too little, on the image of half the size
  double min_contrast = 3;    // of an edge, grey levels per px
  // Share of the points on edges, above what chance gives (normal_fit.h), from which a pose counts
  // as tracked. Below `lost_above_chance` the measured pose is discarded for the predicted one.
  double tracked_above_chance = 0.5;
  double lost_above_chance = 0.2;
  bool register_doubtful = true;  // doubtful poses are registered in a cropped tensor
  double min_probability = 0.4;   // of a registered or a searched pose
  int doubtful_frames = 10;       // in a row, after which an object is lost
  int instances = 1;              // of each object that search() looks for
  RefineOptions refine;           // of doubtful poses
  PipelineOptions pipeline;       // of search() and of the edges of doubtful poses
  void validate() const;          // InputError naming the field and the violated bound
};

// Names to `visit` the options of tracking alone.
void describe(TrackOptions& options, OptionVisitor& visit);
// Names to `visit` every option, with those of the search.
void describe_track(TrackOptions& options, OptionVisitor& visit);

}  // namespace edgescout
