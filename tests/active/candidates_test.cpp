// Candidates of several images: what any of them shows.
#include "host/active/candidates.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/error.h"
#include "tests/active/small_cell.h"

namespace edgescout::test {
namespace {

// From three places; the last image shows nothing at all.
struct BlankLast : SmallCell {
  DetectOptions options = SmallCell::options().pipeline.detect;
  std::vector<Observation> images;

  BlankLast() {
    SimulatedCell cell = source();
    for (const int view : {0, 2, 4}) {
      Shot shot = cell.acquire(view);
      if (view == 4) std::ranges::fill(shot.image.pixels, 128);
      images.push_back(observe_prepared(
          prepare_image(shot.image, camera(), shot.camera_from_world, *backend, {}), sets, *backend,
          {}));
    }
  }
  bool is_right(const Se3& world_from_object) const {
    return pose_error(world_from_object, scene.placed[0].world_from_object, part.symmetries)
        .passes(0.05, 0.002);
  }
};

TEST(Candidates, AreFoundWhereTheNewestImageShowsNothing) {
  BlankLast t;
  const auto in_world = [&](const Refined& r) {
    return inverse(t.images[2].view.camera_from_world) * r.registration.world_from_object;
  };
  for (const Refined& r : find_candidates(t.sets[0], t.images[2], std::span(t.images).first(2), {},
                                          *t.backend, t.options))
    EXPECT_FALSE(t.is_right(in_world(r))) << "by its own hits";
  for (Observation& image : t.images) scan_for(t.sets, image, *t.backend, t.options.scan);
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
  scan_for(t.sets, t.images[0], *t.backend, t.options.scan);
  const auto hits = t.images[0].hits;
  scan_for(t.sets, t.images[0], *t.backend, t.options.scan);
  EXPECT_EQ(t.images[0].hits, hits) << "once";
}

// However certain their views make what stands in one another's way.
TEST(Candidates, KeepAPlaceForWhatHasNobodyInItsWay) {
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
