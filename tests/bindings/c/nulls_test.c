/* Every function with NULL for each pointer: an error where it must be there, never a crash. */
#include <string.h>

#include "tests/bindings/c/scene.h"

static void expect_nulls_of_one_argument(void) {
  EXPECT(EDGESCOUT_NULL, es_canceller_create(NULL));
  EXPECT(EDGESCOUT_NULL, es_cancel(NULL));
  EXPECT(EDGESCOUT_NULL, es_canceller_reset(NULL));
  EXPECT(EDGESCOUT_NULL, es_device_count(NULL));
  EXPECT(EDGESCOUT_NULL, es_device_at(0, NULL));
  OK(es_set_log_sink(NULL, NULL));
  OK(es_free(NULL));
  edgescout_backend* backend = (edgescout_backend*)&backend;
  EXPECT(EDGESCOUT_NULL, es_backend_create(NULL, 0, &backend));
  CHECK(backend == NULL); /* also where it fails */
  EXPECT(EDGESCOUT_NULL, es_backend_create("cpu", 0, NULL));
  edgescout_camera* camera;
  EXPECT(EDGESCOUT_NULL, es_camera_create(NULL, &camera));
  EXPECT(EDGESCOUT_NULL, es_camera_load(NULL, NULL, &camera));
  edgescout_picture* picture;
  EXPECT(EDGESCOUT_NULL, es_picture_load(NULL, NULL, &picture));
  EXPECT(EDGESCOUT_NULL, es_picture_grey(NULL, &picture));
  EXPECT(EDGESCOUT_NULL, es_picture_undistorted(NULL, NULL, &picture));
  edgescout_mesh* mesh;
  EXPECT(EDGESCOUT_NULL, es_mesh_load(NULL, "mm", &mesh));
  EXPECT(EDGESCOUT_NULL, es_mesh_create(NULL, &mesh));
  const edgescout_mesh_arrays no_arrays = {.struct_size = sizeof no_arrays};
  EXPECT(EDGESCOUT_NULL, es_mesh_create(&no_arrays, &mesh));
  edgescout_templates* templates;
  EXPECT(EDGESCOUT_NULL, es_templates_build(NULL, &templates));
  EXPECT(EDGESCOUT_NULL, es_templates_join(NULL, 1, &templates));
  EXPECT(EDGESCOUT_NULL, es_templates_load(NULL, &templates));
  edgescout_scout* scout;
  EXPECT(EDGESCOUT_NULL, es_scout_create(NULL, &scout));
  double pose[16];
  const double point[3] = {0, 0, 1};
  EXPECT(EDGESCOUT_NULL, es_look_at(NULL, point, pose));
  EXPECT(EDGESCOUT_NULL, es_look_at(point, NULL, pose));
  EXPECT(EDGESCOUT_NULL, es_look_at(point, point, NULL));
  size_t count;
  EXPECT(EDGESCOUT_NULL, es_hemisphere_views(NULL, NULL, 0, &count));
  const edgescout_hemisphere rings = {.struct_size = sizeof rings, .radius_m = 1, .count = 8};
  EXPECT(EDGESCOUT_NULL, es_hemisphere_views(&rings, pose, 1, NULL));
  EXPECT(EDGESCOUT_NULL, es_hemisphere_views(&rings, NULL, 8, &count));
}

static void expect_nulls_of_requests(const struct scene* scene) {
  edgescout_detections* detections = NULL;
  EXPECT(EDGESCOUT_NULL, es_detect(NULL, &detections));
  EXPECT(EDGESCOUT_NULL, es_detect_jointly(NULL, &detections));
  EXPECT(EDGESCOUT_NULL, es_register(NULL, NULL, &detections));
  EXPECT(EDGESCOUT_NULL, es_register(&scene->request, NULL, &detections));
  EXPECT(EDGESCOUT_NULL, es_detect(&scene->request, NULL));
  EXPECT(EDGESCOUT_NULL, es_detect_jointly(&scene->request, NULL));
  EXPECT(EDGESCOUT_NULL, es_overlay(&scene->request, NULL, NULL));
  edgescout_request request = scene->request;
  request.views = NULL;
  EXPECT(EDGESCOUT_NULL, es_detect(&request, &detections));
  SAYS("request.views: found NULL");
  request = scene->request;
  request.view_count = 0;
  EXPECT(EDGESCOUT_BAD_INPUT, es_detect(&request, &detections));
  EXPECT(EDGESCOUT_BAD_INPUT, es_detect_jointly(&request, &detections));
  const edgescout_view two[2] = {scene->view, scene->view};
  request.views = two;
  request.view_count = 2;
  EXPECT(EDGESCOUT_BAD_INPUT, es_detect(&request, &detections));
  SAYS("request.view_count: found 2, expected 1");
  EXPECT(EDGESCOUT_NULL, es_detect_jointly(&request, &detections));
  SAYS("view.camera_from_world: found NULL");
  edgescout_view view = scene->view;
  view.image = NULL;
  request = scene->request;
  request.views = &view;
  EXPECT(EDGESCOUT_NULL, es_detect(&request, &detections));
  SAYS("image: found NULL");
  edgescout_image image = scene->image;
  image.pixels = NULL;
  view.image = &image;
  EXPECT(EDGESCOUT_NULL, es_detect(&request, &detections));
  SAYS("image.pixels: found NULL");
  edgescout_starts starts = {.struct_size = sizeof starts, .count = 1};
  request = scene->request;
  request.options = NULL;
  EXPECT(EDGESCOUT_NULL, es_register(&request, &starts, &detections));
  SAYS("starts.world_from_object: found NULL");
  CHECK(detections == NULL);
}

static void expect_nulls_beside_handles(const struct scene* scene) {
  EXPECT(EDGESCOUT_NULL, es_backend_name(scene->backend, NULL));
  EXPECT(EDGESCOUT_NULL, es_camera_get(scene->camera, NULL));
  EXPECT(EDGESCOUT_NULL, es_picture_get(scene->picture, NULL));
  EXPECT(EDGESCOUT_NULL, es_picture_save_png(scene->picture, NULL));
  EXPECT(EDGESCOUT_NULL, es_mesh_get(scene->mesh, NULL));
  OK(es_mesh_copy(scene->mesh, NULL, NULL));
  EXPECT(EDGESCOUT_NULL, es_templates_save(scene->templates, NULL));
  EXPECT(EDGESCOUT_NULL, es_templates_count(scene->templates, NULL));
  EXPECT(EDGESCOUT_NULL, es_templates_at(scene->templates, 0, NULL));
  edgescout_options* options = NULL;
  OK(es_options_create(EDGESCOUT_DETECT_OPTIONS, &options));
  edgescout_option option = {.struct_size = sizeof option};
  EXPECT(EDGESCOUT_NULL, es_options_copy(options, NULL));
  EXPECT(EDGESCOUT_NULL, es_options_set(options, NULL, "1"));
  EXPECT(EDGESCOUT_NULL, es_options_set(options, "bins", NULL));
  EXPECT(EDGESCOUT_NULL, es_options_get(options, NULL, &option));
  EXPECT(EDGESCOUT_NULL, es_options_get(options, "bins", NULL));
  EXPECT(EDGESCOUT_NULL, es_options_count(options, NULL));
  EXPECT(EDGESCOUT_NULL, es_options_at(options, 0, NULL));
  OK(es_free(options));
}

static void expect_nulls_of_scouts(const struct scene* scene) {
  edgescout_scout_plan plan = example_plan(scene);
  EXPECT(EDGESCOUT_NULL, es_scout_create(&plan, NULL));
  plan.camera_from_world = NULL;
  edgescout_scout* scout = NULL;
  EXPECT(EDGESCOUT_NULL, es_scout_create(&plan, &scout));
  scout = example_scout(scene);
  EXPECT(EDGESCOUT_NULL, es_scout_propose(scout, NULL, NULL));
  EXPECT(EDGESCOUT_NULL, es_scout_expectation(scout, 0, NULL));
  EXPECT(EDGESCOUT_NULL, es_scout_give(scout, NULL));
  EXPECT(EDGESCOUT_NULL, es_scout_get(scout, NULL));
  EXPECT(EDGESCOUT_NULL, es_scout_detections(scout, NULL));
  EXPECT(EDGESCOUT_NULL, es_scout_save(scout, NULL));
  EXPECT(EDGESCOUT_NULL, es_scout_resume(scout, NULL, NULL));
  const edgescout_shot shot = {.struct_size = sizeof shot};
  EXPECT(EDGESCOUT_NULL, es_scout_give(scout, &shot));
  SAYS("image: found NULL");
  OK(es_free(scout));
}

void test_nulls(void) {
  expect_nulls_of_one_argument();
  struct scene scene;
  open_scene(&scene);
  expect_nulls_of_requests(&scene);
  expect_nulls_beside_handles(&scene);
  expect_nulls_of_scouts(&scene);
  close_scene(&scene);
}
