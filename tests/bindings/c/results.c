/* What detection, joint detection, registration and the scout find, as exact numbers.
   results_of_cpp.cpp prints the same by C++. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/bindings/c/depth_values.h"
#include "tests/bindings/c/scene.h"

static void print_numbers(const char* name, const double* numbers, int count) {
  printf("  %s", name);
  for (int i = 0; i < count; ++i) printf(" %a", numbers[i]);
  printf("\n");
}

static void print_detection(const edgescout_detections* detections, size_t index) {
  edgescout_detection d = {.struct_size = sizeof d};
  OK(es_detections_at(detections, index, &d));
  printf(" object %d id %d %s, %s\n", d.object, d.object_id, d.name, d.convergence);
  print_numbers("pose", d.world_from_object, 16);
  print_numbers("covariance", d.covariance, 36);
  const double scores[6] = {d.probability,     d.psi, d.psi_z_score, d.cost_px, d.matched_fraction,
                            d.unexplained_grey};
  print_numbers("scores", scores, 6);
  for (size_t i = 0; i < d.alternative_count; ++i) {
    edgescout_alternative other = {.struct_size = sizeof other};
    OK(es_detections_alternative(detections, index, i, &other));
    print_numbers("alternative", other.world_from_object, 16);
    print_numbers("probability", &other.probability, 1);
  }
  for (size_t i = 0; i < d.supporting_image_count; ++i)
    printf("  supported by image %d\n", d.supporting_images[i]);
}

static void print_detections(const char* call, edgescout_detections* detections) {
  edgescout_summary summary = {.struct_size = sizeof summary};
  OK(es_detections_get(detections, &summary));
  printf("%s: %zu, completion %d\n", call, summary.detection_count, summary.completion);
  for (size_t i = 0; i < summary.stage_count; ++i) {
    edgescout_stage stage = {.struct_size = sizeof stage};
    OK(es_detections_stage(detections, i, &stage));
    printf(" stage %s\n", stage.name);
    CHECK(stage.seconds >= 0);
  }
  for (size_t i = 0; i < summary.detection_count; ++i) print_detection(detections, i);
  OK(es_free(detections));
}

/* Three updates by one image, from the best pose. */
static void print_tracks(const struct scene* scene, const edgescout_detections* found) {
  edgescout_detection best = {.struct_size = sizeof best};
  OK(es_detections_at(found, 0, &best));
  edgescout_tracker* const tracker = example_tracker(scene);
  int32_t id = 0;
  OK(es_tracker_add(tracker, best.object, best.world_from_object, &id));
  for (int i = 1; i <= 3; ++i) {
    const edgescout_frame frame = {
        .struct_size = sizeof frame, .image = &scene->image, .time_s = i / 30.0};
    OK(es_tracker_update(tracker, &frame));
    edgescout_track track = {.struct_size = sizeof track};
    OK(es_tracker_at(tracker, 0, &track));
    printf("track %d of object %d: state %d\n", track.id, track.object, track.state);
    print_numbers("pose", track.camera_from_object, 16);
    print_numbers("covariance", track.covariance, 36);
    print_numbers("above chance", &track.above_chance, 1);
  }
  OK(es_free(tracker));
}

static void print_one_view(const struct scene* scene) {
  edgescout_detections* found = NULL;
  OK(es_options_set(scene->detect_options, "min-probability", "0.05"));
  OK(es_detect(&scene->request, &found));
  print_tracks(scene, found);
  print_detections("detect", found);
  const double starts[32] = {1, 0, 0, -0.11, 0, 1, 0, 0.01, 0, 0, 1, 0.33, 0, 0, 0, 1,
                             1, 0, 0, 5,     0, 1, 0, 0.01, 0, 0, 1, 0.33, 0, 0, 0, 1};
  const edgescout_starts two = {.struct_size = sizeof two, .world_from_object = starts, .count = 2};
  edgescout_request request = scene->request;
  request.options = NULL;
  OK(es_register(&request, &two, &found));
  print_detections("register", found);
  edgescout_options* options = NULL;
  OK(es_options_create(EDGESCOUT_REGISTER_OPTIONS, &options));
  OK(es_options_set(options, "edge-sigma", "1.5"));
  OK(es_options_set(options, "bins", "30"));
  OK(es_options_set(options, "search-kept", "2"));
  request.options = options;
  OK(es_register(&request, &two, &found));
  print_detections("register with options", found);
  OK(es_free(options));
}

/* Rows of 16 bit that go upwards in memory; whole and real numbers of 32 bit, without padding. */
static edgescout_image depth_of(int32_t format, int32_t width, int32_t height) {
  static uint16_t whole16[210][203];
  static uint32_t whole32[210 * 320];
  static float real[210 * 320];
  edgescout_image depth = {
      .struct_size = sizeof depth, .width = width, .height = height, .format = format};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const unsigned mm = depth_mm_at(x, y);
      if (format == EDGESCOUT_MONO16) whole16[height - 1 - y][x] = (uint16_t)mm;
      whole32[y * width + x] = mm;
      real[y * width + x] = mm == 0 ? (float)NAN : (float)mm / 1000.0f;
    }
  if (format == EDGESCOUT_MONO16) {
    depth.pixels = whole16[height - 1];
    depth.row_stride_bytes = -(int64_t)sizeof *whole16;
  } else {
    depth.pixels = format == EDGESCOUT_MONO32 ? (const void*)whole32 : real;
  }
  return depth;
}

static void print_with_depth(const struct scene* scene) {
  edgescout_options* sensor = NULL;
  OK(es_options_create(EDGESCOUT_DEPTH_OPTIONS, &sensor));
  OK(es_options_set(sensor, "depth-noise", "0.002"));
  edgescout_image depth = depth_of(EDGESCOUT_MONO16, part_window.width, part_window.height);
  depth.options = sensor;
  edgescout_view view = scene->view;
  view.depth = &depth;
  edgescout_request request = scene->request;
  request.views = &view;
  edgescout_detections* found = NULL;
  OK(es_detect(&request, &found));
  print_detections("detect with depth", found);

  edgescout_camera_model model = {.struct_size = sizeof model};
  model.width = DEPTH_WIDTH;
  model.height = DEPTH_HEIGHT;
  model.fx = model.fy = depth_focal_px;
  model.cx = depth_center_px[0];
  model.cy = depth_center_px[1];
  edgescout_camera* camera = NULL;
  OK(es_camera_create(&model, &camera));
  depth = depth_of(EDGESCOUT_FLOAT32, DEPTH_WIDTH, DEPTH_HEIGHT);
  view.depth_camera = camera;
  view.camera_from_depth = camera_from_depth_rows;
  request.options = NULL;
  const double start[16] = {1, 0, 0, -0.11, 0, 1, 0, 0.01, 0, 0, 1, 0.33, 0, 0, 0, 1};
  const edgescout_starts one = {.struct_size = sizeof one, .world_from_object = start, .count = 1};
  OK(es_register(&request, &one, &found));
  print_detections("register with a depth camera", found);
  OK(es_free(camera));
  OK(es_free(sensor));
}

static int32_t is_second(int32_t view, void* unused) {
  (void)unused;
  return view == 1;
}

static void print_two_views(const struct scene* scene, const edgescout_templates* parts) {
  edgescout_picture* pictures[SCOUT_VIEWS];
  edgescout_image images[SCOUT_VIEWS];
  edgescout_view views[SCOUT_VIEWS];
  edgescout_scout_plan plan = example_plan(scene);
  plan.templates = parts;
  plan.reachable = is_second;
  edgescout_scout* scout = NULL;
  OK(es_scout_create(&plan, &scout));
  edgescout_proposal proposal = {.struct_size = sizeof proposal};
  OK(es_scout_propose(scout, NULL, &proposal));
  printf("proposal: view %d\n", proposal.view);
  const edgescout_image depth = depth_of(EDGESCOUT_MONO32, scout_window.width, scout_window.height);
  for (int i = 0; i < SCOUT_VIEWS; ++i) {
    pictures[i] = picture_of_view(i, &images[i]);
    views[i] = (edgescout_view){.struct_size = sizeof *views,
                                .image = &images[i],
                                .camera = scene->scout_camera,
                                .camera_from_world = camera_from_world_views[i]};
    edgescout_shot shot = {.struct_size = sizeof shot, .view = i, .image = &images[i]};
    if (i == 1) shot.depth = &depth;
    OK(es_scout_give(scout, &shot));
  }
  edgescout_request request = scene->request;
  request.views = views;
  request.view_count = SCOUT_VIEWS;
  request.templates = parts;
  edgescout_detections* found = NULL;
  OK(es_detect_jointly(&request, &found));
  print_detections("detect_jointly", found);
  views[1].depth = &depth;
  OK(es_detect_jointly(&request, &found));
  print_detections("detect_jointly with depth", found);
  OK(es_scout_detections(scout, &found));
  print_detections("scout", found);
  OK(es_free(scout));
  for (int i = 0; i < SCOUT_VIEWS; ++i) OK(es_free(pictures[i]));
}

void print_results(void) {
  struct scene scene;
  open_scene(&scene);
  print_one_view(&scene);
  print_with_depth(&scene);
  edgescout_templates* const parts[2] = {templates_of_part(4, "0.37", "0.37", "1", scene.backend),
                                         templates_of_part(6, "0.37", "0.37", "2", scene.backend)};
  edgescout_templates* both = NULL;
  OK(es_templates_join((const edgescout_templates* const*)parts, 2, &both));
  OK(es_free(parts[0]));
  OK(es_free(parts[1]));
  print_two_views(&scene, both);
  OK(es_free(both));
  close_scene(&scene);
}
