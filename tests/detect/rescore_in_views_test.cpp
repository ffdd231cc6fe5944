// Hits judged by several views: against sums over projected points, and what it is worth to a hit
// that is right.
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

constexpr double pi = std::numbers::pi;

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
  std::vector<Observation> views;

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
      views.push_back(observe_edges(edges, small_camera(), 1, *backend));
      views.back().view.camera_from_world = camera_from_world;
    }
  }
  std::span<const Observation> others() const { return std::span(views).subspan(1); }
  std::vector<ScanHit> judged(std::span<const ScanHit> hits) const {
    return rescore_in_views(set, hits, views[0], others(), *backend, ScanOptions{});
  }

  // Mean of a pose's points, as seen from the viewpoint nearest to where the camera sees `hit` from
  // modulo symmetry, in this view, weighted as ScanHit::rank; of the points in columns from
  // `first_column` on, and the fraction that they are.
  double rank_in(const Observation& view, const Se3& hit, Se3 pose, double first_column = -INFINITY,
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
    const TensorShape& shape = view.salient->shape;
    const std::vector<std::uint16_t> tensor = view.salient->tensor();
    const int count = std::min<int>(ScanOptions{}.points, int(nearest->points.size()));
    double sum = 0;
    int shown = 0;
    for (int i = 0; i < count; ++i) {
      const ModelPoint& p =
          nearest->points[std::size_t(i) * nearest->points.size() / std::size_t(count)];
      const Eigen::Vector3d at = pose * Eigen::Vector3d(p.x_m, p.y_m, p.z_m);
      const Eigen::Vector3d ahead = at + 1e-6 * (pose.rotation * Eigen::Vector3d(p.tx, p.ty, p.tz));
      const Eigen::Vector2d pixel = project(view.coarse_camera, at),
                            along = project(view.coarse_camera, ahead) - pixel;
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

const PoseFilter nothing_excluded = [](const Se3&) { return false; };

ScanHit hit_at(const Se3& pose, double rank) {
  ScanHit hit;
  hit.camera_from_object = pose;
  hit.rank = rank;
  return hit;
}

TEST(JointScan, EqualsTheBestSumOverDistances) {
  Random random = test_random();
  const SeenPart t(3, 300, random);
  std::vector<ScanHit> hits;
  for (int i = 0; i < 40; ++i) {
    Vector6d off;
    off << 0.03 * random.direction(), 0.5 * random.direction();
    hits.push_back(
        hit_at(retract(t.views[0].view.camera_from_world * t.truth, off), random.uniform(1, 3)));
  }
  const std::vector<ScanHit> judged = t.judged(hits);
  ASSERT_EQ(judged.size(), hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    double lowest = INFINITY;
    for (const double further : {-0.05, -0.025, 0.0, 0.025, 0.05}) {
      Se3 pose = hits[i].camera_from_object;
      pose.translation_m += further * (pose * t.set.model.center_m);
      double sum = hits[i].rank;
      for (const Observation& other : t.others()) {
        const Se3 other_from_own =
            other.view.camera_from_world * inverse(t.views[0].view.camera_from_world);
        sum += t.rank_in(other, other_from_own * hits[i].camera_from_object, other_from_own * pose);
      }
      lowest = std::min(lowest, sum / 3);
    }
    EXPECT_NEAR(judged[i].rank, lowest, 0.02) << "a point or two of sixty round the other way";
    const Eigen::Vector3d before = hits[i].camera_from_object * t.set.model.center_m,
                          after = judged[i].camera_from_object * t.set.model.center_m;
    EXPECT_LT(before.normalized().cross(after.normalized()).norm(), 1e-9) << "along its ray";
    EXPECT_TRUE(judged[i].camera_from_object.rotation.coeffs() ==
                hits[i].camera_from_object.rotation.coeffs());
  }
}

// A set holds half of the viewpoints of a part with a half turn, and a sixth and less of others.
// The truth fits the images from all sides all the same.
TEST(JointScan, JudgesSymmetricPartsFromAllSides) {
  Random random = test_random();
  for (const char* part : {"l_bracket", "hex_nut"}) {
    const SeenPart t(25, 0, random, part);
    ASSERT_GE(t.views.size(), 2u);
    const ScanHit hit = hit_at(t.views[0].view.camera_from_world * t.truth, 0);
    double mean_px = 0;  // over all views; 1.3 where every viewpoint has its template, 1.7 to the
                         // nearest kept one
    for (const Observation& other : t.others())
      mean_px +=
          2 *
          rescore_in_views(t.set, {&hit, 1}, t.views[0], {&other, 1}, *t.backend, ScanOptions{})[0]
              .rank /
          std::pow(0.31, 0.25) / double(t.others().size());
    EXPECT_LT(mean_px, 1.5) << part;
  }
}

// Another view sees the distance that the own one does not.
TEST(JointScan, PutsARightHitAtItsDistanceAndBeforeWrongOnes) {
  Random random = test_random();
  for (int i = 0; i < 5; ++i) {
    const SeenPart t(3, 300, random);
    const Se3 truth = t.views[0].view.camera_from_world * t.truth;
    Se3 too_far = truth;
    too_far.translation_m += 0.05 * (truth * t.set.model.center_m);
    std::vector<ScanHit> hits{hit_at(too_far, 1)};
    for (int wrong = 0; wrong < 200; ++wrong)
      hits.push_back(
          hit_at({random.rotation(), truth.translation_m + 0.05 * random.direction()}, 1));
    const std::vector<ScanHit> judged = t.judged(hits);
    EXPECT_LT((judged[0].camera_from_object.translation_m - truth.translation_m).norm(), 0.001);
    for (std::size_t h = 1; h < judged.size(); ++h) EXPECT_LT(judged[0].rank, judged[h].rank);
  }
}

TEST(JointScan, AloneItChangesNothing) {
  Random random = test_random();
  const SeenPart t(1, 0, random);
  const std::vector<ScanHit> hits{hit_at(t.views[0].view.camera_from_world * t.truth, 2)};
  const std::vector<ScanHit> judged = t.judged(hits);
  ASSERT_EQ(judged.size(), 1u);
  EXPECT_EQ(judged[0].rank, 2);
  EXPECT_TRUE(judged[0].camera_from_object.translation_m ==
              hits[0].camera_from_object.translation_m);
}

// Known objects before a part's half, or all of it: only what they leave has a say.
TEST(JointScan, WhatKnownObjectsHideHasNoSay) {
  Random random = test_random();
  SeenPart t(2, 300, random);
  const Se3 truth = t.views[0].view.camera_from_world * t.truth;
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
    t.views[1].view.occluders = occluders;
    return t.judged(hits);
  };
  const std::vector<ScanHit> free = t.judged(hits), hidden = behind(320, 0.1f),
                             before = behind(320, 0.9f);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_NEAR(hidden[i].rank, hits[i].rank, 1e-12) << "its own view's say alone";
    EXPECT_EQ(hidden[i].camera_from_object.translation_m, hits[i].camera_from_object.translation_m);
    EXPECT_EQ(before[i].rank, free[i].rank) << "what stands behind it hides nothing";
  }
  const std::vector<ScanHit> half = behind(160, 0.1f);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    double lowest = INFINITY;
    for (const double further : {-0.05, -0.025, 0.0, 0.025, 0.05}) {
      Se3 pose = hits[i].camera_from_object;
      pose.translation_m += further * (pose * t.set.model.center_m);
      const Se3 there =
          t.views[1].view.camera_from_world * inverse(t.views[0].view.camera_from_world);
      double shown = 0;
      const double rank =
          t.rank_in(t.views[1], there * hits[i].camera_from_object, there * pose, 160, &shown);
      lowest = std::min(lowest, (hits[i].rank + (shown > 0 ? shown * rank : 0)) / (1 + shown));
    }
    EXPECT_NEAR(half[i].rank, lowest, 0.04) << "a point or two of sixty round the other way";
  }
}

// A view that looks the other way knows nothing, for or against.
TEST(JointScan, BehindAnotherCameraItCountsAsChance) {
  Random random = test_random();
  SeenPart t(2, 0, random);
  t.views[1].view.camera_from_world = looking_at_origin({0, 0, 0.3});
  t.views[1].view.camera_from_world.translation_m.z() = -0.5;
  const std::vector<ScanHit> judged =
      t.judged(std::vector{hit_at(t.views[0].view.camera_from_world * t.truth, 2)});
  const Se3 in_other = t.views[1].view.camera_from_world * t.truth;
  EXPECT_LT((in_other * t.set.model.center_m).z(), 0);
  EXPECT_NEAR(judged[0].rank, (2 + 3.25 * std::pow(0.5, 0.25)) / 2, 0.05);
  EXPECT_EQ(judged[0].camera_from_object.translation_m,
            (t.views[0].view.camera_from_world * t.truth).translation_m)
      << "at no distance is it likelier";
}

// The hits of every image as the others judge them, seen from the last camera.
TEST(JointScan, PoolsWhatEveryImageHas) {
  Random random = test_random();
  const SeenPart t(4, 300, random);
  std::vector<std::vector<ScanHit>> hits(4);
  for (std::size_t v = 0; v < 4; ++v)
    for (std::size_t i = 0; i < 5 * v; ++i) {  // none in the first
      Vector6d off;
      off << 0.03 * random.direction(), 0.5 * random.direction();
      hits[v].push_back(hit_at(retract(t.views[v].view.camera_from_world * t.truth, off), 2));
    }
  const std::vector<std::span<const ScanHit>> spans(hits.begin(), hits.end());
  for (const int helping : {3, 1}) {
    const std::vector<ScanHit> pooled = pooled_hits(
        t.set, t.views, spans, helping, nothing_excluded, 30, *t.backend, ScanOptions{});
    ASSERT_EQ(pooled.size(), 30u);
    std::size_t next = 0;
    for (std::size_t v = 0; v < 4; ++v) {
      std::vector<Observation> others = t.views;
      others.erase(others.begin() + int(v));
      const std::vector<ScanHit> judged = rescore_in_views(
          t.set, hits[v], t.views[v], support_views(t.views[v], others, std::size_t(helping)),
          *t.backend, ScanOptions{});
      for (const ScanHit& own : judged) {
        const ScanHit& hit = pooled[next++];
        EXPECT_EQ(hit.rank, own.rank);
        const Se3 in_world = inverse(t.views[v].view.camera_from_world) * own.camera_from_object,
                  pooled_in_world =
                      inverse(t.views[3].view.camera_from_world) * hit.camera_from_object;
        EXPECT_LT((in_world.translation_m - pooled_in_world.translation_m).norm(), 1e-12);
        EXPECT_LT(in_world.rotation.angularDistance(pooled_in_world.rotation), 1e-7);
      }
    }
  }
}

// A part that the newest image does not show is a hit of the first one alone, where chance ranks
// better.
TEST(JointScan, AnEarlierHitComesFirstOnceOtherImagesShowIt) {
  Random random = test_random();
  for (int i = 0; i < 5; ++i) {
    const SeenPart t(3, 300, random);
    std::vector<std::vector<ScanHit>> hits(3);
    for (std::size_t v = 0; v < 3; ++v)
      for (int wrong = 0; wrong < 100; ++wrong)
        hits[v].push_back(
            hit_at({random.rotation(), (t.views[v].view.camera_from_world * t.truth).translation_m +
                                           0.05 * random.direction()},
                   1));
    hits[0].push_back(hit_at(t.views[0].view.camera_from_world * t.truth, 1.5));
    const std::vector<ScanHit> pooled =
        pooled_hits(t.set, t.views, std::vector<std::span<const ScanHit>>(hits.begin(), hits.end()),
                    4, nothing_excluded, 60, *t.backend, ScanOptions{});
    const ScanHit& best = *std::ranges::min_element(pooled, {}, &ScanHit::rank);
    const Se3 truth = t.views[2].view.camera_from_world * t.truth;
    EXPECT_LT((best.camera_from_object.translation_m - truth.translation_m).norm(), 0.02);
    EXPECT_LT(best.camera_from_object.rotation.angularDistance(truth.rotation), 1e-6);
  }
}

// What a quick look leaves is the best of what all would be, and nothing excluded takes a place
// among it.
TEST(JointScan, AQuickLookKeepsTheBestThatAreWanted) {
  Random random = test_random();
  const SeenPart t(3, 300, random);
  std::vector<std::vector<ScanHit>> hits(3);
  for (std::size_t v = 0; v < 3; ++v)
    for (int i = 0; i < 400; ++i) {
      Vector6d off;
      off << 0.03 * random.uniform() * random.direction(),
          0.8 * random.uniform() * random.direction();
      hits[v].push_back(
          hit_at(retract(t.views[v].view.camera_from_world * t.truth, off), random.uniform(1, 2)));
    }
  const std::vector<std::span<const ScanHit>> spans(hits.begin(), hits.end());
  const auto pooled = [&](const PoseFilter& excluded, std::size_t most) {
    std::vector<ScanHit> found =
        pooled_hits(t.set, t.views, spans, 4, excluded, most, *t.backend, ScanOptions{});
    std::ranges::sort(found, {}, &ScanHit::rank);
    return found;
  };
  const std::vector<ScanHit> all = pooled(nothing_excluded, 1200),
                             some = pooled(nothing_excluded, 300);
  ASSERT_EQ(all.size(), 1200u);
  EXPECT_GE(some.size(), 300u);
  EXPECT_LT(some.size(), 330u) << "of ties all";
  const auto among = [](const ScanHit& hit, const std::vector<ScanHit>& others) {
    return std::ranges::any_of(others, [&](const ScanHit& other) {
      return other.rank == hit.rank &&
             other.camera_from_object.translation_m == hit.camera_from_object.translation_m;
    });
  };
  int kept = 0;
  for (std::size_t i = 0; i < 60; ++i) kept += among(all[i], some);
  EXPECT_GE(kept, 57) << "nineteen in twenty of the best twentieth, in the best quarter";
  const Eigen::Vector3d middle_m = t.views[2].view.camera_from_world * Eigen::Vector3d::Zero();
  const auto is_high = [&](const Se3& pose) {
    return (pose * t.set.model.center_m).y() < middle_m.y();
  };
  const std::vector<ScanHit> low = pooled(is_high, 300);
  EXPECT_GE(low.size(), 250u)
      << "what the excluded leave free is taken; a closer look moves some among them";
  for (const ScanHit& hit : low) EXPECT_FALSE(is_high(hit.camera_from_object));
  EXPECT_TRUE(pooled([](const Se3&) { return true; }, 300).empty());
}

}  // namespace
}  // namespace edgescout::test
