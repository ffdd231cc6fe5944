#include "host/bridge/ros2/bridge.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/bridge/tested_bridge.h"
#include "tests/io/collected_log.h"

namespace edgescout::ros2::test {

namespace {

TEST(Bridge, DetectsWhatTheLibraryDetects) {
  SmallWorld& world = small_world();
  TestedBridge tested;
  tested.give_info();
  tested.give_image(12.5);
  EXPECT_TRUE(tested.bridge.work(0));
  const PipelineOptions options = SmallWorld::pipeline();
  const ObjectView view = prepare_view(world.image(), world.camera(), {}, *world.backend, options);
  const Detections found = detect_objects(view, world.sets, *world.backend, options);
  ASSERT_EQ(tested.results.detections.size(), 1u);
  const msg::Detection3DArray& message = tested.results.detections[0];
  EXPECT_EQ(message.header.stamp, header_at(12.5).stamp);
  EXPECT_EQ(message.header.frame_id, "camera");
  ASSERT_EQ(message.detections.size(), found.detections.size());
  ASSERT_FALSE(found.detections.empty());
  for (std::size_t i = 0; i < found.detections.size(); ++i) {
    const Detection& expected = found.detections[i];
    const msg::Detection3D& detection = message.detections[i];
    ASSERT_EQ(detection.results.size(), 1 + expected.alternatives.size());
    EXPECT_EQ(detection.results[0].hypothesis.class_id, "obj_000001");
    EXPECT_EQ(detection.results[0].hypothesis.score, expected.probability);
    EXPECT_EQ(detection.results[0].pose.pose.position.x,
              expected.world_from_object.translation_m.x());
    EXPECT_EQ(detection.results[0].pose.pose.orientation.w,
              expected.world_from_object.rotation.w());
    EXPECT_EQ(detection.results[0].pose.covariance[7], expected.covariance(1, 1));
    EXPECT_EQ(detection.results[0].pose.covariance[4], expected.covariance(0, 4));
    EXPECT_EQ(detection.id, "obj_000001_" + std::to_string(i));
    const Mesh& mesh = world.sets[0].model.mesh;
    EXPECT_EQ(detection.bbox.size.z, mesh.box_max_m.z() - mesh.box_min_m.z());
  }
  EXPECT_TRUE(tested.results.markers.empty());  // nobody listens
  EXPECT_TRUE(tested.results.frames.empty());
}

TEST(Bridge, TheNewestImageWins) {
  TestedBridge tested;
  tested.give_info();
  for (double seconds : {1.0, 2.0, 3.0}) tested.give_image(seconds);
  EXPECT_TRUE(tested.bridge.work(0));
  EXPECT_FALSE(tested.bridge.work(0));
  ASSERT_EQ(tested.results.detections.size(), 1u);
  EXPECT_EQ(tested.results.detections[0].header.stamp, header_at(3).stamp);
  EXPECT_EQ(tested.count("images received"), 3u);
  EXPECT_EQ(tested.count("images dropped: a newer one came"), 2u);
  EXPECT_EQ(tested.count("images worked on"), 1u);
}

TEST(Bridge, ImagesWaitForTheirCamera) {
  const edgescout::test::CollectedLog log;
  TestedBridge tested;
  tested.give_image(1);
  tested.give_image(2);
  EXPECT_FALSE(tested.bridge.work(0));
  EXPECT_TRUE(holds(tested.problem("camera_info"), "found no message"));
  msg::CameraInfo info = info_message(small_world().camera());
  info.k = {};
  tested.bridge.take(info);
  tested.bridge.work(0);
  EXPECT_TRUE(holds(tested.problem("camera_info"), "uncalibrated"));
  EXPECT_FALSE(tested.bridge.work(0));  // until the next calibration
  info = info_message(small_world().camera());
  info.width = 640;
  tested.bridge.take(info);
  tested.bridge.work(0);
  EXPECT_TRUE(holds(tested.problem("camera_info"), "found 320x240, expected the calibration's"));
  EXPECT_TRUE(tested.results.detections.empty());
  tested.give_info(3);
  EXPECT_TRUE(tested.bridge.work(0));
  ASSERT_EQ(tested.results.detections.size(), 1u);
  EXPECT_EQ(tested.results.detections[0].header.stamp, header_at(2).stamp);
  EXPECT_EQ(tested.problem("camera_info"), "");
  EXPECT_EQ(log.messages.size(), 1u);  // of this subject, in ten seconds
}

TEST(Bridge, ImagesWithoutACameraAreDroppedIfAsked) {
  BridgeOptions options = quick();
  options.without_camera = WithoutCamera::Drop;
  TestedBridge tested(options);
  tested.give_image(1);
  tested.give_info();
  EXPECT_FALSE(tested.bridge.work(0));
  msg::CameraInfo info = info_message(small_world().camera());
  info.k = {};
  tested.bridge.take(info);
  tested.give_image(2);
  tested.bridge.work(0);
  tested.give_info();
  EXPECT_FALSE(tested.bridge.work(0));
  EXPECT_EQ(tested.count("images dropped: no camera"), 2u);
}

TEST(Bridge, ACameraOfAFileNeedsNoMessage) {
  BridgeOptions options = quick();
  options.camera = small_world().camera();
  TestedBridge tested(options);
  tested.give_image();
  EXPECT_TRUE(tested.bridge.work(0));
  EXPECT_EQ(tested.results.detections.size(), 1u);
}

TEST(Bridge, BadImagesAreSaidAndLeftOut) {
  TestedBridge tested;
  tested.give_info();
  msg::Image image = image_message(small_world().image());
  image.data.resize(100);
  tested.bridge.take(ImageMessage(image));
  EXPECT_TRUE(tested.bridge.work(0));
  EXPECT_TRUE(holds(tested.problem("image"), "image: data: found 100 bytes"));
  const msg::DiagnosticArray said = tested.bridge.diagnostics().message({});
  EXPECT_EQ(said.status.at(0).level, 1);
  EXPECT_TRUE(holds(said.status.at(0).message, "100 bytes"));
  EXPECT_EQ(tested.count("images refused"), 1u);
  tested.give_image();
  tested.bridge.work(0);
  EXPECT_EQ(tested.bridge.diagnostics().message({}).status.at(0).message, "ok");
}

TEST(Bridge, TheFirstImageIsSaidWhileItIsWorkedOn) {
  TestedBridge tested;
  EXPECT_TRUE(holds(tested.status().message, "no result yet: no image came for 0 s"));
  std::string said;
  tested.while_working = [&] { said = tested.status().message; };
  tested.give_info();
  tested.give_image();
  EXPECT_TRUE(tested.bridge.work(0));
  EXPECT_EQ(said, "no result yet: first image is being worked on (0 s)");
  EXPECT_EQ(tested.status().message, "ok");
}

TEST(Bridge, AnImageWithoutAResultIsNone) {
  BridgeOptions options = quick();
  options.world_frame = "world";
  TestedBridge tested(options);
  tested.give_info();
  tested.give_image();
  EXPECT_TRUE(tested.bridge.work(0));
  tested.bridge.diagnostics().solved("tf");
  EXPECT_TRUE(holds(tested.status().message, "no result yet")) << tested.status().message;
}

TEST(Bridge, PosesMayBeInTheWorld) {
  ArmBridge tested;
  tested.give_info();
  tested.give_image(1);
  tested.bridge.work(0);
  EXPECT_TRUE(tested.results.detections.empty());
  EXPECT_TRUE(holds(tested.problem("tf"), "found world, expected a known one: none"));
  tested.stand_at(0, 5);
  tested.give_image(5);
  tested.bridge.work(0);
  EXPECT_EQ(tested.problem("tf"), "");
  ASSERT_EQ(tested.results.detections.size(), 1u);
  const msg::Detection3DArray& found = tested.results.detections[0];
  EXPECT_EQ(found.header.frame_id, "world");
  ASSERT_FALSE(found.detections.empty());
  TestedBridge in_camera;
  in_camera.give_info();
  in_camera.give_image(5);
  in_camera.bridge.work(0);
  const msg::PoseWithCovariance& seen =
      in_camera.results.detections.at(0).detections.at(0).results[0].pose;
  const msg::PoseWithCovariance& placed = found.detections[0].results[0].pose;
  const Se3 world_from_camera = inverse(small_world().camera_from_world());
  expect_same_pose(placed.pose, world_from_camera * pose_of(seen.pose, ""), 1e-9);
  const auto turning = [](const msg::PoseWithCovariance& pose) {
    return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(pose.covariance.data())
        .bottomRightCorner<3, 3>();
  };
  const Eigen::Matrix3d turn = world_from_camera.rotation.toRotationMatrix();
  EXPECT_LT((turning(placed) - turn * turning(seen) * turn.transpose()).norm(),
            1e-9 * turning(seen).norm());
  // Meshes, frames and the overlay of the same.
  ASSERT_EQ(tested.results.markers.size(), 1u);
  const std::vector<msg::Marker>& markers = tested.results.markers[0].markers;
  ASSERT_EQ(markers.size(), 1 + found.detections.size());
  EXPECT_EQ(markers[0].action, 3);  // the former ones go
  EXPECT_EQ(markers[1].type, 11);
  EXPECT_EQ(markers[1].points.size(), 3 * small_world().sets[0].model.mesh.triangles.size());
  EXPECT_EQ(markers[1].header.frame_id, "world");
  ASSERT_EQ(tested.results.frames.size(), 1u);
  EXPECT_EQ(tested.results.frames[0].transforms[0].child_frame_id, "obj_000001_0");
  ASSERT_EQ(tested.results.overlays.size(), 1u);
  EXPECT_EQ(tested.results.overlays[0].encoding, "rgb8");
  EXPECT_EQ(tested.results.overlays[0].header.frame_id, "camera");
  EXPECT_EQ(tested.results.overlays[0].data.size(), 3u * 320 * 240);
}

TEST(Bridge, StopsWhileTemplatesAreMade) {
  const edgescout::test::CollectedLog log;
  TestedBridge tested;
  bool were_cancelled = true;
  tested.while_working = [&] {
    were_cancelled = tested.are_cancelled();
    tested.bridge.stop();
    if (tested.are_cancelled()) throw Cancelled();
  };
  tested.give_info();
  tested.give_image();
  tested.bridge.work(0);
  EXPECT_FALSE(were_cancelled);
  EXPECT_TRUE(tested.results.detections.empty());
  EXPECT_EQ(tested.count("images without a result"), 0u);
  EXPECT_TRUE(log.messages.empty());
}

TEST(Bridge, StopsWhileItWaitsForTf) {
  BridgeOptions options = quick();
  options.world_frame = "world";
  options.tf_seconds = 3600;
  TestedBridge tested(options);
  tested.give_info();
  tested.give_image();
  std::thread stopping([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    tested.bridge.stop();
  });
  tested.bridge.work(0);
  stopping.join();
  EXPECT_TRUE(tested.results.detections.empty());
}

TEST(Bridge, StopsWorkInProgress) {
  TestedBridge tested;
  tested.give_info();
  tested.give_image();
  tested.bridge.stop();
  EXPECT_FALSE(tested.bridge.work(60));
}

}  // namespace

}  // namespace edgescout::ros2::test
