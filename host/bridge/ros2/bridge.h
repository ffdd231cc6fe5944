// Detection as a node of ROS 2, without a line of ROS or DDS: takes messages, gives messages.
//
// Any thread may call take(), request() and diagnostics(). One thread calls work(); results and
// answers come from there.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "host/bridge/ros2/bridge_options.h"
#include "host/bridge/ros2/camera_for_image.h"
#include "host/bridge/ros2/depth_for_image.h"
#include "host/bridge/ros2/diagnostics.h"
#include "host/bridge/ros2/inbox.h"
#include "host/bridge/ros2/object_search.h"
#include "host/bridge/ros2/outbox.h"
#include "host/bridge/ros2/scout_requests.h"
#include "host/bridge/ros2/tf_buffer.h"

namespace edgescout::ros2 {

template <typename Result>
using Answer = std::function<void(const Result&)>;

class Bridge {
 public:
  // `backend` and `outbox` must outlive this object.
  Bridge(TemplateSource templates, Backend& backend, BridgeOptions options, Outbox& outbox);

  void take(ImageMessage image);
  void take(const msg::CameraInfo& info);
  void take_depth(msg::Image depth);
  void take_depth(const msg::CameraInfo& info);  // of the depth camera
  void take(const msg::TFMessage& transforms, bool is_static);

  // Each is answered once, by work(), or at once where too many requests wait. An error is an
  // answer without success whose message says what was found and expected.
  void request(const msg::DetectRequest& request, const Answer<msg::DetectResult>& answer);
  void request(msg::GetPoseEstimatesRequest request,
               const Answer<msg::GetPoseEstimatesResult>& answer);
  void request(const msg::ScoutProposeRequest& request,
               const Answer<msg::ScoutProposeResult>& answer);
  void request(const msg::ScoutGiveRequest& request, const Answer<msg::ScoutGiveResult>& answer);
  void request(const msg::ScoutStateRequest& request, const Answer<msg::ScoutStateResult>& answer);

  // Waits so long for an image or a request and works on it. False: there was none. GpuError: the
  // device failed.
  bool work(double seconds);
  // Ends work(), also one in progress, soon.
  void stop();
  bool is_stopped() const { return inbox_.is_stopped(); }

  Diagnostics& diagnostics() { return diagnostics_; }

 private:
  struct Found {
    msg::Header header;  // of the poses
    std::vector<Detection> detections;
    Completion completion = Completion::Complete;
  };

  template <typename Result, typename Work>
  void add_job(const Answer<Result>& answer, const Work& work);
  // Whether there is a result.
  bool work_on(ArrivedImage arrived, std::vector<ImageRequest> requests);
  std::optional<Image> decoded(const ImageMessage& message);
  // Null, and counted: the image has none that can be used.
  std::shared_ptr<const MeasuredDepth> depth_for(const ArrivedImage& arrived, const Camera& camera);
  void warn_of_depth();  // of the image that was worked on last
  std::optional<Camera> camera_for(const msg::Header& header, int width, int height);
  void warn_of(const Camera& camera);
  void wait_for_calibration(ArrivedImage arrived, std::vector<ImageRequest> requests);
  // Detects and publishes. InputError: a pose that tf does not know, what the library refuses.
  Found detect(const TakenImage& image, double max_seconds);
  bool detect_without_request(const TakenImage& image);  // whether there is a result
  void publish(const Found& found, const msg::Header& image, std::span<const Detection> in_camera);
  msg::GetPoseEstimatesResult estimate(const msg::GetPoseEstimatesRequest& request);
  Se3 world_from_camera(const msg::Header& image) const;
  TimeLimit limit_of(double max_seconds) const;

  BridgeOptions options_;
  Outbox& outbox_;
  Diagnostics diagnostics_;
  Inbox inbox_;
  TfBuffer tf_;
  CameraForImage camera_;
  DepthForImage depth_;
  ObjectSearch search_;
  ScoutRequests scout_;
  std::optional<Camera> warned_of_;
};

}  // namespace edgescout::ros2
