/* Depth images beside grey ones: what is refused, and what counts as none. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "tests/bindings/c/scene.h"

enum { WIDTH = 200, HEIGHT = 210, AREA = WIDTH * HEIGHT }; /* of part_window */

static uint16_t whole_mm[AREA];
static float real_m[AREA];
static const double start[16] = {1, 0, 0, -0.11, 0, 1, 0, 0.01, 0, 0, 1, 0.33, 0, 0, 0, 1};

static edgescout_image image_of(const void* values, int32_t format) {
  return (edgescout_image){.struct_size = sizeof(edgescout_image),
                           .pixels = values,
                           .width = WIDTH,
                           .height = HEIGHT,
                           .format = format};
}

/* The scene's view with a depth image; NULL: none. */
static edgescout_status registered(const struct scene* scene, const edgescout_view* view,
                                   edgescout_detection* found) {
  edgescout_request request = scene->request;
  request.views = view;
  request.options = NULL;
  const edgescout_starts one = {.struct_size = sizeof one, .world_from_object = start, .count = 1};
  edgescout_detections* detections = NULL;
  const edgescout_status status = es_register(&request, &one, &detections);
  *found = (edgescout_detection){.struct_size = sizeof *found};
  if (status == EDGESCOUT_OK) OK(es_detections_at(detections, 0, found));
  OK(es_free(detections));
  return status;
}

static int same_numbers(const edgescout_detection* a, const edgescout_detection* b) {
  return a->probability == b->probability &&
         memcmp(a->world_from_object, b->world_from_object, sizeof a->world_from_object) == 0;
}

/* Zeros, NaN and what lies outside the range say nothing. */
static void expect_missing_values_to_say_nothing(const struct scene* scene) {
  edgescout_detection grey, found;
  OK(registered(scene, &scene->view, &grey));
  edgescout_view view = scene->view;
  memset(whole_mm, 0, sizeof whole_mm);
  edgescout_image depth = image_of(whole_mm, EDGESCOUT_MONO16);
  view.depth = &depth;
  OK(registered(scene, &view, &found));
  CHECK(same_numbers(&grey, &found));
  for (int i = 0; i < AREA; ++i) real_m[i] = i % 3 == 0 ? (float)NAN : i % 3 == 1 ? 0 : INFINITY;
  depth = image_of(real_m, EDGESCOUT_FLOAT32);
  OK(registered(scene, &view, &found));
  CHECK(same_numbers(&grey, &found));
  for (int i = 0; i < AREA; ++i) real_m[i] = 0.33f;
  OK(registered(scene, &view, &found));
  CHECK(!same_numbers(&grey, &found));
}

static void expect_refused(const struct scene* scene, const edgescout_view* view,
                           edgescout_status status, const char* message) {
  edgescout_detection found;
  EXPECT(status, registered(scene, view, &found));
  SAYS(message);
}

static void expect_refusals(const struct scene* scene) {
  edgescout_view view = scene->view;
  for (int i = 0; i < AREA; ++i) whole_mm[i] = 3; /* metres? */
  edgescout_image depth = image_of(whole_mm, EDGESCOUT_MONO16);
  view.depth = &depth;
  expect_refused(scene, &view, EDGESCOUT_BAD_INPUT, "depth: values: found around 3, which");
  for (int i = 0; i < AREA; ++i) whole_mm[i] = 330;
  depth.height = HEIGHT - 1;
  expect_refused(scene, &view, EDGESCOUT_BAD_INPUT, "found 200x209, expected 200x210");
  depth = image_of(whole_mm, EDGESCOUT_MONO8);
  expect_refused(scene, &view, EDGESCOUT_BAD_INPUT, "depth: format: found a picture");
  depth.format = 22;
  expect_refused(scene, &view, EDGESCOUT_BAD_INPUT, "depth.format: found 22");
  depth = image_of(NULL, EDGESCOUT_MONO16);
  expect_refused(scene, &view, EDGESCOUT_NULL, "depth.pixels");
  depth = image_of(whole_mm, EDGESCOUT_MONO16);
  depth.row_stride_bytes = WIDTH;
  expect_refused(scene, &view, EDGESCOUT_BAD_INPUT, "depth: row stride: found 200 bytes");
  depth = image_of(whole_mm, EDGESCOUT_MONO16);
  depth.options = scene->detect_options;
  expect_refused(scene, &view, EDGESCOUT_WRONG_KIND, "those of detect, expected those of depth");
  view.depth = NULL;
  view.depth_camera = scene->camera;
  expect_refused(scene, &view, EDGESCOUT_BAD_INPUT, "view.depth: found NULL");
}

static void expect_refusals_of_its_camera(const struct scene* scene) {
  edgescout_image depth = image_of(whole_mm, EDGESCOUT_MONO16);
  edgescout_view view = scene->view;
  view.depth = &depth;
  view.camera_from_depth = start;
  expect_refused(scene, &view, EDGESCOUT_BAD_INPUT, "view.depth_camera: found NULL");
  view.depth_camera = scene->scout_camera;
  expect_refused(scene, &view, EDGESCOUT_BAD_INPUT, "depth_camera: image size: found 200x210");
  view.depth_camera = scene->camera;
  const double stretched[16] = {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1};
  view.camera_from_depth = stretched;
  expect_refused(scene, &view, EDGESCOUT_BAD_INPUT, "view.camera_from_depth");
  /* In the same place it is the same camera, but for the borders of surfaces. */
  edgescout_detection found;
  view.camera_from_depth = NULL;
  OK(registered(scene, &view, &found));
}

void test_depth(void) {
  struct scene scene;
  open_scene(&scene);
  expect_missing_values_to_say_nothing(&scene);
  expect_refusals(&scene);
  expect_refusals_of_its_camera(&scene);
  close_scene(&scene);
}
