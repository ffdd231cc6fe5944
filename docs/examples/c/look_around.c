/* Takes the view of which most is expected, until the part is certain:
   look_around SCENE MESH_MM [PNG]. Recorded images stand in for an arm. SCENE is
   docs/examples/scenes/000001, MESH_MM docs/examples/parts/obj_000006.ply. */
#include <edgescout.h>
#include <stdio.h>
#include <stdlib.h>

#define VIEWS 2

/* Where the arm can hold the camera; the world is its base. */
static const double camera_from_world[VIEWS][16] = {
    {-0.9190735403093138, 0.3871345211111347, -0.07369321588421038, -0.01710887281610986,
     0.34672560317035533, 0.7054766943926246, -0.6181294280124581, 0.01441869488709377,
     -0.18731039375714778, -0.5936577264997969, -0.7826144134614661, 0.4157994342528477, 0, 0, 0,
     1},
    {0.44526554403801266, -0.887550367306008, -0.11829176128329066, 0.015646812010002343,
     -0.611204713057013, -0.20473230131862374, -0.7645348151220291, 0.009953504113119516,
     0.6543450114652264, 0.4127214924034742, -0.6336352071017064, 0.3667710046368189, 0, 0, 0, 1}};

static void must(edgescout_status status) {
  if (status == EDGESCOUT_OK) return;
  fprintf(stderr, "%s: %s\n", edgescout_status_name(status), edgescout_last_error());
  exit(2);
}

/* An arm moves to the view here and its camera takes an image. */
static edgescout_picture* take_image(const char* scene, int view) {
  char file[4096];
  snprintf(file, sizeof file, "%s/gray/%06d.png", scene, view);
  edgescout_picture* picture;
  must(edgescout_picture_load(file, NULL, &picture));
  return picture;
}

static int32_t is_stopped(void* arm) {
  (void)arm; /* reads the emergency stop */
  return 0;
}

static edgescout_templates* templates_of(const char* mesh_file, edgescout_backend* backend) {
  edgescout_mesh* mesh;
  must(edgescout_mesh_load(mesh_file, "mm", &mesh));
  edgescout_options* options;
  must(edgescout_options_create(EDGESCOUT_TEMPLATE_OPTIONS, &options));
  must(edgescout_options_set(options, "distance-min", "0.45"));
  must(edgescout_options_set(options, "distance-max", "0.52"));
  edgescout_part part = {.struct_size = sizeof part};
  part.mesh = mesh;
  part.options = options;
  part.backend = backend;
  part.object_id = 6;
  edgescout_templates* templates;
  must(edgescout_templates_build(&part, &templates));
  must(edgescout_free(options));
  must(edgescout_free(mesh));
  return templates;
}

static edgescout_scout* scout_of(const edgescout_templates* templates,
                                 const edgescout_camera* camera, edgescout_backend* backend) {
  edgescout_options* options;
  must(edgescout_options_create(EDGESCOUT_SCOUT_OPTIONS, &options));
  must(edgescout_options_set(options, "max-views", "5"));
  edgescout_scout_plan plan = {.struct_size = sizeof plan};
  plan.templates = templates;
  plan.camera = camera;
  plan.camera_from_world = camera_from_world[0];
  plan.view_count = VIEWS;
  plan.backend = backend;
  plan.options = options;
  edgescout_scout* scout;
  must(edgescout_scout_create(&plan, &scout));
  must(edgescout_free(options));
  return scout;
}

/* Takes the views that the scout asks for. */
static void look_around(edgescout_scout* scout, const char* scene) {
  edgescout_limit limit = {.struct_size = sizeof limit};
  limit.cancelled = is_stopped;
  for (;;) {
    edgescout_proposal next = {.struct_size = sizeof next};
    must(edgescout_scout_propose(scout, &limit, &next));
    if (next.view < 0) return;
    edgescout_picture* picture = take_image(scene, next.view);
    edgescout_image image = {.struct_size = sizeof image};
    must(edgescout_picture_get(picture, &image));
    edgescout_shot shot = {.struct_size = sizeof shot};
    shot.view = next.view;
    shot.image = &image; /* shot.camera_from_world: the pose that the arm measures */
    shot.limit = &limit;
    /* A view that cannot be had: edgescout_scout_unreachable proposes another one. */
    must(edgescout_scout_give(scout, &shot));
    must(edgescout_free(picture));
    edgescout_scout_state state = {.struct_size = sizeof state};
    must(edgescout_scout_get(scout, &state));
    printf("view %d: %.3f nats undecided\n", next.view, state.entropy_nats);
  }
}

static void draw(const edgescout_request* request, const edgescout_detections* detections,
                 const char* file) {
  edgescout_picture* overlay;
  must(edgescout_overlay(request, detections, &overlay));
  must(edgescout_picture_save_png(overlay, file));
  must(edgescout_free(overlay));
}

int main(int argc, char** argv) {
  if (argc < 3) {
    fprintf(stderr, "usage: look_around SCENE MESH_MM [PNG]\n");
    return 2;
  }
  must(edgescout_require_abi(EDGESCOUT_ABI));
  edgescout_backend* backend;
  must(edgescout_backend_create("auto", 0, &backend));
  edgescout_camera_model model = {.struct_size = sizeof model};
  model.width = 640;
  model.height = 480;
  model.fx = model.fy = 700;
  model.cx = 319.5;
  model.cy = 239.5;
  edgescout_camera* camera;
  must(edgescout_camera_create(&model, &camera));
  edgescout_templates* templates = templates_of(argv[2], backend);
  edgescout_scout* scout = scout_of(templates, camera, backend);

  look_around(scout, argv[1]);
  edgescout_detections* detections;
  must(edgescout_scout_detections(scout, &detections));
  edgescout_summary summary = {.struct_size = sizeof summary};
  must(edgescout_detections_get(detections, &summary));
  for (size_t i = 0; i < summary.detection_count; ++i) {
    edgescout_detection found = {.struct_size = sizeof found};
    must(edgescout_detections_at(detections, i, &found));
    const double* pose = found.world_from_object;
    printf("%s: probability %.3f, at %.4f %.4f %.4f m, seen well in %zu images\n", found.name,
           found.probability, pose[3], pose[7], pose[11], found.supporting_image_count);
  }
  if (argc > 3) {
    edgescout_picture* picture = take_image(argv[1], 0);
    edgescout_image image = {.struct_size = sizeof image};
    must(edgescout_picture_get(picture, &image));
    edgescout_view view = {.struct_size = sizeof view};
    view.image = &image;
    view.camera = camera;
    view.camera_from_world = camera_from_world[0];
    edgescout_request request = {.struct_size = sizeof request};
    request.views = &view;
    request.view_count = 1;
    request.templates = templates;
    request.backend = backend;
    draw(&request, detections, argv[3]);
    must(edgescout_free(picture));
  }

  must(edgescout_free(detections));
  must(edgescout_free(scout));
  must(edgescout_free(templates));
  must(edgescout_free(camera));
  must(edgescout_free(backend));
  return summary.detection_count == 0;
}
