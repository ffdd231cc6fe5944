// Candidates found in several images.
#include "host/active/candidates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/detect/detect.h"
#include "kernels/error.h"
#include "tests/active/small_cell.h"

namespace edgescout::test {
namespace {

// From three places; the last image shows nothing at all.
struct BlankLast : SmallCell {
  DetectOptions options = SmallCell::options().pipeline.detect;
  std::vector<ScannedView> images;

  BlankLast() {
    SimulatedCell cell = source();
    for (const int view : {0, 2, 4}) {
      Shot shot = cell.acquire(view);
      if (view == 4) std::ranges::fill(shot.image.pixels, 128);
      std::vector<StageSeconds> stages;
      ObjectView image =
          prepare_view(shot.image, camera(), shot.camera_from_world, *backend, {}, &stages);
      add_tensors(image, sets, *backend, {});
      images.push_back({image, {}});
    }
  }
  bool is_right(const Se3& world_from_object) const {
    return pose_error(world_from_object, scene.placed[0].world_from_object, part.symmetries)
        .passes(0.05, 0.002);
  }
};

TEST(Candidates, AreFoundWhereTheNewestImageShowsNothing) {
  BlankLast t;
  const std::vector<ObjectView> views = views_of(t.images);
  const auto in_world = [&](const PoseEstimate& r) {
    return inverse(views[2].camera_from_world) * r.world_from_object;
  };
  const ObjectSearch in_newest{t.sets[0], views[2], std::span(views).first(2), *t.backend};
  for (const PoseEstimate& r : find_candidates(in_newest, {}, t.options))
    EXPECT_FALSE(t.is_right(in_world(r))) << "by its own hits";
  for (ScannedView& image : t.images) scan_once(t.sets, image, *t.backend, t.options.scan);
  const std::vector<Detection> found =
      candidates_in_images(t.sets, t.images, {}, *t.backend, t.options);
  ASSERT_FALSE(found.empty());
  EXPECT_TRUE(t.is_right(found[0].world_from_object));
  const std::vector<ObjectPose> known{{0, t.scene.placed[0].world_from_object}};
  for (const Detection& d : candidates_in_images(t.sets, t.images, known, *t.backend, t.options))
    EXPECT_FALSE(t.is_right(d.world_from_object)) << "known";
}

TEST(Candidates, NeedImagesThatWereScanned) {
  BlankLast t;
  EXPECT_THROW(candidates_in_images(t.sets, t.images, {}, *t.backend, t.options), LogicError);
  scan_once(t.sets, t.images[0], *t.backend, t.options.scan);
  const auto hits = t.images[0].hits;
  scan_once(t.sets, t.images[0], *t.backend, t.options.scan);
  EXPECT_EQ(t.images[0].hits, hits) << "once";
}

// However certain the views make poses that collide with each other.
TEST(Candidates, KeepAPlaceForPosesThatCollideWithNothing) {
  const SmallCell t;
  const std::vector<EdgeModel> models = models_of(t.sets);
  const auto at = [&](double diameters, double probability) {
    Detection candidate;
    candidate.world_from_object.translation_m.x() = diameters * models[0].mesh.diameter_m;
    candidate.probability = probability;
    return candidate;
  };
  const std::vector<Detection> candidates{at(0, 0.999),   at(0.1, 0.99), at(-0.1, 0.99),
                                          at(0.15, 0.98), at(3, 0.3),    at(6, 0.1),
                                          at(9, 1e-4)};
  const auto kept = [&](std::size_t most) {
    std::vector<double> places;
    for (const Detection& c :
         best_non_colliding(candidates, most, models, t.options().pipeline.detect.penetration_m,
                            t.backend->threads()))
      places.push_back(
          std::round(c.world_from_object.translation_m.x() / models[0].mesh.diameter_m * 100) /
          100);
    return places;
  };
  EXPECT_EQ(kept(1), (std::vector<double>{0}));
  EXPECT_EQ(kept(3), (std::vector<double>{0, 3, 6}));
  EXPECT_EQ(kept(4), (std::vector<double>{0, 0.1, 3, 6})) << "before what has hardly a chance";
  EXPECT_EQ(kept(7).size(), 7u);
  EXPECT_EQ(kept(9).size(), 7u);
}

}  // namespace
}  // namespace edgescout::test
