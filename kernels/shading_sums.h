// Sums by which the grey values inside a pose's silhouette are explained from its surface.
//
// A job draws the depth map of a mesh (depth_raster.h), SHADING_MAP_PX px square. Its pixel (i, j)
// is image pixel (x_px + stride_px i, y_px + stride_px j), so that samples need no interpolation:
// with the view's camera (fx, fy, cx, cy) and s = stride_px the map has
//   fx / s, fy / s, (cx - x_px) / s, (cy - y_px) / s.
//
// On a plane inverse depth w = 1 / z is affine in the pixel. A pixel of the map that is not at its
// border counts where its image pixel lies in the image and
// - the 3 x 3 pixels around it all show the mesh,
// - |w(i-1, j) + w(i+1, j) - 2 w(i, j)| <= SHADING_MAX_BEND w(i, j), the same along j: no edge, no
//   other surface,
// - no known surface may hide it: it lies behind the camera, its projection into the map of known
//   surfaces, rounded to a pixel, lies at that map's border or outside, or none of the 3 x 3 pixels
//   around shows less than z - tolerance_m. Without such a map nothing is hidden.
// Its normal n is (a, b, c) / |(a, b, c)| with
//   a = fx (w(i+1, j) - w(i-1, j)) / 2,  b = fy (w(i, j+1) - w(i, j-1)) / 2,
//   c = w(i, j) - a (i - cx) / fx - b (j - cy) / fy   of the map's camera.
// With the nine spherical harmonics
//   h(n) = 1, x, y, z, xy, yz, zx, xx - yy, 3 zz - 1
// and the image's grey g, the sums over the pixels that count are
//   system   h h^T, the upper triangle row by row
//   right    g h
//   pixels, grey, squares   1, g, g^2
// All are 0 in a view without an image.
//
// Agreement: pixels, grey and squares differ by the pixels that lie on a limit above or that the
// depth maps draw differently; the other sums by these, by 1e-5 max(fx, fy) of a pixel's part for
// each pixel (depths agree to 1e-5 relative) and by 1e-5 of the sum of absolute parts (float).
#ifndef EDGESCOUT_SHADING_SUMS_H
#define EDGESCOUT_SHADING_SUMS_H

#include <cstdint>
#include <span>

#include "kernels/depth_raster.h"
#include "kernels/pose_depth.h"
#include "kernels/shading_sums_push.h"
#include "kernels/types.h"

namespace edgescout {

class ThreadPool;

inline constexpr double SHADING_MAX_BEND = 4e-3;

struct ShadingJob {
  Pose camera_from_object;
  std::int32_t x_px, y_px;  // of the map's first pixel; within 1e6 of 0
  std::uint32_t stride_px;  // 1 to 1000
  std::uint32_t view;
};

struct ShadingSums {
  double system[SHADING_SYSTEM] = {};
  double right[SHADING_HARMONICS] = {};
  double pixels = 0, grey = 0, squares = 0;
};

// One view as the CPU reads it. Images without pixels: a view without one.
struct ShadingView {
  ImageView image;
  Intrinsics intrinsics;
  DepthView known;  // DEPTH_EMPTY where nothing is known; width 0: nothing is known anywhere
};

// The camera of a job's map.
Intrinsics shading_map_camera(const ShadingJob& job, const Intrinsics& view);

// LogicError: a view beyond the list, a place or stride out of range, a tolerance that is negative
// or no number, another number of results, an index beyond the vertices.
void check_shading_sums(std::size_t views, const TriangleMesh& mesh,
                        std::span<const ShadingJob> jobs, float tolerance_m, std::size_t results);

void shading_sums_reference(std::span<const ShadingView> views, const TriangleMesh& mesh,
                            std::span<const ShadingJob> jobs, float tolerance_m,
                            std::span<ShadingSums> out);
void shading_sums_fast(std::span<const ShadingView> views, const TriangleMesh& mesh,
                       std::span<const ShadingJob> jobs, float tolerance_m,
                       std::span<ShadingSums> out, ThreadPool& pool);

}  // namespace edgescout
#endif
