// Which points of an object a camera sees, by a depth map of the object (paper, Sec. 3.1).
//
// Every job draws the mesh into a map of its own (depth_raster.h) and looks at the object's shared
// points and at points of its own. A point projects into the map at pixel
//   (floor(fx x / z + cx + 1/2), floor(fy y / z + cy + 1/2)).
// It is visible if one of the 3 x 3 pixels around shows a depth of at least z - tolerance_m, or
// nothing. It borders the background if one of them shows nothing. A pixel at the map's border or
// outside it makes both true. A point that does not lie in front of the camera has no flags.
//
// Agreement: flags are equal where no coordinate before the floor lies within 1e-3 of a whole
// number, no depth within 1e-5 of its share of z - tolerance_m, and the maps agree.
//
// Device: a workgroup looks at POINT_VISIBILITY_GROUP points of one job, the shared ones first.
// Buffers: 0 depth maps, 1 points (float, xyz), 2 jobs (VisibilityJob), 3 flags: for each workgroup
// of a job two words of visible points, then two of bordering ones, from the job's first_word on.
#ifndef EDGESCOUT_POINT_VISIBILITY_H
#define EDGESCOUT_POINT_VISIBILITY_H

#include "interop.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(POINT_VISIBILITY_GROUP, 64);
EDGESCOUT_CONST(POINT_VISIBILITY_WORDS, 4);  // of a workgroup
EDGESCOUT_CONST(VISIBILITY_JOB_WORDS, 20);

struct PointVisibilityPush {
  uint size;  // of a map, px
  uint shared_points;
  uint jobs;
};
#ifdef __cplusplus
}  // namespace edgescout

#include <cstdint>
#include <span>

#include "kernels/depth_raster.h"

namespace edgescout {

struct VisibilityJob {
  Pose camera_from_object;
  Intrinsics intrinsics;      // of the map
  float tolerance_m;          // from 0 up
  std::uint32_t first_point;  // of its own points
  std::uint32_t point_count;
  std::uint32_t first_word = 0;  // a device's own; callers leave it
};

inline constexpr std::uint8_t POINT_VISIBLE = 1, POINT_BORDERS_BACKGROUND = 2;

// Points of an object, xyz triples: the first `shared` ones are looked at by every job.
struct VisibilityPoints {
  std::span<const float> points_m;
  std::uint32_t shared;
};

// How many flags the jobs have: for each one of every shared point, then of its own.
std::size_t flag_count(const VisibilityPoints& points, std::span<const VisibilityJob> jobs);

// LogicError: a map without pixels or one larger than 4096, points beyond the list, another number
// of flags, a triangle of vertices beyond the list.
void check_point_visibility(const TriangleMesh& mesh, const VisibilityPoints& points,
                            std::span<const VisibilityJob> jobs, int size, std::size_t flags);

// Maps are square, `size` px wide.
void point_visibility_reference(const TriangleMesh& mesh, const VisibilityPoints& points,
                                std::span<const VisibilityJob> jobs, int size,
                                std::span<std::uint8_t> flags);
void point_visibility_fast(const TriangleMesh& mesh, const VisibilityPoints& points,
                           std::span<const VisibilityJob> jobs, int size,
                           std::span<std::uint8_t> flags, ThreadPool& pool);

}  // namespace edgescout
#endif
#endif
