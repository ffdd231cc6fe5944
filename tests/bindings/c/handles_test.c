/* Handles that are null, freed, invented or of another kind are errors in every function. */
#include <stdint.h>
#include <stdio.h>

#include "tests/bindings/c/scene.h"

enum kind {
  CANCELLER,
  OPTIONS,
  BACKEND,
  CAMERA,
  PICTURE,
  MESH,
  TEMPLATES,
  DETECTIONS,
  SCOUT,
  TRACKER,
  KINDS
};

/* Set before calls of the functions below. */
static struct scene scene;
static edgescout_scout_plan plan;

/* Each calls a function with `h` in place of one handle, with all else as it should be. */
#define WITH(name) static edgescout_status name(void* h)

WITH(cancel) { return es_cancel(h); }
WITH(canceller_reset) { return es_canceller_reset(h); }
WITH(limit_canceller) {
  const edgescout_limit limit = {.struct_size = sizeof limit, .canceller = h};
  edgescout_request request = scene.request;
  request.limit = &limit;
  edgescout_detections* out;
  return es_detect(&request, &out);
}
WITH(options_copy) {
  edgescout_options* out;
  return es_options_copy(h, &out);
}
WITH(options_set) { return es_options_set(h, "min-probability", "0.5"); }
WITH(options_get) {
  edgescout_option out = {.struct_size = sizeof out};
  return es_options_get(h, "min-probability", &out);
}
WITH(options_count) {
  size_t out;
  return es_options_count(h, &out);
}
WITH(options_at) {
  edgescout_option out = {.struct_size = sizeof out};
  return es_options_at(h, 0, &out);
}
WITH(image_options) {
  edgescout_image image = scene.image;
  image.options = h;
  edgescout_picture* out;
  return es_picture_grey(&image, &out);
}
WITH(load_options) {
  edgescout_picture* out;
  return es_picture_load(EXAMPLE("scenes/000000/gray/000000.png"), h, &out);
}
WITH(request_options) {
  edgescout_request request = scene.request;
  request.options = h;
  edgescout_detections* out;
  return es_detect(&request, &out);
}
WITH(part_options) {
  edgescout_part part = {.struct_size = sizeof part, .mesh = scene.mesh};
  part.backend = scene.backend;
  part.options = h;
  edgescout_templates* out;
  return es_templates_build(&part, &out);
}
WITH(plan_options) {
  edgescout_scout_plan with = plan;
  with.options = h;
  edgescout_scout* out;
  return es_scout_create(&with, &out);
}
WITH(backend_name) {
  const char* out;
  return es_backend_name(h, &out);
}
WITH(request_backend) {
  edgescout_request request = scene.request;
  request.backend = h;
  edgescout_detections* out;
  return es_detect(&request, &out);
}
WITH(jointly_backend) {
  edgescout_request request = scene.request;
  request.backend = h;
  edgescout_detections* out;
  return es_detect_jointly(&request, &out);
}
WITH(register_backend) {
  edgescout_request request = scene.request;
  request.backend = h;
  const edgescout_starts starts = {.struct_size = sizeof starts};
  edgescout_detections* out;
  return es_register(&request, &starts, &out);
}
WITH(part_backend) {
  const edgescout_part part = {
      .struct_size = sizeof part, .mesh = scene.mesh, .backend = h, .camera = scene.camera};
  edgescout_templates* out;
  return es_templates_build(&part, &out);
}
WITH(plan_backend) {
  edgescout_scout_plan with = plan;
  with.backend = h;
  edgescout_scout* out;
  return es_scout_create(&with, &out);
}
WITH(camera_get) {
  edgescout_camera_model out = {.struct_size = sizeof out};
  return es_camera_get(h, &out);
}
WITH(undistorted_camera) {
  edgescout_picture* out;
  return es_picture_undistorted(&scene.image, h, &out);
}
WITH(view_camera) {
  edgescout_view view = scene.view;
  view.camera = h;
  edgescout_request request = scene.request;
  request.views = &view;
  edgescout_detections* out;
  return es_detect(&request, &out);
}
WITH(plan_camera) {
  edgescout_scout_plan with = plan;
  with.camera = h;
  edgescout_scout* out;
  return es_scout_create(&with, &out);
}
WITH(picture_get) {
  edgescout_image out = {.struct_size = sizeof out};
  return es_picture_get(h, &out);
}
WITH(picture_save) { return es_picture_save_png(h, "/dev/null/none.png"); }
WITH(mesh_get) {
  edgescout_mesh_info out = {.struct_size = sizeof out};
  return es_mesh_get(h, &out);
}
WITH(mesh_copy) { return es_mesh_copy(h, NULL, NULL); }
WITH(part_mesh) {
  const edgescout_part part = {
      .struct_size = sizeof part, .mesh = h, .backend = scene.backend, .camera = scene.camera};
  edgescout_templates* out;
  return es_templates_build(&part, &out);
}
WITH(templates_join) {
  const edgescout_templates* const parts[2] = {scene.templates, h};
  edgescout_templates* out;
  return es_templates_join(parts, 2, &out);
}
WITH(templates_save) { return es_templates_save(h, "/dev/null/none"); }
WITH(templates_count) {
  size_t out;
  return es_templates_count(h, &out);
}
WITH(templates_at) {
  edgescout_templates_info out = {.struct_size = sizeof out};
  return es_templates_at(h, 0, &out);
}
WITH(request_templates) {
  edgescout_request request = scene.request;
  request.templates = h;
  edgescout_detections* out;
  return es_detect(&request, &out);
}
WITH(plan_templates) {
  edgescout_scout_plan with = plan;
  with.templates = h;
  edgescout_scout* out;
  return es_scout_create(&with, &out);
}
WITH(detections_get) {
  edgescout_summary out = {.struct_size = sizeof out};
  return es_detections_get(h, &out);
}
WITH(detections_at) {
  edgescout_detection out = {.struct_size = sizeof out};
  return es_detections_at(h, 0, &out);
}
WITH(detections_alternative) {
  edgescout_alternative out = {.struct_size = sizeof out};
  return es_detections_alternative(h, 0, 0, &out);
}
WITH(detections_stage) {
  edgescout_stage out = {.struct_size = sizeof out};
  return es_detections_stage(h, 0, &out);
}
WITH(overlay) {
  edgescout_picture* out;
  return es_overlay(&scene.request, h, &out);
}
WITH(scout_propose) {
  edgescout_proposal out = {.struct_size = sizeof out};
  return es_scout_propose(h, NULL, &out);
}
WITH(scout_expectation) {
  edgescout_expectation out = {.struct_size = sizeof out};
  return es_scout_expectation(h, 0, &out);
}
WITH(scout_give) {
  const edgescout_shot shot = {.struct_size = sizeof shot, .image = &scene.image};
  return es_scout_give(h, &shot);
}
WITH(scout_unreachable) { return es_scout_unreachable(h, 0, "why"); }
WITH(scout_get) {
  edgescout_scout_state out = {.struct_size = sizeof out};
  return es_scout_get(h, &out);
}
WITH(scout_step) {
  edgescout_scout_step out = {.struct_size = sizeof out};
  return es_scout_step_at(h, 0, &out);
}
WITH(scout_detections) {
  edgescout_detections* out;
  return es_scout_detections(h, &out);
}
WITH(scout_save) { return es_scout_save(h, "/dev/null/none"); }
WITH(scout_resume) { return es_scout_resume(h, "/dev/null/none", NULL); }

static edgescout_tracker_plan plan_of_tracker(void) {
  return (edgescout_tracker_plan){.struct_size = sizeof(edgescout_tracker_plan),
                                  .templates = scene.templates,
                                  .camera = scene.camera,
                                  .backend = scene.backend};
}
static edgescout_status create_tracker(const edgescout_tracker_plan* with) {
  edgescout_tracker* out;
  return es_tracker_create(with, &out);
}
WITH(tracker_templates) {
  edgescout_tracker_plan with = plan_of_tracker();
  with.templates = h;
  return create_tracker(&with);
}
WITH(tracker_camera) {
  edgescout_tracker_plan with = plan_of_tracker();
  with.camera = h;
  return create_tracker(&with);
}
WITH(tracker_backend) {
  edgescout_tracker_plan with = plan_of_tracker();
  with.backend = h;
  return create_tracker(&with);
}
WITH(tracker_options) {
  edgescout_tracker_plan with = plan_of_tracker();
  with.options = h;
  return create_tracker(&with);
}
WITH(tracker_add) {
  const double pose[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1};
  int32_t id;
  return es_tracker_add(h, 0, pose, &id);
}
WITH(tracker_remove) { return es_tracker_remove(h, 1); }
WITH(tracker_update) {
  const edgescout_frame frame = {.struct_size = sizeof frame, .image = &scene.image};
  return es_tracker_update(h, &frame);
}
WITH(tracker_search) {
  const edgescout_search search = {
      .struct_size = sizeof search,
      .frame = {.struct_size = sizeof search.frame, .image = &scene.image},
      .backend = scene.backend};
  size_t found;
  return es_tracker_search(h, &search, &found);
}
WITH(tracker_count) {
  size_t out;
  return es_tracker_count(h, &out);
}
WITH(tracker_at) {
  edgescout_track out = {.struct_size = sizeof out};
  return es_tracker_at(h, 0, &out);
}

struct place {
  const char* name;
  enum kind kind;
  int may_be_null;
  edgescout_status (*call)(void* h);
};

static const struct place places[] = {
    {"cancel", CANCELLER, 0, cancel},
    {"canceller_reset", CANCELLER, 0, canceller_reset},
    {"limit.canceller", CANCELLER, 1, limit_canceller},
    {"options_copy", OPTIONS, 0, options_copy},
    {"options_set", OPTIONS, 0, options_set},
    {"options_get", OPTIONS, 0, options_get},
    {"options_count", OPTIONS, 0, options_count},
    {"options_at", OPTIONS, 0, options_at},
    {"image.options", OPTIONS, 1, image_options},
    {"picture_load's options", OPTIONS, 1, load_options},
    {"request.options", OPTIONS, 1, request_options},
    {"part.options", OPTIONS, 1, part_options},
    {"plan.options", OPTIONS, 1, plan_options},
    {"backend_name", BACKEND, 0, backend_name},
    {"request.backend", BACKEND, 0, request_backend},
    {"detect_jointly's backend", BACKEND, 0, jointly_backend},
    {"register's backend", BACKEND, 0, register_backend},
    {"part.backend", BACKEND, 0, part_backend},
    {"plan.backend", BACKEND, 0, plan_backend},
    {"camera_get", CAMERA, 0, camera_get},
    {"picture_undistorted's camera", CAMERA, 0, undistorted_camera},
    {"view.camera", CAMERA, 0, view_camera},
    {"plan.camera", CAMERA, 0, plan_camera},
    {"picture_get", PICTURE, 0, picture_get},
    {"picture_save_png", PICTURE, 0, picture_save},
    {"mesh_get", MESH, 0, mesh_get},
    {"mesh_copy", MESH, 0, mesh_copy},
    {"part.mesh", MESH, 0, part_mesh},
    {"templates_join", TEMPLATES, 0, templates_join},
    {"templates_save", TEMPLATES, 0, templates_save},
    {"templates_count", TEMPLATES, 0, templates_count},
    {"templates_at", TEMPLATES, 0, templates_at},
    {"request.templates", TEMPLATES, 0, request_templates},
    {"plan.templates", TEMPLATES, 0, plan_templates},
    {"detections_get", DETECTIONS, 0, detections_get},
    {"detections_at", DETECTIONS, 0, detections_at},
    {"detections_alternative", DETECTIONS, 0, detections_alternative},
    {"detections_stage", DETECTIONS, 0, detections_stage},
    {"overlay's detections", DETECTIONS, 0, overlay},
    {"scout_propose", SCOUT, 0, scout_propose},
    {"scout_expectation", SCOUT, 0, scout_expectation},
    {"scout_give", SCOUT, 0, scout_give},
    {"scout_unreachable", SCOUT, 0, scout_unreachable},
    {"scout_get", SCOUT, 0, scout_get},
    {"scout_step_at", SCOUT, 0, scout_step},
    {"scout_detections", SCOUT, 0, scout_detections},
    {"scout_save", SCOUT, 0, scout_save},
    {"scout_resume", SCOUT, 0, scout_resume},
    {"tracker's templates", TEMPLATES, 0, tracker_templates},
    {"tracker's camera", CAMERA, 0, tracker_camera},
    {"tracker's backend", BACKEND, 0, tracker_backend},
    {"tracker's options", OPTIONS, 1, tracker_options},
    {"tracker_add", TRACKER, 0, tracker_add},
    {"tracker_remove", TRACKER, 0, tracker_remove},
    {"tracker_update", TRACKER, 0, tracker_update},
    {"tracker_search", TRACKER, 0, tracker_search},
    {"tracker_count", TRACKER, 0, tracker_count},
    {"tracker_at", TRACKER, 0, tracker_at}};

static void expect(edgescout_status expected, const struct place* place, void* handle) {
  const edgescout_status found = place->call(handle);
  if (found != expected)
    fprintf(stderr, "%s with %p: found %s (%s), expected %s\n", place->name, handle,
            es_status_name(found), es_last_error(), es_status_name(expected));
  CHECK(found == expected);
}

static edgescout_detections* no_detections(void) {
  const edgescout_limit limit = {.struct_size = sizeof limit, .max_seconds = 1e-9};
  edgescout_request request = scene.request;
  request.limit = &limit;
  edgescout_detections* out = NULL;
  OK(es_detect(&request, &out));
  return out;
}

static uint64_t random_state = 1;
static uint64_t random_number(void) { /* splitmix64 */
  uint64_t z = random_state += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

static void expect_invented_ones_refused(const struct place* place, void* freed) {
  int on_the_stack = 0;
  expect(EDGESCOUT_BAD_HANDLE, place, freed);
  SAYS("a handle that was freed");
  void* const invented[] = {(void*)(uintptr_t)1, (void*)(uintptr_t)4096, &on_the_stack,
                            (void*)UINTPTR_MAX, (void*)((uintptr_t)freed + 100000)};
  for (size_t i = 0; i < sizeof invented / sizeof *invented; ++i) {
    expect(EDGESCOUT_BAD_HANDLE, place, invented[i]);
    SAYS("a handle that this library never made");
  }
}

static void expect_random_ones_refused(void) {
  for (int i = 0; i < 100000; ++i) {
    void* const handle = (void*)(uintptr_t)random_number();
    edgescout_mesh_info out = {.struct_size = sizeof out};
    EXPECT(EDGESCOUT_BAD_HANDLE, es_mesh_get(handle, &out));
    EXPECT(EDGESCOUT_BAD_HANDLE, es_free(handle));
  }
}

void test_handles(void) {
  open_scene(&scene);
  plan = example_plan(&scene);
  void* live[KINDS];
  OK(es_canceller_create((edgescout_canceller**)&live[CANCELLER]));
  OK(es_options_create(EDGESCOUT_DETECT_OPTIONS, (edgescout_options**)&live[OPTIONS]));
  live[BACKEND] = scene.backend;
  live[CAMERA] = scene.camera;
  live[PICTURE] = scene.picture;
  live[MESH] = scene.mesh;
  live[TEMPLATES] = scene.templates;
  live[DETECTIONS] = no_detections();
  live[SCOUT] = example_scout(&scene);
  live[TRACKER] = example_tracker(&scene);
  edgescout_camera* const freed = camera_of(part_window);
  OK(es_free(freed));
  EXPECT(EDGESCOUT_BAD_HANDLE, es_free(freed));
  SAYS("handle: found a handle that was freed");
  OK(es_free(NULL));

  const size_t count = es_handle_count();
  for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
    const struct place* const place = &places[i];
    if (!place->may_be_null) {
      expect(EDGESCOUT_NULL, place, NULL);
      SAYS("found NULL, expected one of kind");
    }
    expect_invented_ones_refused(place, freed);
    for (int kind = 0; kind < KINDS; ++kind)
      if (kind != (int)place->kind) {
        expect(EDGESCOUT_WRONG_KIND, place, live[kind]);
        SAYS("found a handle of kind ");
      }
  }
  CHECK(es_handle_count() == count); /* nothing was made on the way */
  expect_random_ones_refused();

  OK(es_free(live[CANCELLER]));
  OK(es_free(live[OPTIONS]));
  OK(es_free(live[DETECTIONS]));
  OK(es_free(live[SCOUT]));
  OK(es_free(live[TRACKER]));
  close_scene(&scene);
}
