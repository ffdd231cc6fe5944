// The edges a mesh can show, prepared once: sharp creases, open borders and the fields from which
// the silhouette of a curved surface is drawn for each viewpoint (paper, Sec. 3.1).
#pragma once

#include <vector>

#include "host/core/types.h"
#include "kernels/depth_raster.h"

namespace edgescout {

struct EdgeModelOptions {
  // between face normals: a sharper edge is drawn, a flatter one is smooth surface; (0, 180)
  double crease_angle_deg = 25;
  double raster_step_m = 0;  // between raster points along an edge; 0: diameter / 80
  void validate() const;     // throws InputError naming the field and the violated bound
};

// A point of the paper's raster template, and the edge's unit direction there; object frame.
struct RasterPoint {
  Eigen::Vector3d point_m, tangent;
};

struct EdgeModel {
  // A sharp or open edge of the mesh, each once however many faces share it.
  struct Segment {
    Eigen::Vector3d from_m, to_m;
  };
  std::vector<Segment> creases;
  std::vector<RasterPoint> crease_points;  // along them
  // Normals at the corners of every triangle, averaged by area over the smooth surface around the
  // vertex: they stay apart across a crease. Only triangles whose corner normals differ can carry a
  // contour; `curved` lists them.
  std::vector<std::array<Eigen::Vector3d, 3>> corner_normals;
  std::vector<int> curved;

  Mesh mesh;
  double raster_step_m = 0;
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();  // of the bounding box
  double radius_m = 0;  // of the smallest sphere about the centre that holds the mesh

  // The mesh once more as the kernels take it.
  std::vector<float> vertices;
  std::vector<std::uint32_t> triangles;
  TriangleMesh triangle_mesh() const { return {vertices, triangles}; }
};

EdgeModel make_edge_model(const Mesh& mesh, const EdgeModelOptions& options = {});

// Appends what an edge from one place to another is sampled to. Short segments (a finely
// tessellated curve) get a point with the probability of their length, decided by where they lie,
// so that curves are sampled as densely as straight edges and equally in every run.
void add_raster_points(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m,
                       double raster_step_m, std::vector<RasterPoint>& points);

// Of its mesh, creases and raster step: what was made with a model of another one is not taken up
// with this (a batch's results, an active detection's state).
std::uint64_t fingerprint(const EdgeModel& model);

}  // namespace edgescout
