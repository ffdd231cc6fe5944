#include "host/active/views.h"
#include "host/bindings/c/src/contents.h"
#include "host/bindings/c/src/poses.h"
#include "host/bindings/c/src/structs.h"
#include "host/io/camera_file.h"

namespace edgescout::c {

namespace {

Camera camera_of(const edgescout_camera_model& model) {
  Camera camera{model.width, model.height, model.fx, model.fy, model.cx, model.cy};
  if (model.lens < EDGESCOUT_BROWN_CONRADY || model.lens > EDGESCOUT_FIELD_OF_VIEW)
    refuse(EDGESCOUT_BAD_INPUT, "model.lens", std::to_string(model.lens),
           "EDGESCOUT_BROWN_CONRADY or another lens");
  camera.lens = LensModel(model.lens);
  std::ranges::copy(model.distortion, camera.distortion.begin());
  camera.skew = model.skew;
  camera.field_of_view_rad = model.field_of_view_rad;
  validate(camera, "model");
  return camera;
}

edgescout_camera_model shown_camera(const Camera& camera) {
  edgescout_camera_model model{};
  model.width = camera.width;
  model.height = camera.height;
  model.fx = camera.fx;
  model.fy = camera.fy;
  model.cx = camera.cx;
  model.cy = camera.cy;
  model.skew = camera.skew;
  model.lens = std::int32_t(camera.lens);
  std::ranges::copy(camera.distortion, model.distortion);
  model.field_of_view_rad = camera.field_of_view_rad;
  return model;
}

HemisphereOptions rings_of(const edgescout_hemisphere& given) {
  HemisphereOptions rings;
  rings.center_m = {given.center_m[0], given.center_m[1], given.center_m[2]};
  rings.radius_m = given.radius_m;
  rings.count = given.count;
  if (given.elevation_count < 0 || given.elevation_count > 10000)
    refuse(EDGESCOUT_BAD_INPUT, "hemisphere.elevation_count", std::to_string(given.elevation_count),
           "0 to 10000");
  if (given.elevations_deg)
    rings.elevations_deg.assign(given.elevations_deg, given.elevations_deg + given.elevation_count);
  return rings;
}

}  // namespace

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_camera_create(const edgescout_camera_model* model,
                                         edgescout_camera** out) {
  return create(out, [&] { return camera_of(read_struct(model, "model")); });
}

edgescout_status edgescout_camera_load(const char* file, const char* name, edgescout_camera** out) {
  return create(out, [&] {
    require(file, "file");
    return edgescout::load_camera(file, name ? name : "");
  });
}

edgescout_status edgescout_camera_get(const edgescout_camera* camera, edgescout_camera_model* out) {
  return guarded([&] { write_struct(shown_camera(*shared(camera)), out, "out"); });
}

edgescout_status edgescout_look_at(const double eye_m[3], const double target_m[3],
                                   double camera_from_world[16]) {
  return guarded([&] {
    require(eye_m, "eye_m");
    require(target_m, "target_m");
    require(camera_from_world, "camera_from_world");
    const edgescout::Se3 pose =
        edgescout::look_at({eye_m[0], eye_m[1], eye_m[2]}, {target_m[0], target_m[1], target_m[2]});
    edgescout::write_rows(pose, std::span<double, 16>(camera_from_world, 16));
  });
}

edgescout_status edgescout_hemisphere_views(const edgescout_hemisphere* hemisphere,
                                            double* camera_from_world, size_t capacity,
                                            size_t* count) {
  return guarded([&] {
    require(count, "count");
    const std::vector<edgescout::Se3> views =
        edgescout::hemisphere_views(rings_of(read_struct(hemisphere, "hemisphere")));
    *count = views.size();
    if (!camera_from_world && capacity == 0) return;
    require(camera_from_world, "camera_from_world");
    if (capacity < views.size())
      refuse(EDGESCOUT_BAD_INPUT, "capacity", std::to_string(capacity),
             "at least " + std::to_string(views.size()));
    for (std::size_t i = 0; i < views.size(); ++i)
      edgescout::write_rows(views[i], std::span<double, 16>(camera_from_world + 16 * i, 16));
  });
}
