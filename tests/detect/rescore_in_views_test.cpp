// Hits rescored in several views: against sums over projected points, and the gain for a right hit.
#include "host/detect/rescore_in_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "host/detect/support_views.h"
#include "host/register/occluders.h"
#include "tests/detect/part_image.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

using std::numbers::pi;

Se3 looking_at_origin(const Eigen::Vector3d& eye_m) {
  const Eigen::Vector3d z = -eye_m.normalized(), x = z.unitOrthogonal(), y = z.cross(x);
  Eigen::Matrix3d camera_from_world;
  camera_from_world << x.transpose(), y.transpose(), z.transpose();
  return se3_from_matrix(camera_from_world, -camera_from_world * eye_m);
}

// A part at the world's origin, seen by several cameras 0.31 m away, among scattered edges.
struct SeenPart {
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  TemplateSet set;
  Se3 truth;
  std::vector<ObjectView> views;

  SeenPart(int count, int scattered, Random& random, const char* part = "bearing_block") {
    set = part_templates(part, 3, 0.28, 0.34, *backend);
    truth.rotation = random.rotation();
    truth.translation_m = -(truth.rotation * set.model.center_m);
    for (int v = 0; v < count; ++v) {
      const Se3 camera_from_world = looking_at_origin(0.31 * random.direction());
      const Se3 pose = camera_from_world * truth;
      std::vector<EdgePoint> edges;
      for (int i = 0; i < scattered; ++i)
        edges.push_back({float(random.uniform(0, 319)), float(random.uniform(0, 239)),
                         float(random.uniform(0, pi)), 1});
      const std::vector<ModelPoint> visible = visible_edges(set.model, {&pose, 1}, *backend)[0];
      for (const ModelPoint& p : visible) {
        const Eigen::Vector3d at = pose * Eigen::Vector3d(p.x_m, p.y_m, p.z_m);
        const Eigen::Vector3d ahead =
            at + 1e-6 * (pose.rotation * Eigen::Vector3d(p.tx, p.ty, p.tz));
        const Eigen::Vector2d pixel = project(small_camera(), at),
                              along = project(small_camera(), ahead) - pixel;
        edges.push_back({float(pixel.x()), float(pixel.y()),
                         float(std::fmod(std::atan2(along.y(), along.x()) + 2 * pi, pi)), 1});
      }
      views.push_back(view_of_edges(edges, small_camera(), 1, *backend));
      views.back().camera_from_world = camera_from_world;
    }
  }
  std::span<const ObjectView> others() const { return std::span(views).subspan(1); }
  Se3 truth_in(std::size_t view) const { return views[view].camera_from_world * truth; }
  std::vector<ScanHit> rescored(std::span<const ScanHit> hits) const {
    return rescore_in_views({set, views[0], others(), *backend}, hits, ScanOptions{});
  }

  // Mean over the points of a pose in this view, weighted as ScanHit::rank. The points are those of
  // the viewpoint nearest to the one from which the camera sees `hit`, modulo symmetry. Counts only
  // points in columns from `first_column` on; `fraction` of the points are there.
  double rank_in(const ObjectView& view, const Se3& hit, Se3 pose, double first_column = -INFINITY,
                 double* fraction = nullptr) const {
    const TemplateView* nearest = nullptr;
    double largest = -2;
    Se3 nearest_symmetry;
    for (const TemplateView& candidate : set.views)
      for (const Se3& symmetry : set.symmetries.discrete) {
        const Se3 equal = hit * symmetry;
        const Eigen::Vector3d eye =
            (inverse(equal).translation_m - set.model.center_m).normalized();
        const double cosine =
            (candidate.camera_from_object.inverse() * -Eigen::Vector3d::UnitZ()).dot(eye);
        if (cosine > largest) largest = cosine, nearest = &candidate, nearest_symmetry = symmetry;
      }
    pose = pose * nearest_symmetry;
    const TensorShape& shape = view.reduced[0].salient->shape;
    const std::vector<std::uint16_t> tensor = view.reduced[0].salient->tensor();
    const int count = std::min<int>(ScanOptions{}.points, int(nearest->points.size()));
    double sum = 0;
    int shown = 0;
    for (int i = 0; i < count; ++i) {
      const ModelPoint& p =
          nearest->points[std::size_t(i) * nearest->points.size() / std::size_t(count)];
      const Eigen::Vector3d at = pose * Eigen::Vector3d(p.x_m, p.y_m, p.z_m);
      const Eigen::Vector3d ahead = at + 1e-6 * (pose.rotation * Eigen::Vector3d(p.tx, p.ty, p.tz));
      const Eigen::Vector2d pixel = project(view.reduced[0].camera, at),
                            along = project(view.reduced[0].camera, ahead) - pixel;
      if (pixel.x() < first_column - 0.5) continue;
      ++shown;
      const int x = int(std::lround(pixel.x())), y = int(std::lround(pixel.y()));
      const int bin = int(std::lround(std::fmod(std::atan2(along.y(), along.x()) + 2 * pi, pi) *
                                      shape.bins / pi)) %
                      shape.bins;
      const bool inside = x >= 0 && y >= 0 && x < shape.width && y < shape.height;
      sum += inside ? std::min(16, (tensor[shape.index(x, y, bin)] + 32) / 64) / 4.0 : 3.25;
    }
    if (fraction) *fraction = double(shown) / count;
    return sum / shown * std::pow((hit * set.model.center_m).norm(), 0.25);
  }
};

PoolOptions pool_options(int support_views, std::size_t most, const PoseFilter& is_excluded = {}) {
  return {ScanOptions{}, support_views, most, is_excluded};
}

ScanHit hit_at(const Se3& pose, double rank) {
  ScanHit hit;
  hit.pose.world_from_object = pose;
  hit.rank = rank;
  return hit;
}

TEST(RescoreInViews, EqualsTheBestSumOverDistances) {
  Random random = test_random();
  const SeenPart t(3, 300, random);
  std::vector<ScanHit> hits;
  for (int i = 0; i < 40; ++i) {
    Vector6d off;
    off << 0.03 * random.direction(), 0.5 * random.direction();
    hits.push_back(hit_at(retract(t.truth_in(0), off), random.uniform(1, 3)));
  }
  const std::vector<ScanHit> rescored = t.rescored(hits);
  ASSERT_EQ(rescored.size(), hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    double lowest = INFINITY;
    for (const double further : {-0.05, -0.025, 0.0, 0.025, 0.05}) {
      Se3 pose = hits[i].pose.world_from_object;
      pose.translation_m += further * (pose * t.set.model.center_m);
      double sum = hits[i].rank;
      for (const ObjectView& other : t.others()) {
        const Se3 other_from_own = other.camera_from_world * inverse(t.views[0].camera_from_world);
        sum += t.rank_in(other, other_from_own * hits[i].pose.world_from_object,
                         other_from_own * pose);
      }
      lowest = std::min(lowest, sum / 3);
    }
    EXPECT_NEAR(rescored[i].rank, lowest, 0.02) << "a point or two of sixty round the other way";
    const Eigen::Vector3d before = hits[i].pose.world_from_object * t.set.model.center_m,
                          after = rescored[i].pose.world_from_object * t.set.model.center_m;
    EXPECT_LT(before.normalized().cross(after.normalized()).norm(), 1e-9) << "along its ray";
    EXPECT_TRUE(rescored[i].pose.world_from_object.rotation.coeffs() ==
                hits[i].pose.world_from_object.rotation.coeffs());
  }
}

// A set holds half of the viewpoints of a part with a half turn, and a sixth or less of others. The
// truth fits the images from all sides nevertheless.
TEST(RescoreInViews, ScoresSymmetricPartsFromAllSides) {
  Random random = test_random();
  for (const char* part : {"l_bracket", "hex_nut"}) {
    const SeenPart t(25, 0, random, part);
    ASSERT_GE(t.views.size(), 2u);
    const ScanHit hit = hit_at(t.truth_in(0), 0);
    double mean_px = 0;  // over all views; 1.3 where every viewpoint has its template, 1.7 to the
                         // nearest kept one
    for (const ObjectView& other : t.others())
      mean_px += 2 *
                 rescore_in_views({t.set, t.views[0], {&other, 1}, *t.backend}, {&hit, 1},
                                  ScanOptions{})[0]
                     .rank /
                 std::pow(0.31, 0.25) / double(t.others().size());
    EXPECT_LT(mean_px, 1.5) << part;
  }
}

// Another view determines the distance better than the hit's own view.
TEST(RescoreInViews, PutsARightHitAtItsDistanceAndBeforeWrongOnes) {
  Random random = test_random();
  for (int i = 0; i < 5; ++i) {
    const SeenPart t(3, 300, random);
    const Se3 truth = t.truth_in(0);
    Se3 too_far = truth;
    too_far.translation_m += 0.05 * (truth * t.set.model.center_m);
    std::vector<ScanHit> hits{hit_at(too_far, 1)};
    for (int wrong = 0; wrong < 200; ++wrong)
      hits.push_back(
          hit_at({random.rotation(), truth.translation_m + 0.05 * random.direction()}, 1));
    const std::vector<ScanHit> rescored = t.rescored(hits);
    EXPECT_LT((rescored[0].pose.world_from_object.translation_m - truth.translation_m).norm(),
              0.001);
    for (std::size_t h = 1; h < rescored.size(); ++h) EXPECT_LT(rescored[0].rank, rescored[h].rank);
  }
}

TEST(RescoreInViews, WithoutOtherViewsChangesNothing) {
  Random random = test_random();
  const SeenPart t(1, 0, random);
  const std::vector<ScanHit> hits{hit_at(t.truth_in(0), 2)};
  const std::vector<ScanHit> rescored = t.rescored(hits);
  ASSERT_EQ(rescored.size(), 1u);
  EXPECT_EQ(rescored[0].rank, 2);
  EXPECT_TRUE(rescored[0].pose.world_from_object.translation_m ==
              hits[0].pose.world_from_object.translation_m);
}

// Known objects cover half of a part or all of it: only the points they leave count.
TEST(RescoreInViews, PointsThatKnownObjectsHideDoNotCount) {
  Random random = test_random();
  SeenPart t(2, 300, random);
  const Se3 truth = t.truth_in(0);
  std::vector<ScanHit> hits;
  for (int i = 0; i < 20; ++i) {
    Vector6d off;
    off << 0.02 * random.direction(), 0.3 * random.direction();
    hits.push_back(hit_at(retract(truth, off), random.uniform(0.5, 3)));
  }
  const auto behind = [&](int columns, float depth_m) {
    auto occluders = std::make_shared<Occluders>();
    occluders->camera = small_camera();
    occluders->depth_m.assign(320 * 240, DEPTH_EMPTY);
    for (int i = 0; i < 320 * 240; ++i)
      if (i % 320 < columns) occluders->depth_m[std::size_t(i)] = depth_m;
    t.views[1].occluders = occluders;
    return t.rescored(hits);
  };
  const std::vector<ScanHit> free = t.rescored(hits), hidden = behind(320, 0.1f),
                             before = behind(320, 0.9f);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_NEAR(hidden[i].rank, hits[i].rank, 1e-12) << "its own view alone counts";
    EXPECT_EQ(hidden[i].pose.world_from_object.translation_m,
              hits[i].pose.world_from_object.translation_m);
    EXPECT_EQ(before[i].rank, free[i].rank) << "objects behind it hide nothing";
  }
  const std::vector<ScanHit> half = behind(160, 0.1f);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    double lowest = INFINITY;
    for (const double further : {-0.05, -0.025, 0.0, 0.025, 0.05}) {
      Se3 pose = hits[i].pose.world_from_object;
      pose.translation_m += further * (pose * t.set.model.center_m);
      const Se3 there = t.views[1].camera_from_world * inverse(t.views[0].camera_from_world);
      double shown = 0;
      const double rank =
          t.rank_in(t.views[1], there * hits[i].pose.world_from_object, there * pose, 160, &shown);
      lowest = std::min(lowest, (hits[i].rank + (shown > 0 ? shown * rank : 0)) / (1 + shown));
    }
    EXPECT_NEAR(half[i].rank, lowest, 0.04) << "a point or two of sixty round the other way";
  }
}

// A view that looks the other way counts neither for nor against a hit.
TEST(RescoreInViews, BehindAnotherCameraItCountsAsChance) {
  Random random = test_random();
  SeenPart t(2, 0, random);
  t.views[1].camera_from_world = looking_at_origin({0, 0, 0.3});
  t.views[1].camera_from_world.translation_m.z() = -0.5;
  const std::vector<ScanHit> rescored = t.rescored(std::vector{hit_at(t.truth_in(0), 2)});
  const Se3 in_other = t.truth_in(1);
  EXPECT_LT((in_other * t.set.model.center_m).z(), 0);
  EXPECT_NEAR(rescored[0].rank, (2 + 3.25 * std::pow(0.5, 0.25)) / 2, 0.05);
  EXPECT_EQ(rescored[0].pose.world_from_object.translation_m, t.truth_in(0).translation_m)
      << "no distance is more probable";
}

// The hits of every image, rescored in the others, in the frame of the last camera.
TEST(PooledHits, HasTheHitsOfEveryImage) {
  Random random = test_random();
  const SeenPart t(4, 300, random);
  std::vector<std::vector<ScanHit>> hits(4);
  for (std::size_t v = 0; v < 4; ++v)
    for (std::size_t i = 0; i < 5 * v; ++i) {  // none in the first
      Vector6d off;
      off << 0.03 * random.direction(), 0.5 * random.direction();
      hits[v].push_back(hit_at(retract(t.truth_in(v), off), 2));
    }
  const std::vector<std::span<const ScanHit>> spans(hits.begin(), hits.end());
  for (const int most_support : {3, 1}) {
    const std::vector<ScanHit> pooled =
        pooled_hits(t.set, t.views, spans, *t.backend, pool_options(most_support, 30));
    ASSERT_EQ(pooled.size(), 30u);
    std::size_t next = 0;
    for (std::size_t v = 0; v < 4; ++v) {
      std::vector<ObjectView> others = t.views;
      others.erase(others.begin() + int(v));
      const std::vector<ObjectView> support =
          support_views(t.views[v], others, std::size_t(most_support));
      const std::vector<ScanHit> rescored =
          rescore_in_views({t.set, t.views[v], support, *t.backend}, hits[v], ScanOptions{});
      for (const ScanHit& own : rescored) {
        const ScanHit& hit = pooled[next++];
        EXPECT_EQ(hit.rank, own.rank);
        const Se3 in_world = inverse(t.views[v].camera_from_world) * own.pose.world_from_object,
                  pooled_in_world =
                      inverse(t.views[3].camera_from_world) * hit.pose.world_from_object;
        EXPECT_LT((in_world.translation_m - pooled_in_world.translation_m).norm(), 1e-12);
        EXPECT_LT(in_world.rotation.angularDistance(pooled_in_world.rotation), 1e-7);
      }
    }
  }
}

// The right pose is a hit of the first image only, where chance hits rank better.
TEST(PooledHits, AnEarlierHitComesFirstOnceOtherImagesShowIt) {
  Random random = test_random();
  for (int i = 0; i < 5; ++i) {
    const SeenPart t(3, 300, random);
    std::vector<std::vector<ScanHit>> hits(3);
    for (std::size_t v = 0; v < 3; ++v)
      for (int wrong = 0; wrong < 100; ++wrong)
        hits[v].push_back(hit_at(
            {random.rotation(), t.truth_in(v).translation_m + 0.05 * random.direction()}, 1));
    hits[0].push_back(hit_at(t.truth_in(0), 1.5));
    const std::vector<ScanHit> pooled =
        pooled_hits(t.set, t.views, std::vector<std::span<const ScanHit>>(hits.begin(), hits.end()),
                    *t.backend, pool_options(4, 60));
    const ScanHit& best = *std::ranges::min_element(pooled, {}, &ScanHit::rank);
    const Se3 truth = t.truth_in(2);
    EXPECT_LT((best.pose.world_from_object.translation_m - truth.translation_m).norm(), 0.02);
    EXPECT_LT(best.pose.world_from_object.rotation.angularDistance(truth.rotation), 1e-6);
  }
}

// The quick rescoring keeps the best of the full one, and excluded hits take no place among them.
TEST(PooledHits, QuickRescoringKeepsTheBestThatAreNotExcluded) {
  Random random = test_random();
  const SeenPart t(3, 300, random);
  std::vector<std::vector<ScanHit>> hits(3);
  for (std::size_t v = 0; v < 3; ++v)
    for (int i = 0; i < 400; ++i) {
      Vector6d off;
      off << 0.03 * random.uniform() * random.direction(),
          0.8 * random.uniform() * random.direction();
      hits[v].push_back(hit_at(retract(t.truth_in(v), off), random.uniform(1, 2)));
    }
  const std::vector<std::span<const ScanHit>> spans(hits.begin(), hits.end());
  const auto pooled = [&](const PoseFilter& excluded, std::size_t most) {
    std::vector<ScanHit> found =
        pooled_hits(t.set, t.views, spans, *t.backend, pool_options(4, most, excluded));
    std::ranges::sort(found, {}, &ScanHit::rank);
    return found;
  };
  const std::vector<ScanHit> all = pooled({}, 1200), some = pooled({}, 300);
  ASSERT_EQ(all.size(), 1200u);
  EXPECT_GE(some.size(), 300u);
  EXPECT_LT(some.size(), 330u) << "all ties are kept";
  const auto among = [](const ScanHit& hit, const std::vector<ScanHit>& others) {
    return std::ranges::any_of(others, [&](const ScanHit& other) {
      return other.rank == hit.rank &&
             other.pose.world_from_object.translation_m == hit.pose.world_from_object.translation_m;
    });
  };
  int kept = 0;
  for (std::size_t i = 0; i < 60; ++i) kept += among(all[i], some);
  EXPECT_GE(kept, 57) << "nineteen in twenty of the best twentieth, in the best quarter";
  const Eigen::Vector3d middle_m = t.views[2].camera_from_world * Eigen::Vector3d::Zero();
  const auto is_high = [&](const Se3& pose) {
    return (pose * t.set.model.center_m).y() < middle_m.y();
  };
  const std::vector<ScanHit> low = pooled(is_high, 300);
  EXPECT_GE(low.size(), 250u)
      << "others take the places of the excluded; the full rescoring moves some among them";
  for (const ScanHit& hit : low) EXPECT_FALSE(is_high(hit.pose.world_from_object));
  EXPECT_TRUE(pooled([](const Se3&) { return true; }, 300).empty());
}

}  // namespace
}  // namespace edgescout::test
