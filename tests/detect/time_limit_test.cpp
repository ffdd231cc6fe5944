// Detection under a limit of time: complete where it suffices, what was found where it does not.
#include <gtest/gtest.h>

#include "tests/detect/rendered_part.h"

namespace edgescout::test {
namespace {

// Ends the work after `answers` questions.
struct Patience {
  int answers;
  int asked = 0;
  TimeLimit limit() {
    return {{}, [this] { return ++asked > answers; }};
  }
};

constexpr int ENDLESS = 1 << 30;

struct LimitedDetection : testing::Test {
  RenderedPart scene{"bearing_block", 2};
  std::unique_ptr<Backend> cpu = make_cpu_backend(2);

  Detections detect(const TimeLimit& limit) const {
    PipelineOptions options = scene.options();
    options.limit = limit;
    return detect_objects(scene.prepared(0, Se3{}, *cpu), scene.sets, *cpu, options);
  }
  Detections detect_in_both(const TimeLimit& limit) const {
    PipelineOptions options = scene.options();
    options.limit = limit;
    std::vector<ObjectView> views;
    for (std::size_t v = 0; v < 2; ++v)
      views.push_back(scene.prepared(v, scene.scene.views[v].camera_from_world, *cpu));
    return detect_jointly(views, scene.sets, *cpu, options);
  }
};

void expect_equal(const Detections& a, const Detections& b) {
  ASSERT_EQ(a.detections.size(), b.detections.size());
  for (std::size_t i = 0; i < a.detections.size(); ++i) {
    EXPECT_EQ(a.detections[i].probability, b.detections[i].probability);
    EXPECT_EQ(a.detections[i].world_from_object.translation_m,
              b.detections[i].world_from_object.translation_m);
    EXPECT_EQ(a.detections[i].world_from_object.rotation.coeffs(),
              b.detections[i].world_from_object.rotation.coeffs());
  }
}

TEST_F(LimitedDetection, AnEndlessLimitChangesNothing) {
  Patience endless{ENDLESS};
  const Detections limited = detect(endless.limit()), free = detect({});
  EXPECT_EQ(limited.completion, Completion::Complete);
  EXPECT_EQ(free.completion, Completion::Complete);
  ASSERT_FALSE(free.detections.empty());
  expect_equal(limited, free);
  EXPECT_GT(endless.asked, 50) << "questions in one image";
}

TEST_F(LimitedDetection, ALimitThatIsOverGivesNothing) {
  for (const Detections& found :
       {detect(TimeLimit::after(0)), detect_in_both(TimeLimit::after(0))}) {
    EXPECT_EQ(found.completion, Completion::DeadlinePassed);
    EXPECT_TRUE(found.detections.empty());
  }
  Patience none{0};
  EXPECT_EQ(detect(none.limit()).completion, Completion::Cancelled);
}

// Whatever is cut off, poses are valid; near the end the part has been found.
TEST_F(LimitedDetection, GivesWhatWasFoundBeforeItsEnd) {
  Patience endless{ENDLESS};
  detect(endless.limit());
  for (const double part : {0.2, 0.6, 0.95}) {
    Patience patience{int(part * endless.asked)};
    const Detections found = detect(patience.limit());
    EXPECT_EQ(found.completion, Completion::Cancelled) << part;
    EXPECT_LT(patience.asked - patience.answers, 40) << "questions after the end at " << part;
    for (const Detection& d : found.detections) {
      EXPECT_TRUE(is_finite(d.world_from_object));
      EXPECT_TRUE(d.probability >= 0 && d.probability <= 1);
    }
    if (part < 0.9) continue;
    ASSERT_FALSE(found.detections.empty());
    const PoseError error = scene.error(found.detections[0].world_from_object, scene.truth_in(0));
    EXPECT_TRUE(error.passes(0.15, 0.01))
        << error.angle_rad << " rad, " << error.distance_m << " m";
  }
}

TEST_F(LimitedDetection, OfSeveralViewsEndsWithinThem) {
  Patience patience{100};
  const Detections found = detect_in_both(patience.limit());
  EXPECT_EQ(found.completion, Completion::Cancelled);
  EXPECT_LT(patience.asked - patience.answers, 60) << "questions after the end";
  for (const Detection& d : found.detections) EXPECT_TRUE(is_finite(d.world_from_object));
}

}  // namespace
}  // namespace edgescout::test
