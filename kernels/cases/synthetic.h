// Synthetic input of the benchmark, from fixed seeds.
#pragma once

#include <random>
#include <vector>

#include "kernels/depth_raster.h"
#include "kernels/pose_normal_equations.h"
#include "kernels/template_score.h"
#include "kernels/types.h"

namespace edgescout::bench {

// Points a pixel apart on random segments of 15 to 90 px.
std::vector<EdgePoint> random_segments(std::mt19937& rng, int width, int height, int points);
// Overlapping discs under a little noise.
std::vector<std::uint8_t> disc_image(std::mt19937& rng, int width, int height);

struct Templates {
  std::vector<TemplatePoint> points;
  std::vector<TemplateJob> jobs;
};
// Closed outlines of 60 to 200 points, each tried on columns * rows anchors somewhere in the image.
Templates random_templates(std::mt19937& rng, int width, int height, int bins, int count,
                           std::uint32_t columns, std::uint32_t rows);

struct Poses {
  std::vector<ModelPoint> points;
  std::vector<PoseProblem> problems;
};
// One cloud of edge points under many poses about 0.4 m in front of the camera.
Poses random_poses(std::mt19937& rng, int problems, int points);

struct Mesh {
  std::vector<float> vertices_m;
  std::vector<std::uint32_t> triangles;
  TriangleMesh view() const { return {vertices_m, triangles}; }
};
// A bumpy ball of 0.1 m with 2 * rings * segments triangles.
Mesh bumpy_ball(int rings, int segments);
std::vector<DepthJob> views_around(int count, int width, int height);

}  // namespace edgescout::bench
