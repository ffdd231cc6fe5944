// Requests of an active detection: propose, give, state.
#include <gtest/gtest.h>

#include "host/bridge/ros2/depth_message.h"
#include "tests/bridge/tested_bridge.h"

namespace edgescout::ros2::test {

namespace {

// Asks and returns the answer of a request that needs no image.
template <typename Result, typename Request>
Result answer_of(TestedBridge& tested, const Request& request) {
  Result answer;
  tested.bridge.request(request, Answer<Result>([&](const Result& result) { answer = result; }));
  tested.bridge.work(0);
  return answer;
}

TEST(BridgeScout, ScoutsWithACameraOnAnArm) {
  ArmBridge tested;
  using Propose = msg::ScoutProposeResult;
  using Give = msg::ScoutGiveResult;
  using State = msg::ScoutStateResult;
  EXPECT_TRUE(holds(answer_of<State>(tested, msg::ScoutStateRequest{}).message, "run: found none"));
  EXPECT_TRUE(holds(answer_of<Propose>(tested, msg::ScoutProposeRequest{}).message,
                    "camera_info: messages: found none"));
  tested.give_info();
  const Propose first = answer_of<Propose>(tested, msg::ScoutProposeRequest{});
  ASSERT_TRUE(first.success) << first.message;
  EXPECT_FALSE(first.done);
  EXPECT_EQ(first.camera_pose.header.frame_id, "world");
  expect_same_pose(first.camera_pose.pose,
                   inverse(small_world().camera_from_world(std::size_t(first.view))), 1e-12);
  EXPECT_TRUE(holds(answer_of<Give>(tested, msg::ScoutGiveRequest{9, true, "no path"}).message,
                    "view: found 9, expected 0 to 1"));

  Give given;
  tested.bridge.request(msg::ScoutGiveRequest{first.view, false, ""},
                        Answer<Give>([&](const Give& result) { given = result; }));
  tested.stand_at(std::size_t(first.view), 7);
  tested.give_image(7, std::size_t(first.view));
  tested.bridge.work(0);
  EXPECT_TRUE(given.success) << given.message;
  const State state = answer_of<State>(tested, msg::ScoutStateRequest{});
  EXPECT_EQ(state.images, 1);
  EXPECT_EQ(state.detections.header.frame_id, "world");

  const Propose second = answer_of<Propose>(tested, msg::ScoutProposeRequest{});
  if (!second.done) {
    EXPECT_NE(second.view, first.view);
    EXPECT_TRUE(
        answer_of<Give>(tested, msg::ScoutGiveRequest{second.view, true, "no path"}).success);
  }
  const Propose last = answer_of<Propose>(tested, msg::ScoutProposeRequest{});
  EXPECT_TRUE(last.done);
  EXPECT_NE(last.end, "");
  EXPECT_FALSE(answer_of<Propose>(tested, msg::ScoutProposeRequest{true}).done);
}

TEST(BridgeScout, AScoutTakesTheDepthOfItsImage) {
  BridgeOptions options = ArmBridge::options();
  options.depth = DepthSource::Aligned;
  ArmBridge tested(options);
  tested.give_info();
  const auto view =
      std::size_t(answer_of<msg::ScoutProposeResult>(tested, msg::ScoutProposeRequest{}).view);
  msg::ScoutGiveResult given;
  tested.bridge.request(msg::ScoutGiveRequest{std::int32_t(view), false, ""},
                        Answer<msg::ScoutGiveResult>([&](const auto& result) { given = result; }));
  tested.stand_at(view, 7);
  tested.give_image(7, view);
  tested.bridge.take_depth(depth_message(7, view));
  tested.bridge.work(0);
  EXPECT_TRUE(given.success) << given.message;
  const double entropy_nats =
      answer_of<msg::ScoutStateResult>(tested, msg::ScoutStateRequest{}).entropy_nats;

  SmallWorld& world = small_world();
  const auto by_library = [&](std::shared_ptr<const MeasuredDepth> depth) {
    Scout scout(world.sets, world.camera(), options.scout_views, options.scout, *world.backend);
    scout.give(int(view), Shot{world.image(view), options.scout_views[view], std::move(depth)});
    return scout.state().entropy_nats;
  };
  const auto measured = std::make_shared<const MeasuredDepth>(
      MeasuredDepth{depth_of(depth_message(7, view), {}, "depth"), {}});
  EXPECT_NEAR(entropy_nats, by_library(measured), 1e-6);
  EXPECT_GT(std::abs(entropy_nats - by_library(nullptr)), 1e-3);
}

}  // namespace

}  // namespace edgescout::ros2::test
