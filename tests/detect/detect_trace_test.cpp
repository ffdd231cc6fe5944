#include "host/detect/detect_trace.h"

#include <gtest/gtest.h>

#include "kernels/error.h"

namespace edgescout::test {
namespace {

PoseEstimate estimate_at(int object, double x_m, double psi) {
  PoseEstimate estimate;
  estimate.object = object;
  estimate.world_from_object.translation_m = {x_m, 0, 1};
  estimate.features.resize(1);
  estimate.features[0].psi = psi;
  return estimate;
}

Detection detection_of(const PoseEstimate& estimate) {
  Detection detection;
  detection.object = estimate.object;
  detection.world_from_object = estimate.world_from_object;
  return detection;
}

TEST(DetectTrace, ACopyHasTheSameObjectAndPoseBitForBit) {
  const PoseEstimate pose = estimate_at(1, 0.1, 0.8);
  EXPECT_TRUE(is_copy(pose, estimate_at(1, 0.1, 0.7)));
  EXPECT_FALSE(is_copy(pose, estimate_at(0, 0.1, 0.8)));
  EXPECT_FALSE(is_copy(pose, estimate_at(1, std::nextafter(0.1, 1), 0.8)));
  PoseEstimate turned = pose;
  turned.world_from_object.rotation = Eigen::AngleAxisd(1e-9, Eigen::Vector3d::UnitX());
  EXPECT_FALSE(is_copy(pose, turned));
}

TEST(DetectTrace, SelectedEstimatesAreThoseThatCompetedInTheOrderOfSelection) {
  SelectionTrace selection;
  for (int i = 0; i < 4; ++i) selection.competing.push_back(estimate_at(i % 2, 0.1 * i, 0.1 * i));
  for (const std::size_t i : {3, 1})
    selection.selected.push_back(detection_of(selection.competing[i]));
  const std::vector<PoseEstimate> selected = selected_estimates(selection);
  ASSERT_EQ(selected.size(), 2u);
  EXPECT_EQ(selected[0].features[0].psi, selection.competing[3].features[0].psi);
  EXPECT_EQ(selected[1].features[0].psi, selection.competing[1].features[0].psi);
  selection.selected.push_back(detection_of(estimate_at(0, 5, 0)));
  EXPECT_THROW(selected_estimates(selection), LogicError);
}

}  // namespace
}  // namespace edgescout::test
