// How the bridge answers requests: with the next image, or as a job of their own.
#include "host/bridge/ros2/bridge.h"
#include "host/bridge/ros2/frames.h"
#include "host/bridge/ros2/guarded.h"
#include "host/io/one_line.h"

namespace edgescout::ros2 {

namespace {

constexpr char too_many[] = "request: found too many that wait, expected fewer";

template <typename Result>
Result failure(const std::string& why) {
  Result result;
  result.success = false;
  result.message = one_line(why);
  return result;
}

}  // namespace

template <typename Result, typename Work>
void Bridge::add_job(const Answer<Result>& answer, const Work& work) {
  const bool is_taken = inbox_.put([answer, work] {
    guarded([&] { answer(work()); }, [&](const std::string& why) { answer(failure<Result>(why)); });
  });
  if (!is_taken) answer(failure<Result>(too_many));
}

void Bridge::request(const msg::DetectRequest& request, const Answer<msg::DetectResult>& answer) {
  const auto fail = [answer](const std::string& why) { answer(failure<msg::DetectResult>(why)); };
  const double max_seconds = request.max_seconds > 0 ? request.max_seconds : options_.max_seconds;
  const auto on_image = [this, answer, fail, max_seconds](const TakenImage& image) {
    guarded(
        [&] {
          const Found found = detect(image, max_seconds);
          answer({true, found.completion == Completion::Complete ? "" : to_string(found.completion),
                  detections_message(found.header, found.detections, search_.objects())});
        },
        fail);
  };
  if (!inbox_.put({on_image, fail, {}, 0}, options_.request_seconds)) fail(too_many);
}

void Bridge::request(msg::GetPoseEstimatesRequest request,
                     const Answer<msg::GetPoseEstimatesResult>& answer) {
  add_job(answer, [this, request = std::move(request)] { return estimate(request); });
}

void Bridge::request(const msg::ScoutProposeRequest& request,
                     const Answer<msg::ScoutProposeResult>& answer) {
  add_job(answer, [this, request] { return scout_.propose(request, camera_.calibration({})); });
}

void Bridge::request(const msg::ScoutGiveRequest& request,
                     const Answer<msg::ScoutGiveResult>& answer) {
  if (request.failed) return add_job(answer, [this, request] { return scout_.fail(request); });
  const auto fail = [answer](const std::string& why) {
    answer(failure<msg::ScoutGiveResult>(why));
  };
  const auto on_image = [this, answer, fail, request](const TakenImage& image) {
    guarded([&] { answer(scout_.give(request, image, inverse(world_from_camera(image.header)))); },
            fail);
  };
  if (!inbox_.put({on_image, fail, {}, 0}, options_.request_seconds)) fail(too_many);
}

void Bridge::request(const msg::ScoutStateRequest&, const Answer<msg::ScoutStateResult>& answer) {
  add_job(answer, [this] { return scout_.state(); });
}

msg::GetPoseEstimatesResult Bridge::estimate(const msg::GetPoseEstimatesRequest& request) {
  std::vector<CameraView> views;
  for (std::size_t i = 0; i < request.cameras.size(); ++i) {
    const msg::CalibratedImage& given = request.cameras[i];
    const std::string source = "cameras[" + std::to_string(i) + "]";
    Image image = image_of(ImageMessage(given.image), source, options_.images);
    const Camera camera = camera_.of_request(given.info, image.width, image.height, source);
    views.push_back({std::move(image), camera, inverse(pose_of(given.pose, source)),
                     depth_.of_request(given.depth, camera, source + ".depth")});
  }
  const Detections found =
      search_.in_views(views, request.object_ids, limit_of(options_.max_seconds));
  msg::GetPoseEstimatesResult result{true, "", {}};
  if (found.completion != Completion::Complete) result.message = to_string(found.completion);
  for (const Detection& detection : found.detections)
    result.pose_estimates.push_back(
        {std::uint64_t(search_.objects().sets[std::size_t(detection.object)].object_id),
         detection.probability, message_of(detection.world_from_object)});
  return result;
}

}  // namespace edgescout::ros2
