#include "host/bridge/ros2/bridge.h"

#include <algorithm>

#include "host/bridge/ros2/depth_message.h"
#include "host/bridge/ros2/frames.h"
#include "host/bridge/ros2/guarded.h"
#include "host/core/camera_check.h"
#include "host/core/option_names.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

constexpr char info_subject[] = "camera_info", image_subject[] = "image", tf_subject[] = "tf",
               search_subject[] = "detection", depth_subject[] = "depth",
               depth_message_subject[] = "depth message";

std::string subject_of(DepthFault fault) {
  constexpr const char* subjects[] = {"depth unit", "depth pose", "depth of another image"};
  return subjects[int(fault)];
}

std::string question_of(DepthFault fault) {
  switch (fault) {
    case DepthFault::Unit:
      return "is it of another unit (" + option_name("depth-unit") + ")?";
    case DepthFault::Moved:
      return "is it not aligned, or the pose of its camera in tf wrong?";
    case DepthFault::OtherImage:
      return "is it that of another image?";
  }
  throw LogicError("question_of: unknown fault");
}

constexpr char dropped_for_newer[] = "images dropped: a newer one came";

std::optional<DepthWait> depth_wait(const BridgeOptions& options) {
  return options.depth == DepthSource::None ? std::nullopt : std::optional(options.depth_wait);
}

ScoutOptions cancellable(ScoutOptions options, const Inbox& inbox) {
  options.cancelled = [&inbox] { return inbox.is_stopped(); };
  return options;
}

}  // namespace

Bridge::Bridge(TemplateSource templates, Backend& backend, BridgeOptions options, Outbox& outbox)
    : options_(std::move(options)),
      outbox_(outbox),
      diagnostics_(options_.node, options_.on_request),
      inbox_(!options_.on_request, depth_wait(options_)),
      camera_(options_),
      depth_(options_, tf_),
      search_(std::move(templates), backend, options_.pipeline),
      scout_(search_, cancellable(options_.scout, inbox_), options_.scout_views,
             options_.world_frame) {
  if (options_.camera) inbox_.put_calibration();
}

void Bridge::take(ImageMessage image) {
  diagnostics_.count("images received");
  diagnostics_.image_comes();
  if (inbox_.calibrations() == 0) {
    diagnostics_.problem(info_subject, "camera_info: found no message, expected one of the camera");
    if (options_.without_camera == WithoutCamera::Drop) {
      diagnostics_.count("images dropped: no camera");
      return;
    }
  }
  if (const std::size_t dropped = inbox_.put(std::move(image)))
    diagnostics_.count(dropped_for_newer, dropped);
}

void Bridge::take_depth(msg::Image depth) {
  diagnostics_.count("depth images received");
  guarded(
      [&] {
        require_depth(depth, depth_subject);
        diagnostics_.solved(depth_message_subject);
        inbox_.put(std::make_shared<const msg::Image>(std::move(depth)));
      },
      [&](const std::string& why) {
        diagnostics_.count("depth images refused");
        diagnostics_.problem(depth_message_subject, why);
      });
}

void Bridge::take_depth(const msg::CameraInfo& info) { depth_.add(info); }

void Bridge::take(const msg::CameraInfo& info) {
  diagnostics_.count("camera infos received");
  if (options_.camera) return;
  camera_.add(info);
  inbox_.put_calibration();
}

void Bridge::take(const msg::TFMessage& transforms, bool is_static) {
  const std::vector<std::string> refused = tf_.add(transforms, is_static);
  if (refused.empty()) return;
  diagnostics_.count("transforms refused", refused.size());
  diagnostics_.problem("tf message", refused.front());
}

void Bridge::stop() {
  inbox_.stop();
  tf_.stop_waiting();
}

TimeLimit Bridge::limit_of(double max_seconds) const {
  constexpr double longest_s = 1e6;  // also of a request, which may hold any number
  TimeLimit limit =
      max_seconds > 0 ? TimeLimit::after(std::min(max_seconds, longest_s)) : TimeLimit{};
  limit.cancelled = [this] { return inbox_.is_stopped(); };
  return limit;
}

bool Bridge::work(double seconds) {
  Inbox::Work work = inbox_.next(seconds);
  for (const ImageRequest& request : work.expired) {
    const std::string why = diagnostics_.problem_of(info_subject);
    request.on_failure("request: found no image in time" + (why.empty() ? "" : " (" + why + ")") +
                       ", expected one within " + std::to_string(options_.request_seconds) + " s");
  }
  if (work.dropped > 0) diagnostics_.count(dropped_for_newer, work.dropped);
  if (work.job) {
    diagnostics_.work_begins("request");
    work.job();
    diagnostics_.work_ends(true);
  }
  if (work.image) {
    diagnostics_.work_begins("image");
    diagnostics_.work_ends(work_on(std::move(*work.image), std::move(work.for_image)));
  }
  return work.is_any();
}

bool Bridge::work_on(ArrivedImage arrived, std::vector<ImageRequest> requests) {
  const std::optional<Image> image = decoded(arrived.message);
  if (!image) {
    inbox_.put_back(std::move(requests));
    return false;
  }
  const msg::Header header = header_of(arrived.message);
  // Before the camera is asked for: a calibration that arrives meanwhile must not be missed.
  arrived.not_before_info = inbox_.calibrations() + 1;
  const std::optional<Camera> camera = camera_for(header, image->width, image->height);
  if (!camera) {
    wait_for_calibration(std::move(arrived), std::move(requests));
    return false;
  }
  const TakenImage taken{header, *image, *camera, depth_for(arrived, *camera)};
  for (const ImageRequest& request : requests) request.on_image(taken);
  const bool has_result = !requests.empty() || detect_without_request(taken);
  diagnostics_.count("images worked on");
  const std::chrono::duration<double, std::milli> latency = Clock::now() - arrived.time;
  diagnostics_.set("latency of the last image, ms", std::to_string(latency.count()));
  return has_result;
}

std::optional<Image> Bridge::decoded(const ImageMessage& message) {
  std::optional<Image> image;
  guarded(
      [&] {
        image = image_of(message, image_subject, options_.images);
        diagnostics_.solved(image_subject);
      },
      [&](const std::string& why) {
        diagnostics_.count("images refused");
        diagnostics_.problem(image_subject, why);
      });
  return image;
}

std::optional<Camera> Bridge::camera_for(const msg::Header& header, int width, int height) {
  std::optional<Camera> camera;
  guarded(
      [&] {
        camera = camera_.of_topic(header, width, height);
        diagnostics_.solved(info_subject);
        warn_of(*camera);
      },
      [&](const std::string& why) { diagnostics_.problem(info_subject, why); });
  return camera;
}

std::shared_ptr<const MeasuredDepth> Bridge::depth_for(const ArrivedImage& arrived,
                                                       const Camera& camera) {
  if (options_.depth == DepthSource::None) return nullptr;
  std::shared_ptr<const MeasuredDepth> depth;
  const msg::Header& header = header_of(arrived.message);
  guarded(
      [&] {
        if (!arrived.depth)
          throw InputError(depth_subject, "of the image", "none",
                           nanoseconds(header.stamp) == 0
                               ? "an image with a stamp"
                               : "one of its stamp (depth_tolerance) in time (depth_seconds)");
        depth = depth_.of_topic(*arrived.depth, header, camera, search_.backend().threads());
        diagnostics_.count("images worked on with depth");
        diagnostics_.solved(depth_subject);
      },
      [&](const std::string& why) {
        diagnostics_.count("images worked on without depth");
        diagnostics_.problem(depth_subject, why);
      });
  return depth;
}

// A warning keeps the numbers of the first image that has it, until an image has it no more.
void Bridge::warn_of_depth() {
  const std::vector<DepthWarning> warnings = search_.depth_warnings();
  for (const DepthFault fault : {DepthFault::Unit, DepthFault::Moved, DepthFault::OtherImage}) {
    const std::string subject = subject_of(fault);
    const auto warning = std::ranges::find(warnings, fault, &DepthWarning::fault);
    if (warning == warnings.end())
      diagnostics_.solved(subject);
    else if (diagnostics_.problem_of(subject).empty())
      diagnostics_.problem(subject, warning->found + "; " + question_of(fault));
  }
}

// Values that are possible and hardly right: said once of each camera.
void Bridge::warn_of(const Camera& camera) {
  if (warned_of_ && same_camera(*warned_of_, camera)) return;
  warned_of_ = camera;
  const std::vector<std::string> warnings = implausible_in(camera);
  if (warnings.empty()) return diagnostics_.solved("camera");
  diagnostics_.problem("camera", std::string(info_subject) + ": " + warnings.front());
}

void Bridge::wait_for_calibration(ArrivedImage arrived, std::vector<ImageRequest> requests) {
  inbox_.put_back(std::move(requests));
  if (options_.without_camera == WithoutCamera::Drop)
    diagnostics_.count("images dropped: no camera");
  else if (!inbox_.put_back(std::move(arrived)))
    diagnostics_.count(dropped_for_newer);
}

Se3 Bridge::world_from_camera(const msg::Header& image) const {
  if (options_.world_frame.empty())
    throw InputError("tf", "world_frame", "nothing", "the option world_frame");
  return tf_.lookup(options_.world_frame, image.frame_id, image.stamp, options_.tf_seconds);
}

Bridge::Found Bridge::detect(const TakenImage& image, double max_seconds) {
  const bool in_world = !options_.world_frame.empty();
  const Se3 world_from_image = in_world ? world_from_camera(image.header) : Se3{};
  diagnostics_.solved(tf_subject);
  const Detections found = search_.in_image(
      {image.image, image.camera, inverse(world_from_image), image.depth}, limit_of(max_seconds));
  Found result{image.header, {}, found.completion};
  if (in_world) result.header.frame_id = options_.world_frame;
  for (const Detection& detection : found.detections)
    result.detections.push_back(in_world ? in_frame(world_from_image, detection) : detection);
  if (found.completion != Completion::Complete) diagnostics_.count("images not worked on wholly");
  publish(result, image.header, found.detections);
  if (image.depth) warn_of_depth();
  return result;
}

bool Bridge::detect_without_request(const TakenImage& image) {
  bool has_result = false;
  try {
    guarded(
        [&] {
          detect(image, options_.max_seconds);
          has_result = true;
          diagnostics_.solved(search_subject);
        },
        [&](const std::string& why) {
          if (is_stopped()) return;  // not what the image made the library say
          diagnostics_.count("images without a result");
          diagnostics_.problem(why.starts_with("tf:") ? tf_subject : search_subject, why);
        });
  } catch (const GpuError& error) {
    diagnostics_.problem(search_subject, error.what());
    throw;
  }
  return has_result;
}

void Bridge::publish(const Found& found, const msg::Header& image,
                     std::span<const Detection> in_camera) {
  const DetectedObjects objects = search_.objects();
  outbox_.send(detections_message(found.header, found.detections, objects));
  if (options_.publish_tf) outbox_.send(frames_message(found.header, found.detections, objects));
  if (outbox_.wants_markers())
    outbox_.send(markers_message(found.header, found.detections, objects));
  if (outbox_.wants_overlay()) outbox_.send(message_of(search_.overlay(in_camera), image));
}

}  // namespace edgescout::ros2
