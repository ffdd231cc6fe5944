// Requests for detections: in the next image, or in those that they bring.
#include <gtest/gtest.h>

#include "tests/bridge/tested_bridge.h"

namespace edgescout::ros2::test {

namespace {

TEST(BridgeRequests, ARequestIsAnsweredByTheNextImage) {
  BridgeOptions options = quick();
  options.on_request = true;
  options.request_seconds = 30;
  TestedBridge tested(options);
  tested.give_info();
  tested.give_image(1);
  EXPECT_FALSE(tested.bridge.work(0));  // nobody asks
  std::vector<msg::DetectResult> answers;
  const auto keep = [&](const msg::DetectResult& result) { answers.push_back(result); };
  tested.bridge.request(msg::DetectRequest{}, keep);
  EXPECT_FALSE(tested.bridge.work(0));  // that image came before
  msg::Image bad = image_message(small_world().image(), 2);
  bad.encoding = "x";
  tested.bridge.take(ImageMessage(bad));
  tested.bridge.work(0);
  EXPECT_TRUE(answers.empty());
  tested.give_image(3);
  EXPECT_TRUE(tested.bridge.work(0));
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_TRUE(answers[0].success) << answers[0].message;
  EXPECT_EQ(answers[0].detections.header.stamp, header_at(3).stamp);
  EXPECT_FALSE(answers[0].detections.detections.empty());
  EXPECT_EQ(tested.results.detections.size(), 1u);  // published as well
  tested.give_image(4);
  EXPECT_FALSE(tested.bridge.work(0));
}

TEST(BridgeRequests, RequestsEndWithoutAnImage) {
  BridgeOptions options = quick();
  options.request_seconds = 0;
  TestedBridge tested(options);
  tested.give_image();
  std::vector<std::string> answers;
  tested.bridge.request(msg::DetectRequest{},
                        [&](const msg::DetectResult& r) { answers.push_back(r.message); });
  EXPECT_TRUE(tested.bridge.work(0));
  ASSERT_EQ(answers.size(), 1u);
  EXPECT_TRUE(holds(answers[0], "no image in time (camera_info: found no message")) << answers[0];
}

TEST(BridgeRequests, TooManyRequestsAreRefused) {
  TestedBridge tested;
  int refused = 0;
  for (int i = 0; i < 100; ++i) {
    tested.bridge.request(msg::DetectRequest{}, [&](const msg::DetectResult& r) {
      refused += holds(r.message, "too many");
    });
    tested.bridge.request(msg::ScoutStateRequest{}, [&](const msg::ScoutStateResult& r) {
      refused += holds(r.message, "too many");
    });
  }
  EXPECT_EQ(refused, 2 * (100 - 64));
}

TEST(BridgeRequests, ALimitOfTimeIsKeptAndSaid) {
  TestedBridge tested;
  tested.give_info();
  msg::DetectResult answer;
  tested.bridge.request(msg::DetectRequest{1e-6}, [&](const msg::DetectResult& r) { answer = r; });
  tested.give_image();
  tested.bridge.work(0);
  EXPECT_TRUE(answer.success);
  EXPECT_EQ(answer.message, "deadline passed");
  EXPECT_EQ(tested.count("images not worked on wholly"), 1u);
}

TEST(BridgeRequests, EstimatesPosesOverSeveralCameras) {
  TestedBridge tested;
  msg::GetPoseEstimatesResult answer;
  const auto ask = [&](const msg::GetPoseEstimatesRequest& request) {
    tested.bridge.request(request, [&](const msg::GetPoseEstimatesResult& r) { answer = r; });
    EXPECT_TRUE(tested.bridge.work(0));
  };
  ask({{1}, {calibrated(0), calibrated(1)}});
  ASSERT_TRUE(answer.success) << answer.message;
  ASSERT_FALSE(answer.pose_estimates.empty());
  EXPECT_EQ(answer.pose_estimates[0].obj_id, 1u);
  expect_same_pose(answer.pose_estimates[0].pose, small_world().scene.placed[0].world_from_object,
                   0.02);
  ask({{1}, {}});
  EXPECT_TRUE(holds(answer.message, "cameras: found none"));
  EXPECT_FALSE(answer.success);
  ask({{7}, {calibrated(0)}});
  EXPECT_TRUE(holds(answer.message, "object_ids: found 7, expected one of 1"));
  msg::CalibratedImage bad = calibrated(1);
  bad.pose.orientation = {0, 0, 0, 0};
  ask({{}, {calibrated(0), bad}});
  EXPECT_TRUE(holds(answer.message, "cameras[1]")) << answer.message;
  bad = calibrated(1);
  bad.info.k = {};
  ask({{}, {calibrated(0), bad}});
  EXPECT_TRUE(holds(answer.message, "cameras[1]: k")) << answer.message;
}

}  // namespace

}  // namespace edgescout::ros2::test
