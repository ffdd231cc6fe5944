// The reference of template_project against an oracle in long double (template_project.h).
#include "kernels/template_project.h"

#include "kernels/error.h"
#include "tests/kernels/template_project_oracle.h"

namespace edgescout {
namespace {

struct Projected {
  std::vector<TemplatePoint> points;
  std::vector<std::uint32_t> too_near;
};

Projected by_reference(const test::ProjectionCase& c) {
  Projected out{std::vector<TemplatePoint>(c.places), std::vector<std::uint32_t>(c.jobs.size())};
  template_project_reference(ModelPointPlanes(c.points), c.jobs, c.options, out.points,
                             out.too_near);
  return out;
}

// Double loses nothing that a test of so many points would meet.
TEST(TemplateProjectReference, RoundsWhatTheOracleSays) {
  std::mt19937 rng = test::test_rng();
  constexpr test::Real half = 0.5L + 1e-9L;
  for (const int bins : {1, 7, 60})
    for (const int most : {1, 5, 63, 64, 65, 256}) {
      const test::ProjectionCase c = test::projection_case(rng, 41, most, most + 30, bins);
      const Projected found = by_reference(c);
      for (std::size_t j = 0; j < c.jobs.size(); ++j) {
        const TemplateProjectJob& job = c.jobs[j];
        std::uint32_t near = 0;
        for (std::uint32_t i = 0; i < job.point_count; ++i) {
          const test::ExactPoint exact =
              test::exact_point(job, c.options, c.points[job.first_point + i]);
          const TemplatePoint& point = found.points[job.first_projected + i];
          EXPECT_LE(std::abs(point.dx_px - exact.dx), half);
          EXPECT_LE(std::abs(point.dy_px - exact.dy), half);
          EXPECT_LE(test::bins_apart(point.bin, exact.bin, bins), half);
          EXPECT_LT(point.bin, bins);
          near += exact.depth_m < c.options.nearest_m;
        }
        EXPECT_EQ(found.too_near[j], near);
      }
    }
}

TemplatePoint project_one(const ModelPoint& point, float anchor_x_px = 0) {
  const test::ProjectionCase c{{point},
                               {{{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}, 0, 1, 0, anchor_x_px, 0}},
                               {{100, 100, 0, 0}, 4, 0.125f},
                               1};
  return by_reference(c).points[0];
}

// Paper, Eq. 1: o and o' on the edge, projected one by one, span the direction that the bin says.
TEST(TemplateProjectReference, TheBinIsThatOfTheProjectedPair) {
  std::mt19937 rng = test::test_rng();
  const test::ProjectionCase c = test::projection_case(rng, 30, 64, 64, 60);
  const Projected found = by_reference(c);
  int compared = 0;
  for (const TemplateProjectJob& job : c.jobs)
    for (std::uint32_t i = 0; i < job.point_count; ++i) {
      constexpr test::Real step_m = 1e-7L;
      const ModelPoint& model = c.points[job.first_point + i];
      test::CameraPoint o = test::in_camera(job.camera_from_object, model), o2 = o;
      if (o.position[2] < c.options.nearest_m) continue;
      o.position = test::plus(o.position, test::times(-step_m, o.tangent));
      o2.position = test::plus(o2.position, test::times(step_m, o2.tangent));
      const test::ImagePoint from = test::project(c.options.intrinsics, o),
                             to = test::project(c.options.intrinsics, o2);
      if (std::hypot(to.x - from.x, to.y - from.y) < 1e-6L) continue;  // seen end on
      const test::Real turn =
          std::atan2(to.y - from.y, to.x - from.x) * 60 / std::numbers::pi_v<test::Real>;
      EXPECT_LE(test::bins_apart(found.points[job.first_projected + i].bin, turn, 60), 0.51L);
      ++compared;
    }
  EXPECT_GT(compared, 300);
}

TEST(TemplateProjectReference, HalvesGoAwayFromZero) {
  const ModelPoint middle{0, 0, 1, 1, 0, 0};
  EXPECT_EQ(project_one(middle, -2.5f).dx_px, 3);
  EXPECT_EQ(project_one(middle, 2.5f).dx_px, -3);
  EXPECT_EQ(project_one(middle, 2.25f).dx_px, -2);
}

TEST(TemplateProjectReference, OppositeDirectionsShareABin) {
  for (const float sign : {1.0f, -1.0f}) {
    EXPECT_EQ(project_one({0, 0, 1, sign, 0, 0}).bin, 0);
    EXPECT_EQ(project_one({0, 0, 1, 0, sign, 0}).bin, 2);
    EXPECT_EQ(project_one({0, 0, 1, sign, sign, 0}).bin, 1);
    EXPECT_EQ(project_one({0, 0, 1, sign, -0.01f * sign, 0}).bin, 0);  // nearly pi
  }
}

TEST(TemplateProjectReference, APointTooNearIsDrawnAtTheNearestDepth) {
  for (const float z_m : {0.0625f, 0.0f, -1.0f}) {
    EXPECT_EQ(project_one({0.25f, 0, z_m, 1, 0, 0}).dx_px, 200);
    EXPECT_EQ(project_one({100, -100, z_m, 1, 0, 0}).dx_px, 16000);
    EXPECT_EQ(project_one({100, -100, z_m, 1, 0, 0}).dy_px, -16000);
  }
}

TEST(ModelPointPlanes, HoldsWhatItWasGiven) {
  std::mt19937 rng = test::test_rng();
  const std::vector<ModelPoint> points = test::random_points(rng, 5);
  const ModelPointPlanes planes(points);
  ASSERT_EQ(planes.count(), 5u);
  ASSERT_EQ(planes.values().size(), 30u);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(planes.at(i).x_m, points[i].x_m);
    EXPECT_EQ(planes.plane(2)[i], points[i].z_m);
    EXPECT_EQ(planes.values()[5 * 5 + i], points[i].tz);
  }
  EXPECT_EQ(ModelPointPlanes({}).count(), 0u);
}

}  // namespace
}  // namespace edgescout
