#include "host/active/reference_objects.h"

#include <gtest/gtest.h>

#include "host/render/parts.h"

namespace edgescout::test {
namespace {

ModeDetection at(int object, double x_m) {
  ModeDetection mode;
  mode.detection.object = object;
  mode.detection.world_from_object.translation_m.x() = x_m;
  mode.detection.probability = 0.5;
  return mode;
}

// An earlier instance that is not reported any more counts in its latest pose, where nothing else
// is reported.
TEST(ReferenceObjects, AreReportedNowOrWereBefore) {
  const std::vector<EdgeModel> models{make_edge_model(make_part("l_bracket").mesh),
                                      make_edge_model(make_part("bearing_block").mesh)};
  const double size_m = std::min(models[0].mesh.diameter_m, models[1].mesh.diameter_m);
  std::vector<ScoutStep> steps(3);
  steps[0].detections = {at(0, 0), at(0, 2), at(1, 4)};
  steps[1].detections = {at(0, 2 + 0.2 * size_m), at(0, 6)};
  const std::vector<ModeDetection> now{at(1, 0.1 * size_m)};
  std::vector<std::pair<int, double>> found;
  for (const ObjectPose& pose : reference_objects(models, steps, now))
    found.emplace_back(pose.object, pose.world_from_object.translation_m.x());
  EXPECT_EQ(found, (std::vector<std::pair<int, double>>{
                       {1, 0.1 * size_m}, {0, 2 + 0.2 * size_m}, {0, 6}, {1, 4}}));
  EXPECT_TRUE(reference_objects(models, {}, {}).empty());
}

}  // namespace
}  // namespace edgescout::test
