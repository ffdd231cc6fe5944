// Push-constant structs are written once and read by GLSL and C++: name and offset of every member
// as the compiled shader has them must be those C++ has.
#ifdef EDGESCOUT_VULKAN
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "candidate_map.spv.h"
#include "chamfer_masks.spv.h"
#include "chamfer_rows.spv.h"
#include "chamfer_sums.spv.h"
#include "dcd_seed.spv.h"
#include "dcd_sweep.spv.h"
#include "depth_raster.spv.h"
#include "distance_pass.spv.h"
#include "edge_gradient.spv.h"
#include "edge_link.spv.h"
#include "edge_support.spv.h"
#include "edge_thin.spv.h"
#include "information_columns.spv.h"
#include "information_rows.spv.h"
#include "kernels/candidate_map_push.h"
#include "kernels/chamfer_push.h"
#include "kernels/dcd_seed.h"
#include "kernels/dcd_sweep.h"
#include "kernels/depth_raster_push.h"
#include "kernels/distance_pass.h"
#include "kernels/edge_link.h"
#include "kernels/edge_support_push.h"
#include "kernels/information_push.h"
#include "kernels/point_visibility.h"
#include "kernels/pose_depth_push.h"
#include "kernels/pose_push.h"
#include "kernels/shading_sums_push.h"
#include "kernels/support_map_push.h"
#include "kernels/template_project.h"
#include "kernels/template_scan.h"
#include "kernels/template_score_push.h"
#include "point_visibility.spv.h"
#include "pose_depth.spv.h"
#include "pose_normal_equations.spv.h"
#include "pose_score.spv.h"
#include "shading_sums.spv.h"
#include "support_map.spv.h"
#include "template_planes.spv.h"
#include "template_project.spv.h"
#include "template_scan.spv.h"
#include "template_score.spv.h"

namespace edgescout {
namespace {

// name and offset, nested ones as "grid.width"
using Members = std::vector<std::pair<std::string, std::size_t>>;

// As much of a SPIR-V module as says where its push constants lie.
class Module {
 public:
  explicit Module(std::span<const std::uint32_t> words) {
    constexpr std::size_t header = 5;
    for (std::size_t i = header; i < words.size(); i += words[i] >> 16)
      read(words.subspan(i, words[i] >> 16));
  }
  // The block wraps the shared struct as its only member.
  Members push_constants() const {
    Members members;
    collect(struct_members_.at(pointee_.at(push_type_)).at(0), "", 0, members);
    return members;
  }

 private:
  enum Op : std::uint32_t {
    member_name = 6,
    type_struct = 30,
    type_pointer = 32,
    variable = 59,
    member_decorate = 72
  };

  void read(std::span<const std::uint32_t> op) {
    constexpr std::uint32_t storage_push_constant = 9, decoration_offset = 35;
    switch (op[0] & 0xffffu) {
      case member_name:
        names_[{op[1], op[2]}] = reinterpret_cast<const char*>(&op[3]);
        break;
      case type_struct:
        struct_members_[op[1]] = {op.begin() + 2, op.end()};
        break;
      case type_pointer:
        pointee_[op[1]] = op[3];
        break;
      case variable:
        if (op[3] == storage_push_constant) push_type_ = op[1];
        break;
      case member_decorate:
        if (op[3] == decoration_offset) offsets_[{op[1], op[2]}] = op[4];
        break;
      default:
        break;
    }
  }

  void collect(std::uint32_t type, const std::string& prefix, std::size_t base,
               Members& members) const {
    const std::vector<std::uint32_t>& types = struct_members_.at(type);
    for (std::uint32_t m = 0; m < types.size(); ++m) {
      const std::string name = prefix + names_.at({type, m});
      const std::size_t offset = base + offsets_.at({type, m});
      if (struct_members_.contains(types[m]))
        collect(types[m], name + ".", offset, members);
      else
        members.emplace_back(name, offset);
    }
  }

  using Member = std::pair<std::uint32_t, std::uint32_t>;  // struct, index
  std::map<Member, std::string> names_;
  std::map<Member, std::uint32_t> offsets_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> struct_members_;
  std::map<std::uint32_t, std::uint32_t> pointee_;
  std::uint32_t push_type_ = 0;
};

#define MEMBER(name) \
  { #name, offsetof(Push, name) }
#define GRID_MEMBERS                                                                      \
  MEMBER(grid.width), MEMBER(grid.height), MEMBER(grid.bins), MEMBER(grid.tiles_per_row), \
      MEMBER(grid.band_rows)
#define TENSOR_MEMBERS                                                                            \
  MEMBER(tensor.width), MEMBER(tensor.height), MEMBER(tensor.bins), MEMBER(tensor.tiles_per_row), \
      MEMBER(tensor.band_rows)
#define PLANES_MEMBERS                                                                 \
  MEMBER(planes.rows), MEMBER(planes.stride), MEMBER(planes.left), MEMBER(planes.top), \
      MEMBER(planes.anchor_step)
#define CAMERA_MEMBERS                                                        \
  MEMBER(camera.fx), MEMBER(camera.fy), MEMBER(camera.cx), MEMBER(camera.cy), \
      MEMBER(camera.min_depth_m)

// All members are 32 bits wide, so equal lists of the whole size leave no gap.
template <class Push>
void expect_members(std::span<const std::uint32_t> spirv, const Members& expected) {
  EXPECT_EQ(Module(spirv).push_constants(), expected);
  EXPECT_EQ(sizeof(Push), 4 * expected.size());
  EXPECT_LE(sizeof(Push), 128u) << "what every device takes";
}

TEST(PushConstants, DcdSeed) {
  using Push = DcdSeedPush;
  expect_members<Push>(dcd_seed_spv, {MEMBER(point_count), MEMBER(width), MEMBER(height),
                                      MEMBER(bins), MEMBER(words_per_row), MEMBER(cell_columns),
                                      MEMBER(cell_rows), MEMBER(bins_per_rad)});
}

TEST(PushConstants, DistancePass) {
  using Push = DistancePassPush;
  expect_members<Push>(
      distance_pass_spv,
      {MEMBER(width), MEMBER(bins), MEMBER(tiles_per_row), MEMBER(first_row), MEMBER(row_count),
       MEMBER(cell_columns), MEMBER(cell_rows), MEMBER(reach_cells), MEMBER(cap)});
}

TEST(PushConstants, DcdSweep) {
  using Push = DcdSweepPush;
  expect_members<Push>(
      dcd_sweep_spv, {MEMBER(tile_count), MEMBER(bins), MEMBER(step), MEMBER(cap), MEMBER(reach)});
}

TEST(PushConstants, TemplateProject) {
  using Push = TemplateProjectPush;
  expect_members<Push>(template_project_spv,
                       {MEMBER(fx), MEMBER(fy), MEMBER(cx), MEMBER(cy), MEMBER(nearest_m),
                        MEMBER(bins), MEMBER(point_count), MEMBER(job_count)});
}

TEST(PushConstants, PointVisibility) {
  using Push = PointVisibilityPush;
  expect_members<Push>(point_visibility_spv, {MEMBER(size), MEMBER(shared_points), MEMBER(jobs)});
}

TEST(PushConstants, TemplatePlanes) {
  using Push = TemplatePlanesPush;
  expect_members<Push>(template_planes_spv, {TENSOR_MEMBERS, PLANES_MEMBERS, MEMBER(word_count)});
}

TEST(PushConstants, TemplateScan) {
  using Push = TemplateScanPush;
  expect_members<Push>(template_scan_spv, {PLANES_MEMBERS,
                                           MEMBER(width),
                                           MEMBER(height),
                                           MEMBER(bins),
                                           MEMBER(fx),
                                           MEMBER(fy),
                                           MEMBER(cx),
                                           MEMBER(cy),
                                           MEMBER(nearest_m),
                                           MEMBER(point_count),
                                           MEMBER(in_plane_steps),
                                           MEMBER(distances),
                                           MEMBER(turns),
                                           MEMBER(templates),
                                           MEMBER(most_columns),
                                           MEMBER(most_rows),
                                           MEMBER(distances_at),
                                           MEMBER(numbers_at),
                                           MEMBER(numbers_a_region),
                                           MEMBER(regions_at),
                                           MEMBER(anchors_at),
                                           MEMBER(turned_at)});
}

TEST(PushConstants, TemplateScore) {
  using Push = TemplateScorePush;
  expect_members<Push>(template_score_spv, {GRID_MEMBERS, MEMBER(job_count), MEMBER(anchor_step)});
}

TEST(PushConstants, PoseNormalEquations) {
  using Push = PoseSystemPush;
  expect_members<Push>(pose_normal_equations_spv,
                       {GRID_MEMBERS, CAMERA_MEMBERS, MEMBER(min_foreshortening),
                        MEMBER(first_problem), MEMBER(parts), MEMBER(loss), MEMBER(scale_px)});
}

TEST(PushConstants, PoseScore) {
  using Push = PoseScorePush;
  expect_members<Push>(pose_score_spv,
                       {GRID_MEMBERS, CAMERA_MEMBERS, MEMBER(first_problem), MEMBER(parts),
                        MEMBER(has_gradient), MEMBER(min_gradient), MEMBER(match_px)});
}

TEST(PushConstants, PoseDepth) {
  using Push = PoseDepthPush;
  expect_members<Push>(
      pose_depth_spv,
      {CAMERA_MEMBERS, MEMBER(width), MEMBER(height), MEMBER(first_problem), MEMBER(parts),
       MEMBER(min_facing), MEMBER(band_sigmas), MEMBER(noise_floor_m), MEMBER(noise_per_m),
       MEMBER(surface_m), MEMBER(band_m), MEMBER(loss_scale)});
}

TEST(PushConstants, EdgeSupport) {
  using Push = EdgeSupportPush;
  expect_members<Push>(edge_support_spv, {MEMBER(width), MEMBER(height), MEMBER(first_problem),
                                          MEMBER(problem_count)});
}

TEST(PushConstants, ShadingSums) {
  using Push = ShadingPush;
  expect_members<Push>(shading_sums_spv, {MEMBER(width), MEMBER(height), MEMBER(known_width),
                                          MEMBER(known_height), MEMBER(known_fx), MEMBER(known_fy),
                                          MEMBER(known_cx), MEMBER(known_cy), MEMBER(tolerance_m),
                                          MEMBER(max_bend), MEMBER(first_job), MEMBER(job_count)});
}

TEST(PushConstants, SupportMap) {
  using Push = SupportMapPush;
  expect_members<Push>(support_map_spv, {MEMBER(width), MEMBER(height)});
}

TEST(PushConstants, DepthRaster) {
  using Push = DepthRasterPush;
  expect_members<Push>(depth_raster_spv,
                       {MEMBER(triangle_count), MEMBER(width), MEMBER(height), MEMBER(near_m),
                        MEMBER(band_rows), MEMBER(first_triangle)});
}

TEST(PushConstants, CandidateMap) {
  using Push = CandidateMapPush;
  expect_members<Push>(candidate_map_spv,
                       {MEMBER(tile_count), MEMBER(width), MEMBER(height), MEMBER(most_edges)});
}

TEST(PushConstants, CombinationChamfer) {
  using Push = ChamferPush;
  for (const std::span<const std::uint32_t> spirv :
       {std::span<const std::uint32_t>(chamfer_masks_spv),
        std::span<const std::uint32_t>(chamfer_rows_spv),
        std::span<const std::uint32_t>(chamfer_sums_spv)})
    expect_members<Push>(spirv, {MEMBER(count), MEMBER(words), MEMBER(first_word),
                                 MEMBER(column_words), MEMBER(combinations), MEMBER(cap)});
}

TEST(PushConstants, MutualInformation) {
  using Push = InformationPush;
  for (const std::span<const std::uint32_t> spirv :
       {std::span<const std::uint32_t>(information_rows_spv),
        std::span<const std::uint32_t>(information_columns_spv)})
    expect_members<Push>(
        spirv, {MEMBER(particles), MEMBER(combinations), MEMBER(cap_px), MEMBER(inverse_scale)});
}

TEST(PushConstants, EdgeGradient) {
  using Push = EdgeGradientPush;
  expect_members<Push>(edge_gradient_spv, {MEMBER(width), MEMBER(height), MEMBER(radius)});
}

TEST(PushConstants, EdgeThin) {
  using Push = EdgeThinPush;
  expect_members<Push>(edge_thin_spv, {MEMBER(width), MEMBER(height), MEMBER(low2)});
}

TEST(PushConstants, EdgeLink) {
  using Push = EdgeLinkPush;
  expect_members<Push>(edge_link_spv, {MEMBER(width), MEMBER(height), MEMBER(high2),
                                       MEMBER(min_length_px), MEMBER(count)});
}

}  // namespace
}  // namespace edgescout
#endif
