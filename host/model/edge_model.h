// All edges that a mesh can show, prepared once (paper, Sec. 3.1).
//
// They are sharp creases, open borders and the normals from which the contours of curved surfaces
// are computed for each viewpoint.
//
// Public header.
#pragma once

#include <vector>

#include "host/core/options.h"
#include "host/core/types.h"
#include "host/model/occluding_surface.h"
#include "kernels/depth_raster.h"
#include "kernels/pose_depth.h"

namespace edgescout {

struct EdgeModelOptions {
  // Between face normals. A sharper edge is drawn, a flatter one is smooth surface; [1, 179].
  double crease_angle_deg = 25;
  double raster_step_m = 0;  // between raster points along an edge; 0: diameter / 80
  void validate() const;     // InputError naming the field and the violated bound
};

void describe(EdgeModelOptions& options, OptionVisitor& visit);

// A point of the paper's raster template with the edge's unit direction there; object frame.
struct RasterPoint {
  Eigen::Vector3d point_m, tangent;
};

struct EdgeModel {
  // A sharp or open edge of the mesh. Each is listed once, however many faces share it.
  struct Segment {
    Eigen::Vector3d from_m, to_m;
    bool is_open_border = false;
  };
  std::vector<Segment> creases;
  std::vector<RasterPoint> crease_points;  // along them
  // Normals at the corners of every triangle, averaged by area over the smooth surface around the
  // vertex. They differ across a crease. `curved` lists the triangles whose corner normals differ:
  // only these can hold a contour.
  std::vector<std::array<Eigen::Vector3d, 3>> corner_normals;
  std::vector<int> curved;

  std::vector<SurfacePoint> surface_points;  // surface_points.h: sample_surface

  Mesh mesh;
  double raster_step_m = 0;
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();  // of the bounding box
  double radius_m = 0;  // of the smallest sphere about the centre that holds the mesh

  OccludingSurface occluding;  // what depth maps draw in place of the mesh
  TriangleMesh triangle_mesh() const { return {occluding.vertices_m, occluding.triangles}; }
};

// Finds the edges that a mesh can show and returns the model. InputError: options out of their
// bounds; the mesh shows no edge from anywhere.
EdgeModel make_edge_model(const Mesh& mesh, const EdgeModelOptions& options = {});

// Appends the samples of an edge between two points. A segment shorter than the step (of a finely
// tessellated curve) gets a point with a probability in proportion to its length. Its place
// decides, so curves are sampled as densely as straight edges and equally in every run.
void add_raster_points(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m,
                       double raster_step_m, std::vector<RasterPoint>& points);

// Returns a checksum of mesh, creases and raster step. Batches of results and states of active
// detection carry it: they are refused with a model of another fingerprint.
std::uint64_t fingerprint(const EdgeModel& model);

}  // namespace edgescout
