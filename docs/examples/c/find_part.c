/* Finds a part in an image: find_part IMAGE CAMERA_FILE MESH_MM DISTANCE_MIN DISTANCE_MAX [PNG].
   Distances from the camera to the part are in metres. */
#include <edgescout.h>
#include <stdio.h>
#include <stdlib.h>

static void must(edgescout_status status) {
  if (status == EDGESCOUT_OK) return;
  fprintf(stderr, "%s: %s\n", edgescout_status_name(status), edgescout_last_error());
  exit(2);
}

int main(int argc, char** argv) {
  if (argc < 6) {
    fprintf(stderr, "usage: find_part IMAGE CAMERA_FILE MESH_MM DISTANCE_MIN DISTANCE_MAX [PNG]\n");
    return 2;
  }
  must(edgescout_require_abi(EDGESCOUT_ABI));
  edgescout_backend* backend;
  must(edgescout_backend_create("auto", 0, &backend));

  /* Once per part. edgescout_templates_save and _load keep the result in a file. */
  edgescout_mesh* mesh;
  must(edgescout_mesh_load(argv[3], "mm", &mesh));
  edgescout_options* distances;
  must(edgescout_options_create(EDGESCOUT_TEMPLATE_OPTIONS, &distances));
  must(edgescout_options_set(distances, "distance-min", argv[4]));
  must(edgescout_options_set(distances, "distance-max", argv[5]));
  edgescout_part part = {.struct_size = sizeof part};
  part.mesh = mesh;
  part.options = distances;
  part.backend = backend;
  part.object_id = 1;
  edgescout_templates* templates;
  must(edgescout_templates_build(&part, &templates));
  must(edgescout_free(distances));
  must(edgescout_free(mesh));

  /* Once per image. A camera driver's pixels need no picture: fill an edgescout_image. */
  edgescout_camera* camera;
  must(edgescout_camera_load(argv[2], NULL, &camera));
  edgescout_picture* picture;
  must(edgescout_picture_load(argv[1], NULL, &picture));
  edgescout_image image = {.struct_size = sizeof image};
  must(edgescout_picture_get(picture, &image));

  edgescout_view view = {.struct_size = sizeof view};
  view.image = &image;
  view.camera = camera;
  edgescout_limit limit = {.struct_size = sizeof limit};
  limit.max_seconds = 60;
  edgescout_request request = {.struct_size = sizeof request};
  request.views = &view;
  request.view_count = 1;
  request.templates = templates;
  request.backend = backend;
  request.limit = &limit;
  edgescout_detections* detections;
  must(edgescout_detect(&request, &detections));

  edgescout_summary summary = {.struct_size = sizeof summary};
  must(edgescout_detections_get(detections, &summary));
  if (summary.completion != EDGESCOUT_COMPLETE) printf("the time was over: poses may be missing\n");
  for (size_t i = 0; i < summary.detection_count; ++i) {
    edgescout_detection found = {.struct_size = sizeof found};
    must(edgescout_detections_at(detections, i, &found));
    const double* pose = found.world_from_object; /* one view: camera_from_object */
    printf("%s: probability %.3f, at %.4f %.4f %.4f m\n", found.name, found.probability, pose[3],
           pose[7], pose[11]);
  }
  if (argc > 6) {
    edgescout_picture* overlay;
    must(edgescout_overlay(&request, detections, &overlay));
    must(edgescout_picture_save_png(overlay, argv[6]));
    must(edgescout_free(overlay));
  }

  must(edgescout_free(detections));
  must(edgescout_free(picture));
  must(edgescout_free(camera));
  must(edgescout_free(templates));
  must(edgescout_free(backend));
  return summary.detection_count == 0;
}
