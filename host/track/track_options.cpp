#include "host/track/track_options.h"

namespace edgescout {

void describe(TrackOptions& o, OptionVisitor& visit) {
  visit.group("Tracking");
  visit.number(
      {"instances", "Number of instances of each object that are searched for", OptionLevel::Basic},
      o.instances, 1, 1000);
  visit.number({"track-points", "Most points of an object that are searched along their normals"},
               o.max_points, 20, 100000);
  visit.number({"search-px", "Reach of the search to both sides of predicted edges, px"},
               o.search_px, 4.0, 50.0);
  visit.number({"far-search-px",
                "Reach of the search in the image of half the size, where the first finds too "
                "little, px"},
               o.far_search_px, 4.0, 100.0);
  visit.number({"track-contrast", "Least contrast of an edge, grey levels per px"}, o.min_contrast,
               0.5, 100.0);
  visit.number({"tracked-above-chance",
                "Share of the points on edges, above chance, from which a pose counts as tracked"},
               o.tracked_above_chance, 0.0, 1.0);
  visit.number({"lost-above-chance",
                "Share of the points on edges, above chance, below which the predicted pose is "
                "kept in place of the measured one"},
               o.lost_above_chance, 0.0, 1.0);
  visit.off_flag(
      {"no-register", "Do not register doubtful poses in a tensor of their surroundings"},
      o.register_doubtful);
  visit.number({"doubtful-frames", "Doubtful frames in a row after which an object is lost"},
               o.doubtful_frames, 0, 100000);
}

void describe_track(TrackOptions& o, OptionVisitor& visit) {
  describe(o, visit);
  describe(o.pipeline, visit);
}

void TrackOptions::validate() const {
  TrackOptions copy = *this;
  BoundsCheck in("track");
  describe(copy, in);
  in.require("min_probability", min_probability, 0, 1);
  refine.validate();
  pipeline.validate();
}

}  // namespace edgescout
