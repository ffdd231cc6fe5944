#include "host/enlarged_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/core/quantile.h"
#include "host/detect/explain.h"
#include "host/register/measured_depth.h"
#include "kernels/error.h"
#include "tests/detect/rendered_part.h"

namespace edgescout::test {
namespace {

TemplateSet set_of(double diameter_m, double min_m, double max_m) {
  TemplateSet set;
  set.model.mesh.diameter_m = diameter_m;
  set.options.distance_min_m = min_m;
  set.options.distance_max_m = max_m;
  return set;
}

ObjectView view_of(int width, int height, double focal_px) {
  ObjectView view;
  view.camera = {width, height, focal_px, focal_px, 0.5 * width - 0.5, 0.5 * height - 0.5, {}};
  return view;
}

TEST(EnlargementFor, IsOfObjectsThatAreSmallAtTheMiddleOfTheirDistances) {
  const std::vector<ObjectView> views{view_of(640, 480, 800)};
  const std::vector sets{set_of(0.1, 0.4, 0.9)};  // 133 px at 0.6 m
  EXPECT_EQ(enlargement_for(sets, views, 134), 2);
  EXPECT_EQ(enlargement_for(sets, views, 133), 1);
  EXPECT_EQ(enlargement_for(sets, views, 0), 1);
  EXPECT_EQ(enlargement_for(std::vector{set_of(1, 0.4, 0.9), sets[0]}, views, 134), 2);
}

TEST(EnlargementFor, IsOneFactorForAllViewsAndBoundsTheirSize) {
  const std::vector sets{set_of(0.1, 0.4, 0.9)};
  EXPECT_EQ(enlargement_for(sets, std::vector{view_of(1250, 800, 800)}, 160), 2);
  EXPECT_EQ(enlargement_for(sets, std::vector{view_of(1251, 800, 800)}, 160), 1);
  EXPECT_EQ(
      enlargement_for(sets, std::vector{view_of(640, 480, 800), view_of(640, 480, 1600)}, 160), 1);
}

class EnlargedTest : public testing::Test {
 protected:
  ObjectView enlarge(const ObjectView& view) {
    return enlarged({&view, 1}, 2, *backend, RenderedPart::options().edges)[0];
  }
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  const RenderedPart part{"l_bracket"};
};

TEST_F(EnlargedTest, EdgesLieWhereTheyWere) {
  const ObjectView view = part.prepared(0, Se3{}, *backend), large = enlarge(view);
  ASSERT_EQ(large.image->width, 2 * view.image->width);
  ASSERT_EQ(large.camera.height, 2 * view.camera.height);
  const Eigen::Vector3d at(0.01, -0.02, 0.3);
  EXPECT_LT(
      (project(large.camera, at) - (2 * project(view.camera, at).array() + 0.5).matrix()).norm(),
      1e-9);
  // Across each edge of the small image, in its pixels.
  std::vector<double> offsets_px;
  for (const EdgePoint& edge : view.edges->points()) {
    Eigen::Vector2d nearest(1e9, 1e9);
    for (const EdgePoint& other : large.edges->points()) {
      const Eigen::Vector2d apart((other.x_px - 0.5) / 2 - edge.x_px,
                                  (other.y_px - 0.5) / 2 - edge.y_px);
      if (apart.norm() < nearest.norm()) nearest = apart;
    }
    if (nearest.norm() < 1)
      offsets_px.push_back(
          nearest.dot(Eigen::Vector2d(-std::sin(edge.theta_rad), std::cos(edge.theta_rad))));
  }
  ASSERT_GT(offsets_px.size(), 500u);
  EXPECT_LT(std::abs(quantile(offsets_px, 0.5)), 0.02);
  EXPECT_LT(quantile(offsets_px, 0.9), 0.25);
  EXPECT_GT(quantile(offsets_px, 0.1), -0.25);
}

// Four times the pixels: with the thresholds and the blur of the small image most edges are noise.
TEST_F(EnlargedTest, NoiseDoesNotBecomeEdges) {
  const ObjectView view = part.prepared(0, Se3{}, *backend);
  EXPECT_LT(enlarge(view).edges->points().size(), 3 * view.edges->points().size());
}

TEST_F(EnlargedTest, DepthKeepsItsValues) {
  ObjectView view = part.prepared(0, Se3{}, *backend);
  DepthImage depth{view.camera.width, view.camera.height, {}};
  for (int i = 0; i < depth.width * depth.height; ++i) depth.z_m.push_back(float(i));
  add_depth(view, depth, part.scene.views[0].camera);
  const ObjectView enlarged_view = enlarge(view);
  const DepthImage& large = enlarged_view.depth->image;
  for (const auto& [x, y] : {std::pair{0, 0}, {17, 5}, {depth.width - 1, depth.height - 1}})
    for (int i = 0; i < 4; ++i)
      EXPECT_EQ(large.at(2 * x + i % 2, 2 * y + i / 2), depth.at(x, y)) << x << " " << y;
}

TEST_F(EnlargedTest, NeedsAPreparedView) {
  const ObjectView built = part.with_tensors(0, *backend);
  EXPECT_THROW(enlarge(built), LogicError);
  EXPECT_THROW(enlarge(ObjectView{}), LogicError);
}

// Poses, regions and reports are those of the image as it was given.
TEST_F(EnlargedTest, ADetectionDoesNotShowIt) {
  PipelineOptions options = RenderedPart::options();
  const Eigen::Vector2d center_px =
      project(part.scene.views[0].camera, part.truth_in(0) * part.sets[0].model.center_m);
  options.detect.scan.within = {center_px.x() - 20, center_px.y() - 20, 40, 40};
  for (const double below_px : {0.0, 1e4}) {
    options.detect.enlarge_below_px = below_px;
    DetectTrace trace;
    const std::vector<Detection> found =
        detect_objects(part.prepared(0, Se3{}, *backend), part.sets, *backend, options, &trace)
            .detections;
    EXPECT_EQ(trace.view.camera.width, (below_px > 0 ? 2 : 1) * trace.camera.width);
    ASSERT_FALSE(found.empty());
    EXPECT_TRUE(part.error(found[0].world_from_object, part.truth_in(0)).passes());
    for (const ScanHit& hit : trace.searches[0].hits) {
      const Eigen::Vector2d at_px =
          project(trace.camera, hit.pose.world_from_object * part.sets[0].model.center_m);
      EXPECT_LT((at_px - center_px).lpNorm<Eigen::Infinity>(), 26) << below_px;
    }
    const std::vector<EdgeModel> models = models_of(part.sets);
    Se3 beside = part.truth_in(0);
    beside.translation_m.x() += 0.001;
    const LossReport report = explain_loss({models, {&trace.view, 1}, *backend}, part.sets[0],
                                           trace, {0, beside}, options.detect, {});
    EXPECT_TRUE(report.range.in_region);
    ASSERT_TRUE(report.selection.selected.has_value());
    EXPECT_NEAR(report.selection.selected->mspd_px,
                0.001 * trace.camera.fx / part.truth_in(0).translation_m.z(), 1.5)
        << below_px;
  }
}

}  // namespace
}  // namespace edgescout::test
