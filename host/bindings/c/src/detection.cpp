// Detection, registration and their pictures.
#include "host/bindings/c/src/depth.h"
#include "host/bindings/c/src/images.h"
#include "host/bindings/c/src/limits.h"
#include "host/bindings/c/src/poses.h"
#include "host/bindings/c/src/results.h"
#include "host/bindings/c/src/structs.h"
#include "host/io/camera_file.h"
#include "host/overlay.h"
#include "host/register_objects.h"

namespace edgescout::c {

namespace {

// What every call of a request uses.
struct Request {
  edgescout_request given;
  TimeLimit limit;
  Borrowed<edgescout_templates> templates;
  Borrowed<edgescout_backend> backend;

  explicit Request(const edgescout_request* request)
      : given(read_struct(request, "request")),
        limit(limit_of(given.limit)),
        templates(shared(given.templates)),
        backend(exclusive(given.backend)) {}
  Backend& on() const { return *backend->backend; }
};

// Image, camera and pose of a view of the caller, and what came beside the image.
struct TakenImage {
  Image image;
  Camera camera;
  Se3 camera_from_world;
  std::optional<TakenDepth> depth;
};

TakenImage taken_image(const edgescout_view& view) {
  TakenImage taken;
  taken.image = image_of(view.image);
  taken.camera = camera_for_image(*shared(view.camera), taken.image.width, taken.image.height,
                                  false, "camera");
  if (view.camera_from_world)
    taken.camera_from_world = pose_of(view.camera_from_world, "view.camera_from_world");
  taken.depth = take_depth({view.depth, view.depth_camera, view.camera_from_depth}, "view");
  return taken;
}

std::vector<TakenImage> taken_images(const edgescout_request& request) {
  if (request.view_count == 0) refuse(EDGESCOUT_BAD_INPUT, "request.view_count", "0", "at least 1");
  std::vector<TakenImage> taken;
  for (const edgescout_view& view :
       read_structs(request.views, request.view_count, "request.views")) {
    if (request.view_count > 1) require(view.camera_from_world, "view.camera_from_world");
    taken.push_back(taken_image(view));
  }
  return taken;
}

std::vector<ObjectView> prepared(const Request& request, const PipelineOptions& options) {
  std::vector<ObjectView> views;
  for (const TakenImage& taken : taken_images(request.given)) {
    ObjectView& view = views.emplace_back(
        prepare_view(taken.image, taken.camera, taken.camera_from_world, request.on(), options));
    view.depth = in_camera(taken.depth, taken.camera, request.on().threads());
  }
  return views;
}

FoundObjects detect_in_one(const Request& request) {
  if (request.given.view_count != 1)
    refuse(EDGESCOUT_BAD_INPUT, "request.view_count", std::to_string(request.given.view_count),
           "1, or a call of edgescout_detect_jointly");
  auto options = options_of<PipelineOptions>(request.given.options);
  options.limit = request.limit;
  const std::vector<ObjectView> views = prepared(request, options);
  const auto& sets = request.templates->sets;
  return named(detect_objects(views.front(), sets, request.on(), options), sets);
}

FoundObjects detect_in_all(const Request& request) {
  auto options = options_of<PipelineOptions>(request.given.options);
  options.limit = request.limit;
  const auto& sets = request.templates->sets;
  return named(detect_jointly(prepared(request, options), sets, request.on(), options), sets);
}

std::vector<ObjectPose> starts_of(const edgescout_starts& given, std::size_t parts) {
  if (!given.objects && parts > 1 && given.count > 0)
    refuse(EDGESCOUT_BAD_INPUT, "starts.objects", "NULL",
           "the part of each of " + std::to_string(given.count) + " poses");
  std::vector<ObjectPose> starts;
  if (given.count == 0) return starts;
  for (const Se3& pose :
       poses_of(given.world_from_object, given.count, "starts.world_from_object")) {
    const int object = given.objects ? given.objects[starts.size()] : 0;
    if (object < 0 || std::size_t(object) >= parts)
      refuse(EDGESCOUT_BAD_INPUT, "starts.objects[" + std::to_string(starts.size()) + "]",
             std::to_string(object), "one of " + std::to_string(parts) + " parts");
    starts.push_back({object, pose});
  }
  return starts;
}

FoundObjects register_in_all(const Request& request, const edgescout_starts& starts) {
  auto options = options_of<RegistrationOptions>(request.given.options);
  options.work.limit = request.limit;
  PipelineOptions preparing;
  preparing.edges = options.edges;
  const PartTemplates& parts = *request.templates;
  const std::vector<ObjectPose> poses = starts_of(starts, parts.sets.size());
  return named(register_objects(prepared(request, preparing), parts.models, poses, request.on(),
                                options.work),
               parts.sets);
}

RgbImage drawn(const Request& request, const FoundObjects& detections) {
  const std::vector<EdgeModel>& models = request.templates->models;
  const ObjectView view = prepared(request, {}).front();
  std::vector<OverlayPose> poses;
  for (const FoundObject& found : detections.found) {
    if (std::size_t(found.object) >= models.size())
      refuse(EDGESCOUT_BAD_INPUT, "detections", "part " + std::to_string(found.object),
             "one of " + std::to_string(models.size()) + " in the templates");
    poses.push_back(
        {found.object, view.camera_from_world * found.world_from_object, found.probability, ""});
  }
  return draw_overlay(*view.image, view.camera, poses, models, view.edges.get(), request.on());
}

}  // namespace

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_detect(const edgescout_request* request, edgescout_detections** out) {
  return create(out, [&] { return detect_in_one(Request(request)); });
}

edgescout_status edgescout_detect_jointly(const edgescout_request* request,
                                          edgescout_detections** out) {
  return create(out, [&] { return detect_in_all(Request(request)); });
}

edgescout_status edgescout_register(const edgescout_request* request,
                                    const edgescout_starts* starts, edgescout_detections** out) {
  return create(out,
                [&] { return register_in_all(Request(request), read_struct(starts, "starts")); });
}

edgescout_status edgescout_overlay(const edgescout_request* request,
                                   const edgescout_detections* detections,
                                   edgescout_picture** out) {
  return create(out, [&] { return drawn(Request(request), *shared(detections)); });
}
