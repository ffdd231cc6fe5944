#include "host/detect/depth_prior.h"

#include <gtest/gtest.h>

#include "host/register/measured_depth.h"
#include "tests/detect/part_image.h"

namespace edgescout::test {
namespace {

// Templates of a part from 0.2 to 0.8 m, and a view whose depth is one wall.
struct PriorScene {
  std::unique_ptr<Backend> backend = make_cpu_backend(1);
  TemplateSet set;
  ObjectView view;

  explicit PriorScene(float wall_m) {
    const Object part = make_part("l_bracket");
    TemplateOptions options;
    options.frequency = 1;
    options.distance_min_m = 0.2;
    options.distance_max_m = 0.8;
    set = build_templates(part, options, *backend);
    view = view_of_edges({{20, 20, 0, 1}}, small_camera(), 2, *backend);
    set_wall([&](int, int) { return wall_m; });
  }
  template <typename Depth>
  void set_wall(const Depth& depth_m) {
    DepthImage depth{view.camera.width, view.camera.height, {}};
    for (int y = 0; y < depth.height; ++y)
      for (int x = 0; x < depth.width; ++x) depth.z_m.push_back(depth_m(x, y));
    view.depth = std::make_shared<const MeasuredDepth>(MeasuredDepth{depth, {}});
  }
  // The largest difference to the wall of the distances that fit at an anchor; -1: none fits.
  double farthest_fit_m(double wall_m, int column, int row) const {
    double farthest_m = -1;
    for (int scale = 0; scale < int(distance_scales(set.options).size()); ++scale) {
      const SearchedScale searched(set, scale, view);
      const DepthPrior prior(searched, view, 2);
      for (std::size_t i = 0; i < searched.numbering.distances_m.size(); ++i)
        if (prior.fits(i, column, row))
          farthest_m = std::max(farthest_m, std::abs(searched.numbering.distances_m[i] - wall_m));
    }
    return farthest_m;
  }
  double largest_share() const {
    double share = 0;
    for (int scale = 0; scale < int(distance_scales(set.options).size()); ++scale)
      share = std::max(share, DepthPrior(SearchedScale(set, scale, view), view, 2).share());
    return share;
  }
};

TEST(DepthPrior, OnlyDistancesNearTheSurfaceFit) {
  const PriorScene scene(0.4f);
  const double radius_m = scene.set.model.radius_m, found_m = scene.farthest_fit_m(0.4, 80, 60);
  EXPECT_GE(found_m, 0);
  EXPECT_LT(found_m, 1.2 * radius_m + 0.5 * 0.4 * (scene.set.options.distance_ratio - 1));
}

TEST(DepthPrior, WithoutDepthEverythingFits) {
  PriorScene scene(0.4f);
  scene.view.depth.reset();
  EXPECT_EQ(scene.largest_share(), 1);
  EXPECT_GT(scene.farthest_fit_m(0.4, 80, 60), 0.3);
}

TEST(DepthPrior, WhereNothingIsMeasuredAllDistancesFit) {
  PriorScene scene(0);
  EXPECT_EQ(scene.largest_share(), 1);
  scene.set_wall([](int x, int) { return x < 160 ? 0.4f : DEPTH_MISSING; });
  EXPECT_GT(scene.farthest_fit_m(0.4, 150, 60), 0.3) << "in the half without depth";
  EXPECT_LT(scene.farthest_fit_m(0.4, 10, 60), 0.15) << "in the measured half";
}

// Speckle, as on shining parts: two thirds of the pixels are missing.
TEST(DepthPrior, AFewMeasuredPixelsAreEnough) {
  PriorScene scene(0);
  scene.set_wall([](int x, int y) { return (7 * x + 13 * y) % 3 == 0 ? 0.4f : DEPTH_MISSING; });
  EXPECT_LT(scene.farthest_fit_m(0.4, 80, 60), 0.15);
}

// The part may stand in a gap of what hides it: a share of its surroundings suffices.
TEST(DepthPrior, BothSurfacesOfAnEdgeFit) {
  PriorScene scene(0);
  scene.set_wall([](int x, int) { return x < 160 ? 0.3f : 0.7f; });
  const SearchedScale searched(scene.set, int(distance_scales(scene.set.options).size()) - 1,
                               scene.view);
  EXPECT_LT(std::abs(scene.farthest_fit_m(0.3, 10, 60)), 0.12);
  EXPECT_LT(std::abs(scene.farthest_fit_m(0.7, 150, 60)), 0.16);
  EXPECT_GT(scene.farthest_fit_m(0.3, 80, 60), 0.3) << "at the edge, the far surface";
  EXPECT_GT(scene.farthest_fit_m(0.7, 80, 60), 0.3) << "at the edge, the near surface";
}

}  // namespace
}  // namespace edgescout::test
