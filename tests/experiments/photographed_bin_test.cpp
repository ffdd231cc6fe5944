#include "host/experiments/photographed_bin.h"

#include <gtest/gtest.h>

#include "kernels/backend.h"
#include "kernels/thread_pool.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

// Three images of one pile stand for photographs.
KnownScene pile() {
  ThreadPool pool(2);
  RenderOptions options;
  options.width = 160;
  options.height = 120;
  options.focal_px = 200;
  options.objects = 4;
  options.views = 3;
  options.supersampling = 1;
  return rendered_scene("pile", {rendered_types()[1]}, options, pool);
}

TEST(PhotographedBin, GivesThePhotographsAndWhatLiesThere) {
  const KnownScene scene = pile();
  const Bin bin = photographed_bin(scene, 2);
  EXPECT_EQ(bin.number, 2);
  EXPECT_EQ(bin.first_view, 2);
  ASSERT_EQ(bin.cell->views().size(), 3u);
  for (int view = 0; view < 3; ++view) {
    const KnownImage& image = scene.images[static_cast<std::size_t>(view)];
    const Shot shot = bin.cell->acquire(view);
    EXPECT_EQ(shot.image.pixels, image.image.pixels);
    EXPECT_EQ(distance_between_m(shot.camera_from_world, image.camera_from_world), 0);
    EXPECT_EQ(distance_between_m(bin.cell->views()[static_cast<std::size_t>(view)],
                                 image.camera_from_world),
              0);
  }
  ASSERT_EQ(bin.instances.size(), scene.instances.size());
  EXPECT_EQ(static_cast<std::size_t>(bin.parts), scene.instances.size());
  for (std::size_t i = 0; i < bin.instances.size(); ++i) {
    EXPECT_EQ(distance_between_m(bin.instances[i].world_from_object,
                                 scene.instances[i].world_from_object),
              0);
    EXPECT_EQ(bin.instances[i].visible, 1);
    EXPECT_EQ(bin.cell->visible(0)[bin.instances[i].placed], 1);
  }
  EXPECT_EQ(fixed_sequence(bin), (std::vector<int>{2, 0, 1}));
}

TEST(PhotographedBin, NeedsOneCamera) {
  KnownScene scene = pile();
  scene.images[1].camera.fx += 1;
  expect_input_error([&] { photographed_bin(scene, 0); }, {"pile", "cameras"});
}

TEST(PhotographedBin, HasTemplatesForTheDistancesOfThePile) {
  const KnownScene scene = pile();
  const std::vector<TemplateSet> sets = pile_templates(scene, *make_cpu_backend(2));
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_NEAR(sets[0].options.distance_max_m / sets[0].options.distance_min_m, 2, 1e-9);
  for (const KnownImage& image : scene.images)
    for (const KnownInstance& instance : scene.instances) {
      const double distance_m =
          (image.camera_from_world * instance.world_from_object).translation_m.norm();
      EXPECT_GT(distance_m, sets[0].options.distance_min_m);
      EXPECT_LT(distance_m, sets[0].options.distance_max_m);
    }
}

}  // namespace
}  // namespace edgescout::test
