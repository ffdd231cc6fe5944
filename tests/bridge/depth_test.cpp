#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <thread>

#include "host/bridge/ros2/depth_message.h"
#include "host/io/depth_file.h"
#include "tests/bridge/tested_bridge.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::ros2::test {

namespace {

using edgescout::test::expect_input_error;

constexpr char alone[] = "images worked on without depth", with[] = "images worked on with depth",
               newer[] = "images dropped: a newer one came";

BridgeOptions with_depth(DepthSource source = DepthSource::Aligned) {
  BridgeOptions options = quick();
  options.depth = source;
  options.depth_wait.seconds = 30;
  options.max_seconds = 1e-6;  // what is found is not looked at
  return options;
}

// The depth image of SmallWorld as the library has it.
DepthImage expected_depth() {
  std::vector<std::uint16_t> mm(320 * 240);
  std::memcpy(mm.data(), depth_message().data.data(), 2 * mm.size());
  return depth_image(mm, 320, 240);
}

Detections found_with(const std::shared_ptr<const MeasuredDepth>& depth) {
  SmallWorld& world = small_world();
  ObjectView view =
      prepare_view(world.image(), world.camera(), {}, *world.backend, quick().pipeline);
  view.depth = depth;
  return detect_objects(view, world.sets, *world.backend, quick().pipeline);
}

void expect_published(const TestedBridge& tested, const Detections& expected) {
  ASSERT_EQ(tested.results.detections.size(), 1u);
  const std::vector<msg::Detection3D>& found = tested.results.detections[0].detections;
  ASSERT_EQ(found.size(), expected.detections.size());
  ASSERT_FALSE(found.empty());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const msg::ObjectHypothesisWithPose& best = found[i].results.at(0);
    EXPECT_EQ(best.hypothesis.score, expected.detections[i].probability);
    EXPECT_EQ(best.pose.pose.position.z,
              expected.detections[i].world_from_object.translation_m.z());
  }
}

TEST(BridgeDepth, DetectsWhatTheLibraryDetectsWithDepth) {
  BridgeOptions options = with_depth();
  options.max_seconds = 0;
  TestedBridge tested(options);
  tested.give_info();
  tested.bridge.take_depth(depth_message());
  tested.give_image();
  EXPECT_TRUE(tested.bridge.work(0));
  expect_published(
      tested, found_with(std::make_shared<MeasuredDepth>(MeasuredDepth{expected_depth(), {}})));
  EXPECT_EQ(tested.count(with), 1u);
  EXPECT_EQ(tested.problem("depth"), "");
}

// Rows with padding, real numbers, and the bytes of another machine: the same image.
TEST(BridgeDepth, FormsOfMessagesAreReadAlike) {
  const DepthImage expected = expected_depth();
  msg::Image big = depth_message();
  big.is_bigendian = 1;
  for (std::size_t i = 0; i < big.data.size(); i += 2) std::swap(big.data[i], big.data[i + 1]);
  EXPECT_EQ(depth_of(big, {}, "depth").z_m, expected.z_m);
  msg::Image real = depth_message();
  real.encoding = "32FC1";
  real.step = 4 * 320 + 12;
  real.data.assign(std::size_t(real.step) * 240, 0xff);  // NaN between the rows
  for (std::size_t i = 0; i < expected.z_m.size(); ++i) {
    const float z_m = i % 5 == 0 ? NAN : expected.z_m[i];
    std::memcpy(&real.data[i / 320 * real.step + i % 320 * 4], &z_m, 4);
  }
  const DepthImage read = depth_of(real, {}, "depth");
  for (std::size_t i = 0; i < expected.z_m.size(); ++i)
    ASSERT_EQ(read.z_m[i], i % 5 == 0 ? DEPTH_MISSING : expected.z_m[i]);
}

TEST(BridgeDepth, RefusesOtherMessages) {
  const auto refused = [](const auto& change, std::initializer_list<std::string> words) {
    msg::Image message = depth_message();
    change(message);
    expect_input_error([&] { require_depth(message, "depth"); }, words);
  };
  using Image = msg::Image;
  refused([](Image& m) { m.encoding = "rgb8"; }, {"depth: encoding: found rgb8", "16UC1", "32FC1"});
  refused([](Image& m) { m.encoding = "\n"; }, {"depth: encoding: found ?"});
  refused([](Image& m) { m.encoding = "8UC1"; }, {"encoding"});
  refused([](Image& m) { m.encoding = "32FC1"; }, {"depth: step: found 640", "1280"});
  refused([](Image& m) { m.data.pop_back(); }, {"depth: data: found 153599 bytes", "153600"});
  refused([](Image& m) { m.height = 0xffffffff; }, {"depth: data"});
  refused([](Image& m) { m.header.stamp = {}; }, {"depth: stamp: found 0"});
  msg::Image message = depth_message();
  message.width = message.height = message.step = 0;
  message.data.clear();
  expect_input_error([&] { depth_of(message, {}, "depth"); }, {"depth: pixels: found"});
}

TEST(BridgeDepth, AnImageWaitsForItsDepth) {
  TestedBridge tested(with_depth());
  tested.give_info();
  tested.give_image(1);
  EXPECT_FALSE(tested.bridge.work(0));
  tested.bridge.take_depth(depth_message(2));  // of another time
  EXPECT_FALSE(tested.bridge.work(0));
  tested.bridge.take_depth(depth_message(1));  // late and out of order
  EXPECT_TRUE(tested.bridge.work(0));
  EXPECT_EQ(tested.count(with), 1u);
  tested.give_image(2);  // its depth came before
  EXPECT_TRUE(tested.bridge.work(0));
  EXPECT_EQ(tested.count(with), 2u);
  EXPECT_EQ(tested.count(alone), 0u);
}

TEST(BridgeDepth, WithoutDepthInTimeAnImageIsWorkedOnAlone) {
  const edgescout::test::CollectedLog log;
  BridgeOptions options = with_depth();
  options.depth_wait.seconds = 0.05;
  options.max_seconds = 0;
  TestedBridge tested(options);
  tested.give_info();
  tested.give_image(1);
  EXPECT_FALSE(tested.bridge.work(0));
  EXPECT_TRUE(tested.bridge.work(10));  // ends when the image has waited
  expect_published(tested, found_with(nullptr));
  EXPECT_EQ(tested.count(alone), 1u);
  EXPECT_TRUE(holds(tested.problem("depth"), "found none, expected one of its stamp"));
  tested.bridge.take_depth(depth_message(1));  // too late
  EXPECT_FALSE(tested.bridge.work(0));
  EXPECT_EQ(log.messages.size(), 1u);
}

// Depth comes later than images do: the newest image that has its depth is worked on, and newer
// ones go on waiting.
TEST(BridgeDepth, NewerImagesDoNotPushOutThoseThatWait) {
  TestedBridge tested(with_depth());
  tested.give_info();
  for (const double seconds : {1, 2, 3}) tested.give_image(seconds);
  tested.bridge.take_depth(depth_message(2));
  EXPECT_TRUE(tested.bridge.work(0));
  EXPECT_EQ(tested.results.detections.at(0).header.stamp, header_at(2).stamp);
  EXPECT_EQ(tested.count(newer), 1u);
  tested.bridge.take_depth(depth_message(1));  // of an image that is gone
  EXPECT_FALSE(tested.bridge.work(0));
  tested.bridge.take_depth(depth_message(3));
  EXPECT_TRUE(tested.bridge.work(0));
  EXPECT_EQ(tested.results.detections.at(1).header.stamp, header_at(3).stamp);
}

TEST(BridgeDepth, KeepsEightImagesAndEightDepthImages) {
  TestedBridge tested(with_depth());
  tested.give_info();
  for (int i = 1; i <= 20; ++i) tested.give_image(i);
  EXPECT_EQ(tested.count(newer), 12u);
  for (int i = 1; i <= 20; ++i) tested.bridge.take_depth(depth_message(100 + i));
  DepthMatches matches(0);
  for (int i = 1; i <= 20; ++i)
    matches.add(std::make_shared<const msg::Image>(msg::Image{.header = header_at(i)}));
  EXPECT_FALSE(matches.of(header_at(12)));
  EXPECT_TRUE(matches.of(header_at(13)));
}

// So many images come that eight are newer before the first has waited for its depth.
TEST(BridgeDepth, FastImagesWithoutDepthAreWorkedOn) {
  BridgeOptions options = with_depth();
  options.depth_wait.seconds = 0.05;
  TestedBridge tested(options);
  tested.give_info();
  bool worked = false;
  const Clock::time_point end = Clock::now() + std::chrono::seconds(5);
  for (double seconds = 1; !worked && Clock::now() < end; seconds += 0.001) {
    tested.give_image(seconds);
    worked = tested.bridge.work(0);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_TRUE(worked);
}

// The worker is busy for longer than depth images are kept.
TEST(BridgeDepth, AnImageKeepsTheDepthThatCameInTime) {
  TestedBridge tested(with_depth());
  tested.give_info();
  tested.give_image(1);
  tested.bridge.take_depth(depth_message(1));
  for (int i = 1; i <= 20; ++i) tested.bridge.take_depth(depth_message(1 + i));
  EXPECT_TRUE(tested.bridge.work(0));
  EXPECT_EQ(tested.count(with), 1u);
  EXPECT_EQ(tested.count(alone), 0u);
}

TEST(BridgeDepth, MatchesStampsWithinTheTolerance) {
  DepthMatches matches(0.01);
  for (const double seconds : {5.008, 4.996, 1.0})
    matches.add(std::make_shared<const msg::Image>(msg::Image{.header = header_at(seconds)}));
  EXPECT_EQ(matches.of(header_at(5))->header.stamp, header_at(4.996).stamp);
  EXPECT_EQ(matches.of(header_at(5.007))->header.stamp, header_at(5.008).stamp);
  EXPECT_FALSE(matches.of(header_at(4.98)));
  EXPECT_FALSE(matches.of(header_at(0)));
}

// Two stamps of 0 are no match.
TEST(BridgeDepth, ImagesWithoutAStampHaveNone) {
  TestedBridge tested(with_depth());
  tested.give_info();
  tested.bridge.take_depth(depth_message(0));
  EXPECT_EQ(tested.count("depth images refused"), 1u);
  EXPECT_TRUE(holds(tested.problem("depth message"), "depth: stamp: found 0"));
  tested.give_image(0);
  EXPECT_TRUE(tested.bridge.work(0));
  EXPECT_EQ(tested.count(alone), 1u);
  EXPECT_TRUE(holds(tested.problem("depth"), "expected an image with a stamp"));
}

// Each is said, and the image is worked on alone.
TEST(BridgeDepth, UnusableDepthIsSaid) {
  TestedBridge tested(with_depth());
  tested.give_info();
  double seconds = 0;
  const auto said = [&](msg::Image depth) {
    depth.header = header_at(++seconds);
    tested.give_image(seconds);
    tested.bridge.take_depth(depth);
    EXPECT_TRUE(tested.bridge.work(0));
    return tested.problem("depth");
  };
  msg::Image half = depth_message();
  half.height /= 2;
  half.data.resize(half.data.size() / 2);
  EXPECT_TRUE(holds(said(half), "depth: size: found 320x120, expected 320x240"));
  msg::Image metres = depth_message();
  for (std::size_t i = 0; i < metres.data.size(); i += 2)
    metres.data[i] = 1, metres.data[i + 1] = 0;
  const std::string range = said(metres);
  EXPECT_TRUE(range.starts_with("depth: values: found around 1, which are 0.001 m")) << range;
  EXPECT_TRUE(holds(range, "(depth_unit, depth_range)")) << range;
  msg::Image none = depth_message();
  std::ranges::fill(none.data, std::uint8_t(0));
  EXPECT_EQ(said(none), "");  // an image in which nothing was measured is one
  EXPECT_EQ(tested.count(alone), 2u);
  EXPECT_EQ(tested.count(with), 1u);
}

// A sensor of 0.1 mm whose values are taken for mm: inside the range, and no part is there.
TEST(BridgeDepth, AnotherUnitIsSaidOnce) {
  const edgescout::test::CollectedLog log;
  TestedBridge tested(with_depth());
  tested.give_info();
  const auto said = [&](double seconds, int factor) {
    msg::Image depth = depth_message(seconds);
    for (std::size_t i = 0; i < depth.data.size(); i += 2) {
      const int value = factor * (depth.data[i] + 256 * depth.data[i + 1]) + int(seconds);
      depth.data[i] = std::uint8_t(value & 0xff), depth.data[i + 1] = std::uint8_t(value >> 8);
    }
    tested.give_image(seconds);
    tested.bridge.take_depth(depth);
    EXPECT_TRUE(tested.bridge.work(0));
    return tested.problem("depth unit");
  };
  EXPECT_EQ(said(1, 1), "");
  const std::string first = said(2, 10);
  EXPECT_TRUE(first.starts_with("depth has a median of")) << first;
  EXPECT_TRUE(holds(first, "0.1 times the unit would fit; is it of another unit (depth_unit)?"))
      << first;
  EXPECT_EQ(tested.status().level, 1);
  EXPECT_EQ(tested.status().message, first);
  EXPECT_EQ(said(30, 10), first);  // though the median is another
  EXPECT_EQ(log.messages.size(), 1u);
  EXPECT_EQ(said(31, 1), "");
  EXPECT_EQ(tested.status().message, "ok");
}

TEST(BridgeDepth, TakesADepthCameraOfItsOwn) {
  const Se3 aside{Eigen::Quaterniond::Identity(), {0.02, 0, 0}};
  BridgeOptions options = with_depth(DepthSource::OwnCamera);
  TestedBridge tested(options);
  tested.give_info();
  double seconds = 0;
  const auto said = [&] {
    msg::Image depth = depth_message(++seconds);
    depth.header.frame_id = "depth";
    tested.give_image(seconds);
    tested.bridge.take_depth(depth);
    EXPECT_TRUE(tested.bridge.work(0));
    return tested.problem("depth");
  };
  EXPECT_TRUE(holds(said(), "depth camera_info: messages: found none"));
  msg::CameraInfo info = info_message(small_world().camera());
  info.width = 640;
  tested.bridge.take_depth(info);
  EXPECT_TRUE(holds(said(), "depth camera_info: image size: found 320x240"));
  tested.bridge.take_depth(info_message(small_world().camera(), 3));
  EXPECT_TRUE(holds(said(), "tf: frame: found"));
  tested.bridge.take({{transform_message("camera", "depth", aside, 0)}}, true);
  EXPECT_EQ(said(), "");
  EXPECT_EQ(tested.count(with), 1u);

  TfBuffer tf;
  tf.add({{transform_message("camera", "depth", aside, 0)}}, true);
  DepthForImage depth(options, tf);
  const Camera camera = small_world().camera();
  depth.add(info_message(camera));
  msg::Image message = depth_message();
  message.header.frame_id = "depth";
  const DepthCamera beside{camera, aside};
  ThreadPool& pool = small_world().backend->threads();
  EXPECT_EQ(depth.of_topic(message, header_at(1), camera, pool)->image.z_m,
            register_depth(expected_depth(), beside, camera, pool).z_m);
}

TEST(BridgeDepth, RequestsUseIt) {
  BridgeOptions options = with_depth();
  options.on_request = true;
  TestedBridge tested(options);
  tested.give_info();
  msg::DetectResult answer;
  tested.bridge.request(msg::DetectRequest{}, [&](const msg::DetectResult& r) { answer = r; });
  tested.give_image(1);
  EXPECT_FALSE(tested.bridge.work(0));
  tested.bridge.take_depth(depth_message(1));
  EXPECT_TRUE(tested.bridge.work(0));
  EXPECT_TRUE(answer.success) << answer.message;
  EXPECT_EQ(tested.count(with), 1u);

  msg::GetPoseEstimatesResult poses;
  const auto ask = [&](const msg::Image& depth) {
    msg::CalibratedImage given = calibrated(0);
    given.depth = depth;
    tested.bridge.request(msg::GetPoseEstimatesRequest{{1}, {given}},
                          [&](const msg::GetPoseEstimatesResult& r) { poses = r; });
    EXPECT_TRUE(tested.bridge.work(0));
  };
  ask(depth_message(0));  // its stamp is that of the request
  EXPECT_TRUE(poses.success) << poses.message;
  msg::Image half = depth_message();
  half.height /= 2;
  half.data.resize(half.data.size() / 2);
  ask(half);
  EXPECT_TRUE(holds(poses.message, "cameras[0].depth: size: found 320x120")) << poses.message;
}

}  // namespace

}  // namespace edgescout::ros2::test
