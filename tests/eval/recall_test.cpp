#include "host/eval/recall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/error.h"
#include "tests/eval/cube.h"

namespace edgescout {
namespace {

TEST(Recall, OfPerfectEstimatesIsOne) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0), truth(1, 500), truth(2, 1000)};
  one.estimates = {estimate(1, 500, 0.5), estimate(2, 1000, 0.4), estimate(1, 0, 0.9)};
  const Recalls recalls = evaluate(std::vector{one}, CUBES, {});
  EXPECT_EQ(recalls.truths, 3);
  EXPECT_EQ(recalls.estimates, 3);
  EXPECT_DOUBLE_EQ(recalls.ar_mssd, 1);
  EXPECT_DOUBLE_EQ(recalls.ar_mspd, 1);
  EXPECT_DOUBLE_EQ(recalls.recall_raw, 1);
  EXPECT_DOUBLE_EQ(recalls.recall_symmetric, 1);
  EXPECT_DOUBLE_EQ(recalls.recall_mspd, 1);
  EXPECT_EQ(recalls.false_positives, 0);
}

// 12 mm off: 12 % of the diameter passes the thresholds from 15 % on, 8 of 10; 120 px pass none.
TEST(Recall, CountsThresholdsOfTheDiameter) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0)};
  one.estimates = {estimate(1, 12, 1)};
  const Recalls recalls = evaluate(std::vector{one}, CUBES, {});
  EXPECT_DOUBLE_EQ(recalls.mssd[1], 0);
  EXPECT_DOUBLE_EQ(recalls.mssd[2], 1);
  EXPECT_NEAR(recalls.ar_mssd, 0.8, 1e-12);
  EXPECT_DOUBLE_EQ(recalls.ar_mspd, 0);
  EXPECT_EQ(recalls.false_positives, 1);
}

// 2.2 mm off: 22 px. At 640 px the thresholds from 25 px on pass (6 of 10), at 1280 px they are 10,
// 20, 30 .. (8 of 10).
TEST(Recall, ScalesPixelThresholdsWithTheImage) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0)};
  one.estimates = {estimate(1, 2.2, 1)};
  EXPECT_NEAR(evaluate(std::vector{one}, CUBES, {}).ar_mspd, 0.6, 1e-12);
  one.camera.width = 1280;
  const Recalls recalls = evaluate(std::vector{one}, CUBES, {});
  EXPECT_NEAR(recalls.ar_mspd, 0.8, 1e-12);
  EXPECT_DOUBLE_EQ(recalls.recall_mspd, 0) << "10 px stay 10 px";
  EXPECT_DOUBLE_EQ(recalls.recall_raw, 1) << "within 5 mm";
}

TEST(Recall, UsesEachTruthOnce) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0), truth(1, 300)};
  one.estimates = {estimate(1, 0, 0.9), estimate(1, 0.1, 0.8), estimate(1, 0.2, 0.7)};
  const Recalls recalls = evaluate(std::vector{one}, CUBES, {});
  EXPECT_DOUBLE_EQ(recalls.recall_mspd, 0.5);
  EXPECT_EQ(recalls.false_positives, 2);
}

// The best score chooses first and takes the nearer truth, though the second would fit the other
// estimate only.
TEST(Recall, MatchesGreedilyByScore) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0), truth(1, 0.8)};
  one.estimates = {estimate(1, 0.5, 0.9), estimate(1, 1.6, 0.8)};
  // The first is 5 px from truth 0 and 3 px from truth 0.8: takes the latter. The second is 16 px
  // from truth 0.
  EXPECT_DOUBLE_EQ(evaluate(std::vector{one}, CUBES, {}).recall_mspd, 0.5);
  one.estimates[1].score = 0.95;  // now 8 px from truth 0.8, takes it; the other has truth 0 left
  EXPECT_DOUBLE_EQ(evaluate(std::vector{one}, CUBES, {}).recall_mspd, 1);
}

TEST(Recall, LooksAtAsManyEstimatesAsTruthsForBopOnly) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0)};
  one.estimates = {estimate(1, 0, 0.5), estimate(1, 400, 0.9)};
  const Recalls recalls = evaluate(std::vector{one}, CUBES, {});
  EXPECT_DOUBLE_EQ(recalls.ar_mssd, 0);
  EXPECT_DOUBLE_EQ(recalls.recall_mspd, 1);
  EXPECT_EQ(recalls.false_positives, 1);
}

// Of a list of 2019: two instances of object 1 are to be found, nothing of object 2.
TEST(Recall, CountsWhatTheTargetsWant) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0, 0.5), truth(1, 300, 0.05), truth(1, 600, 0.04), truth(2, 900)};
  one.estimates = {estimate(1, 0, 0.9), estimate(1, 600, 0.8), estimate(2, 1200, 0.7)};
  one.targets = {{1, 2}};
  const Recalls recalls = evaluate(std::vector{one}, CUBES, {});
  EXPECT_EQ(recalls.truths, 2);
  EXPECT_EQ(recalls.estimates, 2);
  EXPECT_DOUBLE_EQ(recalls.ar_mssd, 0.5) << "the most visible ones, although one is hidden";
  EXPECT_EQ(recalls.false_positives, 0);
}

TEST(Recall, IgnoresHiddenTruths) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0), truth(1, 300, 0.3)};
  one.estimates = {estimate(1, 0, 0.9), estimate(1, 300, 0.8), estimate(1, 600, 0.7)};
  RecallOptions options;
  options.min_visible_fraction = 0.7;
  const Recalls with = evaluate(std::vector{one}, CUBES, options);
  EXPECT_EQ(with.truths, 1);
  EXPECT_DOUBLE_EQ(with.recall_mspd, 1);
  EXPECT_EQ(with.false_positives, 1) << "the one at 600 alone";
  one.estimates.erase(one.estimates.begin() + 1);
  const Recalls without = evaluate(std::vector{one}, CUBES, options);
  EXPECT_DOUBLE_EQ(without.recall_mspd, 1);
  EXPECT_DOUBLE_EQ(without.ar_mssd, 1);
}

// BOP's toolkit looks at as many estimates as there are truths that count, and gives none to the
// others.
TEST(Recall, OfBopGivesNothingToHiddenTruths) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0), truth(1, 300, 0.3)};
  one.estimates = {estimate(1, 300, 0.9), estimate(1, 0, 0.8)};
  RecallOptions options;
  options.min_visible_fraction = 0.7;
  const Recalls recalls = evaluate(std::vector{one}, CUBES, options);
  EXPECT_DOUBLE_EQ(recalls.ar_mssd, 0) << "the first estimate alone is looked at";
  EXPECT_DOUBLE_EQ(recalls.recall_mspd, 1);
  EXPECT_EQ(recalls.false_positives, 0);
}

TEST(Recall, CountsFalsePositivesAboveTheScorePerImage) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0)};
  one.estimates = {estimate(1, 0, 0.9), estimate(1, 100, 0.6), estimate(2, 0, 0.55),
                   estimate(2, 50, 0.2)};
  RecallOptions options;
  options.min_score = 0.5;
  const Recalls recalls = evaluate(std::vector{one, image()}, CUBES, options);
  EXPECT_EQ(recalls.images, 2);
  EXPECT_EQ(recalls.estimates, 3);
  EXPECT_EQ(recalls.false_positives, 2) << "of another object at the same place counts too";
  EXPECT_DOUBLE_EQ(recalls.false_positives_per_image, 1);
}

TEST(Recall, CountsEveryScoreByDefault) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0)};
  one.estimates = {estimate(1, 0, -3)};
  EXPECT_DOUBLE_EQ(evaluate(std::vector{one}, CUBES, {}).recall_mspd, 1);
}

TEST(Recall, DistinguishesRawFromSymmetric) {
  std::map<int, Object> objects = CUBES;
  const Se3 half_turn{so3_exp({0, 0, 3.14159265358979}), {0, 0, 0}};
  objects[1].symmetries.discrete.push_back(half_turn);
  EvaluationImage one = image();
  one.truth = {truth(1, 0)};
  one.estimates = {estimate(1, 0, 1)};
  one.estimates[0].camera_from_object = at_mm(0) * half_turn;
  const Recalls recalls = evaluate(std::vector{one}, objects, {});
  EXPECT_DOUBLE_EQ(recalls.recall_raw, 0);
  EXPECT_DOUBLE_EQ(recalls.recall_symmetric, 1);
  EXPECT_DOUBLE_EQ(recalls.ar_mssd, 1);
}

TEST(Recall, BreaksDownByObject) {
  EvaluationImage one = image();
  one.truth = {truth(1, 0), truth(2, 300)};
  one.estimates = {estimate(1, 0, 0.9), estimate(2, 0, 0.9)};
  const std::map<int, Recalls> recalls = evaluate_by_object(std::vector{one}, CUBES, {});
  ASSERT_EQ(recalls.size(), 2u);
  EXPECT_DOUBLE_EQ(recalls.at(1).recall_mspd, 1);
  EXPECT_EQ(recalls.at(1).false_positives, 0);
  EXPECT_DOUBLE_EQ(recalls.at(2).recall_mspd, 0);
  EXPECT_EQ(recalls.at(2).false_positives, 1);
}

// The greedy matching against its definition, spelled out over all estimates and truths.
TEST(Recall, AgreesWithThePlainDefinition) {
  unsigned state = 1;
  const auto draw = [&](double scale) {
    return scale * ((state = state * 1664525u + 1013904223u) >> 8) / 0x1p24;
  };
  for (int round = 0; round < 200; ++round) {
    EvaluationImage one = image();
    for (int i = 0; i < 4; ++i) one.truth.push_back(truth(1, draw(4)));
    for (int i = 0; i < 6; ++i) one.estimates.push_back(estimate(1, draw(4), draw(1)));
    std::vector<BopResult> sorted = one.estimates;
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return a.score > b.score; });
    std::vector<double> free_mm;
    for (const BopTruth& t : one.truth)
      free_mm.push_back(1e3 * t.camera_from_object.translation_m.x());
    int found = 0;
    for (const BopResult& e : sorted) {
      const double x = 1e3 * e.camera_from_object.translation_m.x();
      const auto nearest =
          std::min_element(free_mm.begin(), free_mm.end(),
                           [&](double a, double b) { return std::abs(a - x) < std::abs(b - x); });
      if (nearest == free_mm.end() || std::abs(*nearest - x) >= 2) continue;
      free_mm.erase(nearest);
      ++found;
    }
    RecallOptions options;
    options.max_distance_m = 0.002;
    const Recalls recalls = evaluate(std::vector{one}, CUBES, options);
    ASSERT_NEAR(recalls.recall_raw, found / 4.0, 1e-12) << "round " << round;
  }
}

BopScene scene_of_two_images() {
  BopScene scene;
  scene.scene_id = 4;
  for (const int id : {3, 8}) {
    BopImage bop;
    bop.image_id = id;
    bop.camera = image().camera;
    scene.images.push_back(bop);
    scene.truth[id] = {truth(1, id)};
  }
  return scene;
}

TEST(EvaluationImages, PutResultsToTheirImages) {
  std::vector<BopResult> results{estimate(1, 8, 1), estimate(1, 3, 1), estimate(1, 3, 1)};
  for (BopResult& result : results) result.scene_id = 4;
  results[0].image_id = 8;
  results[1].image_id = 3;
  results[2].scene_id = 5;
  const std::vector<EvaluationImage> images = evaluation_images(scene_of_two_images(), results);
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[0].estimates.size(), 1u);
  EXPECT_EQ(images[1].estimates.size(), 1u);
  EXPECT_DOUBLE_EQ(evaluate(images, CUBES, {}).ar_mssd, 1);
}

TEST(EvaluationImages, RefuseWhatDoesNotFitTheScene) {
  std::vector<BopResult> results{estimate(1, 8, 1)};
  results[0].scene_id = 4;
  results[0].image_id = 9;
  EXPECT_THROW(evaluation_images(scene_of_two_images(), results), InputError);
  BopScene scene = scene_of_two_images();
  scene.images[1].camera.width = 0;
  EXPECT_THROW(evaluation_images(scene, {}), InputError);
  scene = scene_of_two_images();
  scene.truth.erase(8);
  EXPECT_THROW(evaluation_images(scene, {}), InputError);
}

TEST(Recall, RefusesWhatItCannotEvaluate) {
  EvaluationImage one = image();
  one.estimates = {estimate(3, 0, 1)};
  EXPECT_THROW(evaluate(std::vector{one}, CUBES, {}), InputError);
  RecallOptions options;
  options.min_visible_fraction = 1.5;
  EXPECT_THROW(options.validate(), InputError);
  options = {};
  options.min_score = std::nan("");
  EXPECT_THROW(options.validate(), InputError);
  options = {};
  options.max_mspd_px = 0;
  EXPECT_THROW(options.validate(), InputError);
}

}  // namespace
}  // namespace edgescout
