#include "host/bridge/ros2/tf_buffer.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/bridge/small_world.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::ros2::test {

namespace {

using edgescout::test::expect_input_error;

Se3 pose(double x, double turn_rad) { return {so3_exp({0, 0, turn_rad}), {x, 0, 0.5}}; }

msg::Time at(double seconds) { return header_at(seconds).stamp; }

void add(TfBuffer& tf, const std::string& parent, const std::string& child, const Se3& pose,
         double seconds, bool is_static = false) {
  const auto refused = tf.add({{transform_message(parent, child, pose, seconds)}}, is_static);
  EXPECT_TRUE(refused.empty()) << refused.front();
}

void expect_same(const Se3& a, const Se3& b) {
  EXPECT_LT(distance_between_m(a, b), 1e-12);
  EXPECT_LT(angle_between_rad(a, b), 1e-7);
}

// world <- base <- arm (moves) <- camera (static); world <- table (static).
struct Arm {
  TfBuffer tf;
  Arm() {
    add(tf, "world", "base", pose(1, 0.3), 0, true);
    add(tf, "base", "arm", pose(0, 0), 10);
    add(tf, "base", "arm", pose(2, 1), 11);
    add(tf, "arm", "camera", pose(0.1, 0.2), 0, true);
    add(tf, "world", "table", pose(-1, 2), 0, true);
  }
};

TEST(TfBuffer, FollowsTheTreeBothWays) {
  const Arm arm;
  const Se3 world_from_camera = pose(1, 0.3) * pose(2, 1) * pose(0.1, 0.2);
  expect_same(arm.tf.lookup("world", "camera", at(11)), world_from_camera);
  expect_same(arm.tf.lookup("camera", "world", at(11)), inverse(world_from_camera));
  expect_same(arm.tf.lookup("table", "camera", at(11)), inverse(pose(-1, 2)) * world_from_camera);
  expect_same(arm.tf.lookup("/camera", "camera", at(3)), Se3{});
  expect_same(arm.tf.lookup("world", "table", at(99)), pose(-1, 2));  // static alone: any time
}

TEST(TfBuffer, InterpolatesInTime) {
  const Arm arm;
  expect_same(arm.tf.lookup("base", "arm", at(10.25)), pose(0.5, 0.25));
  expect_same(arm.tf.lookup("base", "arm", at(0)), pose(2, 1));  // the latest
}

TEST(TfBuffer, SaysWhatIsMissing) {
  Arm arm;
  expect_input_error([&] { (void)arm.tf.lookup("world", "gripper", at(10)); },
                     {"tf: frame: found gripper", "arm, base, camera, table, world"});
  expect_input_error([&] { (void)arm.tf.lookup("world", "camera", at(12)); },
                     {"12.000000000", "10.000000000 to 11.000000000"});
  expect_input_error([&] { (void)arm.tf.lookup("world", "camera", at(9)); }, {"9.000000000"});
  add(arm.tf, "map", "robot", {}, 1, true);
  expect_input_error([&] { (void)arm.tf.lookup("map", "camera", at(10)); }, {"not connected"});
  expect_input_error([&] { (void)TfBuffer().lookup("a", "b", at(1)); }, {"known one: none"});
}

TEST(TfBuffer, WaitsForATransform) {
  Arm arm;
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    add(arm.tf, "base", "arm", pose(4, 1), 12);
  });
  expect_same(arm.tf.lookup("base", "arm", at(11.5), 30), pose(3, 1));
  later.join();
  EXPECT_THROW((void)arm.tf.lookup("base", "arm", at(13), 0.01), InputError);
}

TEST(TfBuffer, ForgetsAndFollowsAClockThatIsSetBack) {
  Arm arm;
  add(arm.tf, "base", "arm", pose(5, 0), 30);
  EXPECT_THROW((void)arm.tf.lookup("base", "arm", at(11)), InputError);  // 19 s before the latest
  add(arm.tf, "base", "arm", pose(7, 0), 2);
  add(arm.tf, "base", "arm", pose(9, 0), 3);
  expect_same(arm.tf.lookup("base", "arm", at(2.5)), pose(8, 0));
}

TEST(TfBuffer, AFrameMayGetAnotherParent) {
  Arm arm;
  add(arm.tf, "table", "camera", pose(3, 0), 12);
  expect_same(arm.tf.lookup("table", "camera", at(12)), pose(3, 0));
}

TEST(TfBuffer, RefusesWhatIsNoTransform) {
  TfBuffer tf;
  const auto refused = [&tf](const msg::TransformStamped& transform) {
    const auto lines = tf.add({{transform}}, false);
    return lines.empty() ? "" : lines.front();
  };
  EXPECT_NE(refused(transform_message("", "b", {}, 1)).find("without a name"), std::string::npos);
  EXPECT_NE(refused(transform_message("a", "/a", {}, 1)).find("one frame twice"),
            std::string::npos);
  msg::TransformStamped bad = transform_message("a", "b", {}, 1);
  bad.transform.rotation = {0, 0, 0, 0};
  EXPECT_NE(refused(bad), "");
  bad = transform_message("a", "b", {}, 1);
  bad.transform.translation.x = NAN;
  EXPECT_NE(refused(bad), "");
  EXPECT_EQ(tf.known_frames(), "none");
  // A circle is found at the lookup.
  EXPECT_EQ(refused(transform_message("a", "b", {}, 1)), "");
  EXPECT_EQ(refused(transform_message("b", "a", {}, 1)), "");
  add(tf, "world", "table", {}, 1, true);
  expect_input_error([&] { (void)tf.lookup("world", "a", at(1)); }, {"circle"});
}

}  // namespace

}  // namespace edgescout::ros2::test
