// Cropped distance maps of candidates seen from a view: for every pixel of a candidate's window,
// which of its visible edge points is nearest and how far off it is (paper, Sec. 5.2: "the distance
// maps for the N_obj object candidates").
//
// All positions are px of the *map*, the camera's image reduced by whatever the caller chose; pixel
// centres at integers. A map's pixel holds one word, d2 << 16 | point:
//   d2     squared distance from the pixel's centre to the nearest edge point, in (1/16 px)^2,
//   positions rounded to 1/16 px; point  its number among the candidate's edge points; of several
//   at one distance the first;
// or CANDIDATE_MAP_EMPTY where none lies within reach: round(sqrt(d2)) <= 254, so 15.9 px.
// Distances of the combination_chamfer kernel are one byte, round(sqrt(d2)), in 1/16 px; 255 is its
// cap. On a map reduced by 4 that is 64 px of the image.
//
// An edge point counts where its nearest pixel floor(x + 1/2), floor(y + 1/2) lies in the image, be
// it outside of the window: what the camera does not see is no edge. Windows may overhang the
// image; nobody looks there.
//
// Agreement: integers, equal on every path bit for bit. LogicError: an output of another size, edge
// points or pixels beyond their lists, more than CANDIDATE_MAP_MAX_EDGES edge points in a
// candidate, an image side above CANDIDATE_MAP_MAX_SIDE.
#ifndef EDGESCOUT_CANDIDATE_MAP_H
#define EDGESCOUT_CANDIDATE_MAP_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(CHAMFER_STEPS_PER_PX, 16);
EDGESCOUT_CONST(CHAMFER_CAP, 255);             // of a distance, in 1/16 px: no edge within reach
EDGESCOUT_CONST(CANDIDATE_MAP_REACH2, 64770);  // the largest d2 that rounds to 254
EDGESCOUT_CONST(CANDIDATE_MAP_EMPTY, 0xffffffffu);
EDGESCOUT_CONST(CANDIDATE_MAP_REACH_PX, 16);  // a window grown by it misses nothing
EDGESCOUT_CONST(CANDIDATE_MAP_MAX_EDGES, 16384);
EDGESCOUT_CONST(CANDIDATE_MAP_MAX_SIDE, 8192);
#ifdef __cplusplus
}  // namespace edgescout

#include <cstddef>
#include <cstdint>
#include <span>

namespace edgescout {

class ThreadPool;

// A visible edge point of a candidate, projected.
struct MapEdge {
  float x_px, y_px;
  float z_m;  // depth in the camera's frame
};

struct MapWindow {
  std::int32_t x0 = 0, y0 = 0;
  std::uint32_t width = 0, height = 0;
  std::size_t size() const { return std::size_t(width) * height; }
  // Place of a pixel among the window's; only where contains() holds.
  bool contains(int x, int y) const {
    return x >= x0 && y >= y0 && std::int64_t(x) < std::int64_t(x0) + width &&
           std::int64_t(y) < std::int64_t(y0) + height;
  }
  std::size_t index(int x, int y) const {
    return std::size_t(y - y0) * width + std::size_t(x - x0);
  }
};

// The box [x_min, x_max] x [y_min, y_max], px, of a candidate's surface and edge points, grown by
// the reach and cut to the image; without pixels where nothing is left.
MapWindow map_window(float x_min, float y_min, float x_max, float y_max, int width, int height);

// One candidate seen from one view: where its edge points and its pixels lie in the lists.
struct CandidateMap {
  MapWindow window;
  std::uint32_t first_pixel =
      0;  // of `nearest`, and of every other list of pixels with this layout
  std::uint32_t first_edge = 0, edge_count = 0;
};

// A pixel's distance in 1/16 px from its word: round(sqrt(d2)), exactly; CHAMFER_CAP where the word
// is empty.
std::uint32_t chamfer_steps(std::uint32_t word);

// The pixel nearest to a place on the map; false outside of the image (and for what is no number).
bool nearest_pixel(float x_px, float y_px, int width, int height, int& x, int& y);

// What every path asks of its input; throws LogicError.
void check_candidate_maps(std::size_t edges, std::span<const CandidateMap> maps, int width,
                          int height, std::size_t pixels);

// `maps` are candidates of any number of views with images of width * height; every pixel of their
// windows is written.
void candidate_map_reference(std::span<const MapEdge> edges, std::span<const CandidateMap> maps,
                             int width, int height, std::span<std::uint32_t> nearest);
void candidate_map_fast(std::span<const MapEdge> edges, std::span<const CandidateMap> maps,
                        int width, int height, std::span<std::uint32_t> nearest, ThreadPool& pool);

}  // namespace edgescout
#endif
#endif
