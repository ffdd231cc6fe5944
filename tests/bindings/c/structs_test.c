/* Structs of another header: struct_size tells them apart. */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bindings/c/scene.h"

static struct scene scene;
static edgescout_detections* detections;
static edgescout_options* options;
static edgescout_scout* scout;
static edgescout_tracker* tracker;

/* Each calls a function with `s` in place of one struct. */
#define WITH(name) static edgescout_status name(void* s)

WITH(limit) {
  edgescout_request request = scene.request;
  request.limit = s;
  edgescout_detections* out;
  const edgescout_status status = es_detect(&request, &out);
  es_free(out);
  return status;
}
WITH(option) { return es_options_at(options, 0, s); }
WITH(camera_model) {
  edgescout_camera* out;
  const edgescout_status status = es_camera_create(s, &out);
  es_free(out);
  return status;
}
WITH(camera_model_out) { return es_camera_get(scene.camera, s); }
WITH(image) {
  edgescout_picture* out;
  const edgescout_status status = es_picture_grey(s, &out);
  es_free(out);
  return status;
}
WITH(image_out) { return es_picture_get(scene.picture, s); }
WITH(mesh_info) { return es_mesh_get(scene.mesh, s); }
WITH(mesh_arrays) {
  edgescout_mesh* out;
  const edgescout_status status = es_mesh_create(s, &out);
  es_free(out);
  return status;
}
WITH(part) {
  edgescout_templates* out;
  const edgescout_status status = es_templates_build(s, &out);
  es_free(out);
  return status;
}
WITH(templates_info) { return es_templates_at(scene.templates, 0, s); }
WITH(view) {
  edgescout_request request = scene.request;
  request.views = s;
  edgescout_picture* out;
  const edgescout_status status = es_overlay(&request, detections, &out);
  es_free(out);
  return status;
}
WITH(request) {
  edgescout_picture* out;
  const edgescout_status status = es_overlay(s, detections, &out);
  es_free(out);
  return status;
}
WITH(starts) {
  edgescout_request plain = scene.request;
  plain.options = NULL;
  edgescout_detections* out;
  const edgescout_status status = es_register(&plain, s, &out);
  es_free(out);
  return status;
}
WITH(detection) { return es_detections_at(detections, 0, s); }
WITH(stage) { return es_detections_stage(detections, 0, s); }
WITH(summary) { return es_detections_get(detections, s); }
WITH(plan) {
  edgescout_scout* out;
  const edgescout_status status = es_scout_create(s, &out);
  es_free(out);
  return status;
}
WITH(proposal) { return es_scout_propose(scout, NULL, s); }
WITH(expectation) { return es_scout_expectation(scout, 0, s); }
WITH(state) { return es_scout_get(scout, s); }
/* Read, and then refused: its view does not exist. */
WITH(shot) {
  const edgescout_status status = es_scout_give(scout, s);
  return status == EDGESCOUT_BAD_INPUT ? EDGESCOUT_OK : status;
}
WITH(tracker_plan) {
  edgescout_tracker* out;
  const edgescout_status status = es_tracker_create(s, &out);
  es_free(out);
  return status;
}
WITH(frame) {
  edgescout_tracker* const own = example_tracker(&scene);
  const edgescout_status status = es_tracker_update(own, s);
  OK(es_free(own));
  return status;
}
WITH(search) {
  size_t found;
  return es_tracker_search(tracker, s, &found);
}
WITH(track) { return es_tracker_at(tracker, 0, s); }
WITH(hemisphere) {
  size_t count;
  return es_hemisphere_views(s, NULL, 0, &count);
}

/* A block of its own of so many bytes: one byte too far is found by what watches memory. */
static void* block_of(const void* content, size_t content_size, size_t size) {
  unsigned char* const block = calloc(1, size);
  memcpy(block, content, content_size < size ? content_size : size);
  memcpy(block, &size, sizeof size);
  return block;
}

/* Of a size that this version does not know only the size itself is read. */
static void expect_wrong_size(edgescout_status (*call)(void*), size_t stated) {
  size_t* const block = malloc(sizeof stated);
  *block = stated;
  EXPECT(EDGESCOUT_WRONG_VERSION, call(block));
  SAYS("struct_size: found ");
  CHECK(*block == stated);
  free(block);
}

/* `is_filled`: by the library. */
static void expect_versions(const char* name, edgescout_status (*call)(void*), const void* valid,
                            size_t size, int is_filled) {
  const int failed_before = checks_failed;
  const size_t wrong[] = {0, 1, 7, size - 1, SIZE_MAX, (size_t)1 << 40, 65537};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) expect_wrong_size(call, wrong[i]);
  const size_t larger = size + 24;
  unsigned char* block = block_of(valid, size, larger);
  OK(call(block));
  free(block);
  block = block_of(valid, size, larger);
  memset(block + size, 0xaa, larger - size);
  if (is_filled) {
    OK(call(block));
    for (size_t i = size; i < larger; ++i) CHECK(block[i] == 0);
    CHECK(memcmp(block, &larger, sizeof larger) == 0);
  } else {
    EXPECT(EDGESCOUT_WRONG_VERSION, call(block));
    SAYS("found fields that version ");
  }
  free(block);
  block = block_of(valid, size, size);
  OK(call(block));
  free(block);
  if (checks_failed != failed_before) fprintf(stderr, "  of %s\n", name);
}

#define READ(name, valid) expect_versions(#name, name, &(valid), sizeof(valid), 0)
#define FILLED(name, type)                                 \
  {                                                        \
    const type empty = {.struct_size = sizeof empty};      \
    expect_versions(#name, name, &empty, sizeof empty, 1); \
  }

static void expect_versions_of_filled(void) {
  FILLED(option, edgescout_option)
  FILLED(camera_model_out, edgescout_camera_model)
  FILLED(image_out, edgescout_image)
  FILLED(mesh_info, edgescout_mesh_info)
  FILLED(templates_info, edgescout_templates_info)
  FILLED(detection, edgescout_detection)
  FILLED(stage, edgescout_stage)
  FILLED(summary, edgescout_summary)
  FILLED(proposal, edgescout_proposal)
  FILLED(expectation, edgescout_expectation)
  FILLED(state, edgescout_scout_state)
  FILLED(track, edgescout_track)
}

static void expect_versions_of_tracking(const edgescout_limit* soon) {
  const edgescout_tracker_plan tracking = {.struct_size = sizeof tracking,
                                           .templates = scene.templates,
                                           .camera = scene.camera,
                                           .backend = scene.backend};
  READ(tracker_plan, tracking);
  const edgescout_frame next = {.struct_size = sizeof next, .image = &scene.image, .time_s = 1};
  READ(frame, next);
  const edgescout_search brief = {sizeof brief, next, scene.backend, soon};
  READ(search, brief);
}

static void expect_versions_of_read(void) {
  const edgescout_limit soon = {.struct_size = sizeof soon, .max_seconds = 1e-9};
  READ(limit, soon);
  edgescout_camera_model model = {.struct_size = sizeof model};
  OK(es_camera_get(scene.camera, &model));
  READ(camera_model, model);
  READ(image, scene.image);
  const double vertices_m[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const int32_t triangles[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const edgescout_mesh_arrays arrays = {sizeof arrays, "pyramid", vertices_m, 4, triangles, 4};
  READ(mesh_arrays, arrays);
  edgescout_options* one_template = NULL;
  OK(es_options_create(EDGESCOUT_TEMPLATE_OPTIONS, &one_template));
  OK(es_options_set(one_template, "viewpoints", "1"));
  const edgescout_part what = {.struct_size = sizeof what,
                               .mesh = scene.mesh,
                               .backend = scene.backend,
                               .options = one_template,
                               .camera = scene.camera};
  READ(part, what);
  OK(es_free(one_template));
  READ(view, scene.view);
  READ(request, scene.request);
  const edgescout_starts no_starts = {.struct_size = sizeof no_starts};
  READ(starts, no_starts);
  const edgescout_scout_plan valid_plan = example_plan(&scene);
  READ(plan, valid_plan);
  const edgescout_shot of_no_view = {.struct_size = sizeof of_no_view, .view = 99};
  READ(shot, of_no_view);
  expect_versions_of_tracking(&soon);
  const edgescout_hemisphere rings = {.struct_size = sizeof rings, .radius_m = 1, .count = 8};
  READ(hemisphere, rings);
}

/* Views of a newer header, one after the other. */
static void expect_arrays_of_larger_structs(void) {
  struct newer_view {
    edgescout_view view;
    size_t more;
  } two[2] = {{scene.view, 0}, {scene.view, 0}};
  const double same[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  for (int i = 0; i < 2; ++i) {
    two[i].view.struct_size = sizeof *two;
    two[i].view.camera_from_world = same;
  }
  const edgescout_limit soon = {.struct_size = sizeof soon, .max_seconds = 1e-9};
  edgescout_request both = scene.request;
  both.views = &two[0].view;
  both.view_count = 2;
  both.limit = &soon;
  edgescout_detections* out = NULL;
  OK(es_detect_jointly(&both, &out));
  OK(es_free(out));
  two[1].view.struct_size = sizeof two[1].view;
  EXPECT(EDGESCOUT_WRONG_VERSION, es_detect_jointly(&both, &out));
  SAYS("expected that of the first");
}

/* Fields that have no meaning yet. */
static void expect_zero_in_reserved(void) {
  edgescout_camera_model model = {.struct_size = sizeof model};
  OK(es_camera_get(scene.camera, &model));
  OK(camera_model(&model));
  model.reserved = 1;
  EXPECT(EDGESCOUT_WRONG_VERSION, camera_model(&model));
  SAYS("model.reserved: found 1, expected 0");
  edgescout_image marked = scene.image;
  marked.reserved = -7;
  EXPECT(EDGESCOUT_WRONG_VERSION, image(&marked));
  SAYS("image.reserved: found -7, expected 0");
}

/* A change of these breaks programs that were compiled before: EDGESCOUT_ABI must then change. */
static void expect_the_layout_of_this_abi(void) {
  CHECK(EDGESCOUT_ABI == 0);
  CHECK(sizeof(edgescout_limit) == 40 && sizeof(edgescout_option) == 88);
  CHECK(sizeof(edgescout_device) == 536 && sizeof(edgescout_camera_model) == 184);
  CHECK(sizeof(edgescout_image) == 48 && sizeof(edgescout_mesh_info) == 88);
  CHECK(sizeof(edgescout_mesh_arrays) == 48 && sizeof(edgescout_part) == 88);
  CHECK(sizeof(edgescout_templates_info) == 56 && sizeof(edgescout_view) == 56);
  CHECK(sizeof(edgescout_request) == 56 && sizeof(edgescout_starts) == 32);
  CHECK(sizeof(edgescout_detection) == 520 && sizeof(edgescout_alternative) == 144);
  CHECK(sizeof(edgescout_stage) == 24 && sizeof(edgescout_summary) == 32);
  CHECK(sizeof(edgescout_scout_plan) == 72 && sizeof(edgescout_proposal) == 144);
  CHECK(sizeof(edgescout_expectation) == 48 && sizeof(edgescout_shot) == 64);
  CHECK(sizeof(edgescout_scout_state) == 64 && sizeof(edgescout_scout_step) == 168);
  CHECK(sizeof(edgescout_hemisphere) == 56 && sizeof(edgescout_tracker_plan) == 40);
  CHECK(sizeof(edgescout_frame) == 56 && sizeof(edgescout_search) == 80);
  CHECK(sizeof(edgescout_track) == 448);
}

/* A program of the first header: its views end before `depth`. */
static void expect_views_without_depth(void) {
  CHECK(offsetof(edgescout_view, depth) == 32);
  void* const first = block_of(&scene.view, sizeof scene.view, offsetof(edgescout_view, depth));
  OK(view(first));
  free(first);
}

void test_structs(void) {
  expect_the_layout_of_this_abi();
  open_scene(&scene);
  OK(es_options_create(EDGESCOUT_DETECT_OPTIONS, &options));
  const double start[16] = {1, 0, 0, -0.11, 0, 1, 0, 0.01, 0, 0, 1, 0.33, 0, 0, 0, 1};
  const edgescout_starts one = {.struct_size = sizeof one, .world_from_object = start, .count = 1};
  edgescout_request plain = scene.request;
  plain.options = NULL;
  OK(es_register(&plain, &one, &detections));
  scout = example_scout(&scene);
  tracker = example_tracker(&scene);
  const edgescout_frame frame_0 = {.struct_size = sizeof frame_0, .image = &scene.image};
  int32_t id;
  OK(es_tracker_add(tracker, 0, start, &id));
  OK(es_tracker_update(tracker, &frame_0));
  expect_versions_of_filled();
  expect_versions_of_read();
  expect_arrays_of_larger_structs();
  expect_zero_in_reserved();
  expect_views_without_depth();
  OK(es_free(tracker));
  OK(es_free(scout));
  OK(es_free(detections));
  OK(es_free(options));
  close_scene(&scene);
}
