#include "host/experiments/bin.h"

#include <gtest/gtest.h>

#include <set>

#include "host/experiments/known_scene.h"
#include "host/render/parts.h"
#include "kernels/thread_pool.h"

namespace edgescout::test {
namespace {

ExperimentSettings small_bins() {
  ExperimentSettings settings;
  settings.image_scale = 0.25;
  settings.supersampling = 1;
  return settings;
}

TEST(MakeBin, IsTheSameBinEveryTimeAndAnotherForEveryNumber) {
  ThreadPool pool(2);
  const std::vector<Object> types{make_part("l_bracket"), make_part("bearing_block"),
                                  make_part("u_channel")};
  Bin a = make_bin(types, small_bins(), 3, pool), b = make_bin(types, small_bins(), 3, pool),
      c = make_bin(types, small_bins(), 4, pool);
  EXPECT_EQ(a.first_view, b.first_view);
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].object, b.instances[i].object);
    EXPECT_EQ(
        distance_between_m(a.instances[i].world_from_object, b.instances[i].world_from_object), 0);
    EXPECT_EQ(a.instances[i].visible, b.instances[i].visible);
  }
  EXPECT_EQ(a.cell->acquire(7).image.pixels, b.cell->acquire(7).image.pixels);
  EXPECT_NE(a.cell->acquire(7).image.pixels, c.cell->acquire(7).image.pixels);
}

// Five to twenty parts, each of a type, in front of every view at the distances the templates are
// made for.
TEST(MakeBin, HoldsItsPromises) {
  ThreadPool pool(2);
  const std::vector<Object> types{make_part("l_bracket"), make_part("bearing_block"),
                                  make_part("u_channel")};
  for (int number = 0; number < 6; ++number) {
    const Bin bin = make_bin(types, small_bins(), number, pool);
    EXPECT_GE(bin.parts, FEWEST_PARTS_OF_BIN);
    EXPECT_LE(bin.parts, MOST_PARTS_OF_BIN);
    EXPECT_EQ(static_cast<int>(bin.instances.size()), bin.parts);
    EXPECT_EQ(static_cast<int>(bin.cell->views().size()), bin_views().count);
    double most_visible = 0;
    for (const BinInstance& instance : bin.instances) {
      most_visible = std::max(most_visible, instance.visible);
      EXPECT_GE(instance.visible, 0);
      EXPECT_LE(instance.visible, 1);
      const Eigen::Vector3d center =
          types[static_cast<std::size_t>(instance.object)].mesh.box_min_m / 2 +
          types[static_cast<std::size_t>(instance.object)].mesh.box_max_m / 2;
      for (const Se3& view : bin.cell->views())
        EXPECT_NEAR((view * (instance.world_from_object * center)).norm(), bin_views().radius_m,
                    BIN_DEPTH_MARGIN_M);
    }
    EXPECT_GT(most_visible, LIGHTLY_OCCLUDED);
  }
}

// The visible fraction of an instance is what its own images show: more or less behind another.
TEST(BinCell, GivesTheVisibleFractionInEveryView) {
  ThreadPool pool(2);
  const std::vector<Object> types{make_part("l_bracket"), make_part("bearing_block"),
                                  make_part("u_channel")};
  const Bin bin = make_bin(types, small_bins(), 1, pool);
  double most = 0, least = 1;
  for (const BinInstance& instance : bin.instances) {
    EXPECT_EQ(bin.cell->visible(bin.first_view)[instance.placed], instance.visible);
    EXPECT_EQ(instance.most_visible, instance.visible) << "of the first image so far";
    for (int view = 0; view < 3; ++view) {
      most = std::max(most, bin.cell->visible(view)[instance.placed]);
      least = std::min(least, bin.cell->visible(view)[instance.placed]);
    }
  }
  EXPECT_GT(most, 0.95);
  EXPECT_LT(least, 0.6);
}

// Against every second view there is.
TEST(ClairvoyantSequence, TakesTheViewThatShowsMost) {
  ThreadPool pool(2);
  const std::vector<Object> types{make_part("l_bracket"), make_part("bearing_block"),
                                  make_part("u_channel")};
  const Bin bin = make_bin(types, small_bins(), 1, pool);
  const auto shown = [&](int second) {
    double sum = 0;
    for (const BinInstance& instance : bin.instances)
      sum += std::min(1.0, std::max(0.0, instance.visible - 0.3) +
                               std::max(0.0, bin.cell->visible(second)[instance.placed] - 0.3));
    return sum;
  };
  const std::vector<int> sequence = clairvoyant_sequence(bin, bin.instances, 5);
  ASSERT_EQ(sequence.size(), 5u);
  EXPECT_EQ(sequence[0], bin.first_view);
  EXPECT_EQ(std::set(sequence.begin(), sequence.end()).size(), 5u) << "no view twice";
  for (int view = 0; view < bin_views().count; ++view)
    EXPECT_TRUE(view == bin.first_view || shown(view) <= shown(sequence[1])) << view;
}

}  // namespace
}  // namespace edgescout::test
