// Edges of an image near the projected edges of a model, searched along the normals.
//
// Through every visible model point runs a line along the normal of its edge. The grey values on it
// are differentiated; every local extremum is an edge at a signed distance. So a pose near the
// right one is found from some hundred short lines, without edges or tensors of the whole image
// (Harris, RAPID, 1990; Drummond and Cipolla, PAMI 2002). A line may cross several edges: all are
// kept (Vacchetti et al., ISMAR 2004).
//
// Lines follow the lens: images are searched as they are, distances are those of the ideal image.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/core/types.h"
#include "kernels/types.h"

namespace edgescout {

struct MeasuredDepth;  // register/measured_depth.h

// An image and its camera; of half the size where a search reaches far.
struct SearchedImage {
  const Image* image = nullptr;
  Camera camera;                         // with its lens, of the full image
  Camera ideal;                          // undistorted(camera)
  double px_per_sample = 1;              // px of the full image per px of `image`
  const MeasuredDepth* depth = nullptr;  // of `ideal`; null: nothing was measured
};
SearchedImage searched(const Image& image, const Camera& camera,
                       const MeasuredDepth* depth = nullptr);

struct LineEdge {
  float offset_px;  // along the normal, ideal image
  float contrast;   // by which grey rises along the normal there, levels per sample
};

// A model point whose line lies in the image.
struct LinePoint {
  ModelPoint model;
  double u_px, v_px, nx, ny;         // ideal projection and normal at the pose of the search
  std::uint32_t first = 0, end = 0;  // its edges: [first, end) of NormalSearch::edges
  float expected_contrast = 0;       // of its edge; 0: unknown
};

struct NormalSearch {
  std::vector<LinePoint> points;
  std::vector<LineEdge> edges;
  double reach_px = 0;

  std::span<const LineEdge> edges_of(const LinePoint& point) const {
    return std::span(edges).subspan(point.first, point.end - point.first);
  }
};

struct NormalSearchOptions {
  double reach_px = 8;     // to both sides
  float min_contrast = 3;  // levels per sample
};

// `expected_contrasts`: of every point, or empty.
NormalSearch search_normals(const SearchedImage& image, const Se3& camera_from_object,
                            std::span<const ModelPoint> points,
                            std::span<const float> expected_contrasts,
                            const NormalSearchOptions& options);

// The contrast of the image across the edge of every point: what the search in the next image
// expects. 0 where the line leaves the image.
std::vector<float> contrasts_at(const SearchedImage& image, const Se3& camera_from_object,
                                std::span<const ModelPoint> points);

}  // namespace edgescout
