/* Deadlines, cancellation, calls that use a handle at once, and memory. */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "tests/bindings/c/scene.h"

static int32_t completion_of(const edgescout_detections* detections) {
  edgescout_summary summary = {.struct_size = sizeof summary};
  OK(es_detections_get(detections, &summary));
  return summary.completion;
}

static int32_t completion_within(const struct scene* scene, const edgescout_limit* limit) {
  edgescout_request request = scene->request;
  request.limit = limit;
  edgescout_detections* detections = NULL;
  OK(es_detect(&request, &detections));
  const int32_t completion = completion_of(detections);
  OK(es_free(detections));
  return completion;
}

struct asked {
  int count, answer_after;
};

/* Answers once: the library must remember it. */
static int32_t cancels_once(void* user) {
  struct asked* const asked = user;
  return ++asked->count == asked->answer_after;
}

static void expect_limits_of_detection(const struct scene* scene) {
  edgescout_limit limit = {.struct_size = sizeof limit};
  CHECK(completion_within(scene, &limit) == EDGESCOUT_COMPLETE);
  limit.max_seconds = 1e-9;
  CHECK(completion_within(scene, &limit) == EDGESCOUT_DEADLINE_PASSED);
  limit.max_seconds = INFINITY;
  CHECK(completion_within(scene, &limit) == EDGESCOUT_COMPLETE);
  edgescout_request request = scene->request;
  request.limit = &limit;
  edgescout_detections* none = NULL;
  limit.max_seconds = NAN;
  EXPECT(EDGESCOUT_BAD_INPUT, es_detect(&request, &none));
  SAYS("limit.max_seconds: found ");
  limit.max_seconds = -1;
  EXPECT(EDGESCOUT_BAD_INPUT, es_detect(&request, &none));

  limit.max_seconds = 0;
  struct asked asked = {0, 3};
  limit.cancelled = cancels_once;
  limit.user = &asked;
  CHECK(completion_within(scene, &limit) == EDGESCOUT_WAS_CANCELLED);
  CHECK(asked.count == 3);

  edgescout_canceller* canceller = NULL;
  OK(es_canceller_create(&canceller));
  limit.cancelled = NULL;
  limit.canceller = canceller;
  OK(es_cancel(canceller));
  CHECK(completion_within(scene, &limit) == EDGESCOUT_WAS_CANCELLED);
  OK(es_canceller_reset(canceller));
  CHECK(completion_within(scene, &limit) == EDGESCOUT_COMPLETE);
  OK(es_free(canceller));
}

static void expect_limits_of_others(const struct scene* scene) {
  const edgescout_limit over = {.struct_size = sizeof over, .max_seconds = 1e-9};
  edgescout_part part = {.struct_size = sizeof part,
                         .mesh = scene->mesh,
                         .backend = scene->backend,
                         .camera = scene->camera,
                         .limit = &over};
  edgescout_templates* templates = NULL;
  EXPECT(EDGESCOUT_CANCELLED, es_templates_build(&part, &templates));
  CHECK(templates == NULL);
  edgescout_request request = scene->request;
  request.limit = &over;
  request.options = NULL;
  const double start[16] = {1, 0, 0, -0.11, 0, 1, 0, 0.01, 0, 0, 1, 0.33, 0, 0, 0, 1};
  const edgescout_starts one = {.struct_size = sizeof one, .world_from_object = start, .count = 1};
  edgescout_detections* detections = NULL;
  OK(es_register(&request, &one, &detections));
  CHECK(completion_of(detections) == EDGESCOUT_DEADLINE_PASSED);
  OK(es_free(detections));
  request.options = scene->detect_options;
  OK(es_detect_jointly(&request, &detections));
  CHECK(completion_of(detections) == EDGESCOUT_DEADLINE_PASSED);
  OK(es_free(detections));
  edgescout_scout* const scout = example_scout(scene);
  edgescout_image image;
  edgescout_picture* const picture = picture_of_view(0, &image);
  const edgescout_shot shot = {.struct_size = sizeof shot, .image = &image, .limit = &over};
  EXPECT(EDGESCOUT_CANCELLED, es_scout_give(scout, &shot));
  SAYS("the limit of the call was over");
  edgescout_scout_state state = {.struct_size = sizeof state};
  OK(es_scout_get(scout, &state));
  CHECK(state.image_count == 0); /* as it was */
  OK(es_free(picture));
  OK(es_free(scout));
}

void test_limits(void) {
  struct scene scene;
  open_scene(&scene);
  expect_limits_of_detection(&scene);
  expect_limits_of_others(&scene);
  close_scene(&scene);
}

/* ---- Handles in use ---- */

struct meeting {
  struct scene* scene;
  edgescout_scout* scout;
  pthread_barrier_t inside, done;
  int have_met;
};

/* Waits inside the call until the other thread has tried its own; then cancels. */
static int32_t meet(void* user) {
  struct meeting* const meeting = user;
  if (meeting->have_met) return 1;
  meeting->have_met = 1;
  /* From a callback, too. */
  EXPECT(EDGESCOUT_BUSY, es_free(meeting->scene->backend));
  pthread_barrier_wait(&meeting->inside);
  pthread_barrier_wait(&meeting->done);
  return 1;
}

static void* detect_slowly(void* user) {
  struct meeting* const meeting = user;
  const edgescout_limit limit = {.struct_size = sizeof limit, .cancelled = meet, .user = meeting};
  CHECK(completion_within(meeting->scene, &limit) == EDGESCOUT_WAS_CANCELLED);
  return NULL;
}

static void* scout_slowly(void* user) {
  struct meeting* const meeting = user;
  const edgescout_limit limit = {.struct_size = sizeof limit, .cancelled = meet, .user = meeting};
  edgescout_image image;
  edgescout_picture* const picture = picture_of_view(0, &image);
  const edgescout_shot shot = {.struct_size = sizeof shot, .image = &image, .limit = &limit};
  EXPECT(EDGESCOUT_CANCELLED, es_scout_give(meeting->scout, &shot));
  OK(es_free(picture));
  return NULL;
}

static void expect_a_busy_backend(struct meeting* meeting) {
  const struct scene* const scene = meeting->scene;
  edgescout_detections* out = NULL;
  EXPECT(EDGESCOUT_BUSY, es_detect(&scene->request, &out));
  SAYS("backend: found one that another call uses, expected one call at a time");
  EXPECT(EDGESCOUT_BUSY, es_detect_jointly(&scene->request, &out));
  const edgescout_starts starts = {.struct_size = sizeof starts};
  EXPECT(EDGESCOUT_BUSY, es_register(&scene->request, &starts, &out));
  edgescout_proposal proposal = {.struct_size = sizeof proposal};
  EXPECT(EDGESCOUT_BUSY, es_scout_propose(meeting->scout, NULL, &proposal));
  EXPECT(EDGESCOUT_BUSY, es_free(scene->backend));
  const char* name = NULL;
  OK(es_backend_name(scene->backend, &name)); /* never busy */
  /* What never changes may be used and freed. */
  edgescout_templates_info info = {.struct_size = sizeof info};
  OK(es_templates_at(scene->templates, 0, &info));
}

static void expect_a_busy_scout(const struct meeting* meeting) {
  edgescout_scout_state state = {.struct_size = sizeof state};
  EXPECT(EDGESCOUT_BUSY, es_scout_get(meeting->scout, &state));
  SAYS("scout: found one that another call uses");
  edgescout_detections* out = NULL;
  EXPECT(EDGESCOUT_BUSY, es_scout_detections(meeting->scout, &out));
  EXPECT(EDGESCOUT_BUSY, es_scout_unreachable(meeting->scout, 0, NULL));
  EXPECT(EDGESCOUT_BUSY, es_scout_save(meeting->scout, "none"));
  EXPECT(EDGESCOUT_BUSY, es_free(meeting->scout));
  EXPECT(EDGESCOUT_BUSY, es_detect(&meeting->scene->request, &out)); /* the scout's backend */
}

static void start_meeting(struct meeting* meeting, void* (*work)(void*), pthread_t* thread) {
  pthread_barrier_init(&meeting->inside, NULL, 2);
  pthread_barrier_init(&meeting->done, NULL, 2);
  meeting->have_met = 0;
  CHECK(pthread_create(thread, NULL, work, meeting) == 0);
  pthread_barrier_wait(&meeting->inside);
}

static void end_meeting(struct meeting* meeting, pthread_t thread) {
  pthread_barrier_wait(&meeting->done);
  pthread_join(thread, NULL);
  pthread_barrier_destroy(&meeting->inside);
  pthread_barrier_destroy(&meeting->done);
}

/* Many threads share templates and options, each with a backend of its own. */
struct sharing {
  const struct scene* scene;
  int rounds;
};
static void* share(void* user) {
  const struct sharing* const sharing = user;
  edgescout_backend* backend = NULL;
  OK(es_backend_create("cpu", 1, &backend));
  for (int i = 0; i < sharing->rounds; ++i) {
    edgescout_request request = sharing->scene->request;
    request.backend = backend;
    const edgescout_limit limit = {.struct_size = sizeof limit, .max_seconds = 0.02};
    request.limit = &limit;
    edgescout_detections* out = NULL;
    OK(es_detect(&request, &out));
    OK(es_free(out));
  }
  OK(es_free(backend));
  return NULL;
}

void test_busy(void) {
  struct scene scene;
  open_scene(&scene);
  struct meeting meeting = {.scene = &scene, .scout = example_scout(&scene)};
  pthread_t thread;
  start_meeting(&meeting, detect_slowly, &thread);
  expect_a_busy_backend(&meeting);
  end_meeting(&meeting, thread);
  start_meeting(&meeting, scout_slowly, &thread);
  expect_a_busy_scout(&meeting);
  end_meeting(&meeting, thread);

  /* Templates that are freed while a call uses them live until it ends. */
  start_meeting(&meeting, detect_slowly, &thread);
  OK(es_free(scene.templates));
  OK(es_free(scene.camera));
  end_meeting(&meeting, thread);
  edgescout_detections* out = NULL;
  EXPECT(EDGESCOUT_BAD_HANDLE, es_detect(&scene.request, &out));
  scene.camera = camera_of(part_window);
  scene.view.camera = scene.camera;
  scene.templates = templates_of_part(1, "0.34", "0.34", "1", scene.backend);
  scene.request.templates = scene.templates;

  struct sharing sharing = {&scene, 3};
  pthread_t threads[4];
  for (int i = 0; i < 4; ++i) pthread_create(&threads[i], NULL, share, &sharing);
  for (int i = 0; i < 4; ++i) pthread_join(threads[i], NULL);
  OK(es_free(meeting.scout));
  close_scene(&scene);
}

/* ---- Memory ---- */

static long resident_pages(void) {
  long all = 0, resident = 0;
  FILE* const file = fopen("/proc/self/statm", "r");
  if (!file) return 0;
  if (fscanf(file, "%ld %ld", &all, &resident) != 2) resident = 0;
  fclose(file);
  return resident;
}

static void detect_once(const struct scene* scene) {
  edgescout_options* const options = quick_options(EDGESCOUT_DETECT_OPTIONS);
  edgescout_request request = scene->request;
  request.options = options;
  edgescout_detections* detections = NULL;
  OK(es_detect(&request, &detections));
  OK(es_free(options));
  edgescout_picture* picture = NULL;
  OK(es_overlay(&scene->request, detections, &picture));
  OK(es_free(picture));
  OK(es_free(detections));
  EXPECT(EDGESCOUT_BAD_HANDLE, es_free(detections));
}

void test_memory(void) {
  struct scene scene;
  open_scene(&scene);
  const size_t handles = es_handle_count();
  for (int i = 0; i < 4; ++i) detect_once(&scene);
  const long before = resident_pages();
  for (int i = 0; i < 12; ++i) detect_once(&scene);
  const long grown_kib = 4 * (resident_pages() - before);
  CHECK(es_handle_count() == handles);
  if (!UNDER_SANITIZER) CHECK(grown_kib < 4096);
  for (int i = 0; i < 20000; ++i) OK(es_free(camera_of(part_window)));
  if (!UNDER_SANITIZER) CHECK(4 * (resident_pages() - before) < 8192);
  close_scene(&scene);
}
