// Depth maps of triangle meshes under many poses: the z-buffer of the paper's Sec. 3.1.
//
// Pixel (x, y) of a job's map holds the smallest camera-frame z, metres, of the triangles whose
// projection covers the pixel centre (edge functions >= 0, both windings), or DEPTH_EMPTY. Depth is
// interpolated as 1/z. Triangles with a vertex nearer than DEPTH_NEAR_M, or nowhere (not finite),
// are dropped: callers keep the object in front of the camera. Triangles seen exactly edge-on cover
// nothing.
//
// Agreement: a pixel centre within 1/64 px of a triangle's edge may fall on either side; elsewhere
// depths agree to 1e-5 relative, as long as no triangle spans more than a factor of 30 in depth.
// LogicError: an output of another size, an index beyond the vertices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "kernels/types.h"

namespace edgescout {

class ThreadPool;

inline constexpr float DEPTH_EMPTY = std::numeric_limits<float>::infinity();
inline constexpr float DEPTH_NEAR_M = 1e-3f;

struct TriangleMesh {
  std::span<const float> vertices_m;         // xyz triples
  std::span<const std::uint32_t> triangles;  // index triples
};

// All maps of one call have one size; each job has its own camera (a window of the image, say).
struct DepthJob {
  Pose camera_from_object;
  Intrinsics intrinsics;
};

// What both check before they draw; throws LogicError.
void check_depth_raster(const TriangleMesh& mesh, std::size_t jobs, int width, int height,
                        std::size_t depth_size);

// `depth` holds jobs.size() maps of width * height, one after the other.
void depth_raster_reference(const TriangleMesh& mesh, std::span<const DepthJob> jobs, int width,
                            int height, std::span<float> depth);
void depth_raster_fast(const TriangleMesh& mesh, std::span<const DepthJob> jobs, int width,
                       int height, std::span<float> depth, ThreadPool& pool);
// One map of it on the calling thread; nothing is checked.
void draw_depth_map(const TriangleMesh& mesh, const DepthJob& job, int width, int height,
                    std::span<float> depth);

}  // namespace edgescout
