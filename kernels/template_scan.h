// The scan of a template set: every template projected at the middle of every region of an image,
// scored at the region's anchors (paper, Eqs. 1 and 7).
//
// A region is a rectangle of anchors for each distance. Of a set with D distances, template number
// t stands at distance t % D and has turn t / D, which is viewpoint * in_plane_steps + step. With
// the region's `turned` pose of that turn, whose translation has the object's centre at the camera,
//   camera_from_object = turned + (distance * ray) in the translation, in float.
// Its points are those of its viewpoint, projected as template_project.h says, at the region's
// middle. Its hit is that of template_score.h, over the region's anchors for its distance.
//
// A template has no hit, but sum TEMPLATE_SCAN_NONE, where a point lies nearer than nearest_m,
// where it has no points, where the region has no anchors for its distance, and where its number is
// TEMPLATE_SCAN_NONE.
//
// Agreement: for equal projected points sums and anchors are equal. Points differ as
// template_project.h says.
//
// Device: template_planes.comp turns the tensor into the planes that template_scan.comp reads, u8
// in units of template_score.h. Words hold four anchors side by side, `anchor_step` apart. There
// are four copies of all planes, each shifted by one more byte, so that four anchors are one word
// wherever a point falls:
//   word(copy, bin, y, r, w), byte k: the value of `bin` at
//     x = (4 w + copy + k) anchor_step + r - left,  y - top,
//   index = (((copy (bins + 1) + bin) rows + y) anchor_step + r) stride + w.
// Outside the image a value is TEMPLATE_SCORE_OUTSIDE; so is all of the last plane, bin = `bins`.
// One workgroup of template_scan.comp scores one template in one region, by blocks of
// TEMPLATE_SCAN_COLUMNS x TEMPLATE_SCAN_ROWS anchors.
//
// Specialization constants of template_scan.comp: 0 invocations a workgroup, a multiple of 8 and at
// most 128. Buffers: 0 planes (a uniform texel buffer), 1 model points' planes (float), 2 input
// (words, TemplateScanPush says where), 3 hits (one word: sum << TEMPLATE_SCAN_ANCHOR_BITS |
// anchor, in the order of rows). template_planes.comp: constant 0 the tensor's bands; buffers 0..3
// its bands, 4 planes.
#ifndef EDGESCOUT_TEMPLATE_SCAN_H
#define EDGESCOUT_TEMPLATE_SCAN_H

#include "tensor_bands.h"

#ifdef __cplusplus
namespace edgescout {
#endif
EDGESCOUT_CONST(TEMPLATE_SCAN_NONE, 0xffffffffu);
EDGESCOUT_CONST(TEMPLATE_SCAN_COLUMNS, 32);
EDGESCOUT_CONST(TEMPLATE_SCAN_ROWS, 16);
EDGESCOUT_CONST(TEMPLATE_SCAN_ANCHOR_BITS, 13);
EDGESCOUT_CONST(TEMPLATE_SCAN_REGION_WORDS, 5);   // TemplateRegion
EDGESCOUT_CONST(TEMPLATE_SCAN_ANCHORS_WORDS, 4);  // TemplateAnchors
EDGESCOUT_CONST(TEMPLATE_PLANES_GROUP, 64);

// Where the planes hold what.
struct TemplatePlanesGrid {
  uint rows;    // with `top` above and below the image
  uint stride;  // words a row of one remainder
  uint left;    // px beside the image
  uint top;
  uint anchor_step;
};

struct TemplatePlanesPush {
  TensorGrid tensor;
  TemplatePlanesGrid planes;
  uint word_count;  // of a copy
};

struct TemplateScanPush {
  TemplatePlanesGrid planes;
  uint width;
  uint height;
  uint bins;
  float fx;
  float fy;
  float cx;
  float cy;
  float nearest_m;
  uint point_count;  // of a plane of model points
  uint in_plane_steps;
  uint distances;
  uint turns;
  uint templates;  // scored in each region
  uint most_columns;
  uint most_rows;
  // First words in the input: viewpoints' ranges at 0, then these.
  uint distances_at;
  uint numbers_at;        // of all regions, or one region after the other
  uint numbers_a_region;  // 0: all regions have the same
  uint regions_at;
  uint anchors_at;
  uint turned_at;
};
#ifdef __cplusplus
}  // namespace edgescout

#include <span>
#include <vector>

#include "kernels/template_project.h"
#include "kernels/template_score.h"

namespace edgescout {

struct ViewpointPoints {  // of a viewpoint, among the model points
  std::uint32_t first, count;
};

struct TemplateRegion {
  float middle_x_px, middle_y_px;
  float ray_x, ray_y, ray_z;  // towards the middle, of length 1
};

struct TemplateAnchors {
  std::int32_t x0, y0;
  std::uint32_t columns, rows;  // 0 columns: none
};

// Refers to data of the caller.
struct TemplateScan {
  TemplateProjectOptions project;
  int anchor_step = 1;
  std::uint32_t in_plane_steps = 1;
  std::span<const ViewpointPoints> viewpoints;
  std::span<const float> distances_m;
  std::span<const TemplateRegion> regions;
  std::span<const TemplateAnchors> anchors;  // [region][distance]
  std::span<const Pose> turned;              // [region][turn]
  // Templates to score: the same for all regions, or [region][place].
  std::span<const std::uint32_t> numbers;
  bool same_numbers = true;

  std::size_t turns() const { return viewpoints.size() * in_plane_steps; }
  std::size_t templates() const {  // in each region
    return same_numbers || regions.empty() ? numbers.size() : numbers.size() / regions.size();
  }
  std::size_t hits() const { return regions.size() * templates(); }
  std::uint32_t number(std::size_t region, std::size_t place) const {
    return numbers[same_numbers ? place : region * templates() + place];
  }
  const ViewpointPoints& points_of(std::uint32_t number) const {
    return viewpoints[number / distances_m.size() / in_plane_steps];
  }
  const TemplateAnchors& anchors_of(std::size_t region, std::uint32_t number) const {
    return anchors[region * distances_m.size() + number % distances_m.size()];
  }
  // Whether a template has points and anchors.
  bool has(std::size_t region, std::uint32_t number) const;
  // Of a template of a region; its points go to `first_projected` and what follows.
  TemplateProjectJob projection(std::size_t region, std::uint32_t number,
                                std::uint32_t first_projected) const;
};

// LogicError: lists whose sizes do not fit together, and what check_template_project() and
// check_template_jobs() refuse.
void check_template_scan(std::uint32_t points, const TemplateScan& scan, std::size_t hits);

// `hits`: [region][place].
void template_scan_reference(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                             const ModelPointPlanes& points, const TemplateScan& scan,
                             std::span<TemplateHit> hits);
void template_scan_fast(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                        const ModelPointPlanes& points, const TemplateScan& scan,
                        std::span<TemplateHit> hits, ThreadPool& pool);

// The templates of one region that have points and anchors, as template_project and template_score
// take them.
struct RegionJobs {
  std::vector<std::uint32_t> places;  // among the region's hits
  std::vector<TemplateProjectJob> projections;
  std::vector<TemplateJob> jobs;
  std::size_t point_count = 0;  // of all projections
};
RegionJobs region_jobs(const TemplateScan& scan, std::size_t region);
// The hits of a region from those of its jobs; `too_near` as template_project counts them.
void place_hits(const RegionJobs& jobs, std::span<const std::uint32_t> too_near,
                std::span<const TemplateHit> of_jobs, std::span<TemplateHit> hits);

// By project(jobs, projected, too_near) and score(jobs, projected, hits of the jobs).
template <class Project, class Score>
void scan_by_parts(const TemplateScan& scan, std::span<TemplateHit> hits, const Project& project,
                   const Score& score) {
  for (std::size_t region = 0; region < scan.regions.size(); ++region) {
    const RegionJobs jobs = region_jobs(scan, region);
    std::vector<TemplatePoint> projected(jobs.point_count);
    std::vector<std::uint32_t> too_near(jobs.jobs.size());
    std::vector<TemplateHit> of_jobs(jobs.jobs.size());
    project(jobs, std::span(projected), std::span(too_near));
    score(jobs, std::span(projected), std::span(of_jobs));
    place_hits(jobs, too_near, of_jobs, hits.subspan(region * scan.templates(), scan.templates()));
  }
}

}  // namespace edgescout
#endif
#endif
