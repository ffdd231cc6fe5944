/* The tracker: a part that stands still, found, hidden and lost. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "tests/bindings/c/scene.h"

enum { WIDTH = 200, HEIGHT = 210 }; /* of part_window */

static const double near_pose[16] = {-0.6, 0.7, -0.3, -0.1139, 0.6, 0.7, 0.4, 0.0128,
                                     0.5,  0.1, -0.9, 0.3355,  0,   0,   0,   1};

edgescout_tracker* example_tracker(const struct scene* scene) {
  const edgescout_tracker_plan plan = {.struct_size = sizeof plan,
                                       .templates = scene->templates,
                                       .camera = scene->camera,
                                       .backend = scene->backend};
  edgescout_tracker* tracker = NULL;
  OK(es_tracker_create(&plan, &tracker));
  return tracker;
}

static edgescout_track track_of(const edgescout_tracker* tracker) {
  size_t count = 0;
  OK(es_tracker_count(tracker, &count));
  CHECK(count == 1);
  edgescout_track track = {.struct_size = sizeof track};
  OK(es_tracker_at(tracker, 0, &track));
  return track;
}

static void update(edgescout_tracker* tracker, const edgescout_image* image, double time_s) {
  const edgescout_frame frame = {.struct_size = sizeof frame, .image = image, .time_s = time_s};
  OK(es_tracker_update(tracker, &frame));
}

/* The part is found by the search, joins at the next update and is followed. */
static void expect_it_follows(const struct scene* scene, edgescout_tracker* tracker) {
  edgescout_detections* detections = NULL;
  OK(es_detect(&scene->request, &detections));
  edgescout_detection best = {.struct_size = sizeof best};
  OK(es_detections_at(detections, 0, &best));
  int32_t id = 0;
  OK(es_tracker_add(tracker, 0, best.world_from_object, &id));
  CHECK(id == 1);
  for (int i = 1; i <= 3; ++i) update(tracker, &scene->image, i / 30.0);
  const edgescout_track track = track_of(tracker);
  CHECK(track.id == 1 && track.object == 0 && track.state == EDGESCOUT_TRACKED);
  CHECK(track.above_chance > 0.5 && track.covariance[0] > 0 && track.covariance[0] < 1e-4);
  for (int i = 3; i < 12; i += 4)
    CHECK(fabs(track.camera_from_object[i] - best.world_from_object[i]) < 0.003);
  OK(es_free(detections));
}

static void expect_refusals(const struct scene* scene, edgescout_tracker* tracker) {
  edgescout_frame frame = {.struct_size = sizeof frame, .image = &scene->image, .time_s = 0.05};
  EXPECT(EDGESCOUT_BAD_INPUT, es_tracker_update(tracker, &frame)); /* not later */
  frame.time_s = 1;
  edgescout_image image = scene->image;
  image.width = 100;
  frame.image = &image;
  EXPECT(EDGESCOUT_BAD_INPUT, es_tracker_update(tracker, &frame));
  frame.image = NULL;
  EXPECT(EDGESCOUT_NULL, es_tracker_update(tracker, &frame));
  EXPECT(EDGESCOUT_NULL, es_tracker_update(tracker, NULL));
  int32_t id = 0;
  EXPECT(EDGESCOUT_BAD_INPUT, es_tracker_add(tracker, 1, near_pose, &id));
  SAYS("object: found 1, expected one of 1 parts");
  EXPECT(EDGESCOUT_NULL, es_tracker_add(tracker, 0, NULL, &id));
  EXPECT(EDGESCOUT_NULL, es_tracker_add(tracker, 0, near_pose, NULL));
  EXPECT(EDGESCOUT_BAD_INPUT, es_tracker_remove(tracker, 7));
  SAYS("id: found 7");
  edgescout_track track = {.struct_size = sizeof track};
  EXPECT(EDGESCOUT_BAD_INPUT, es_tracker_at(tracker, 1, &track));
  EXPECT(EDGESCOUT_NULL, es_tracker_at(tracker, 0, NULL));
  EXPECT(EDGESCOUT_NULL, es_tracker_count(tracker, NULL));
  EXPECT(EDGESCOUT_NULL, es_tracker_search(tracker, NULL, NULL));
}

/* A search whose limit is over finds nothing; the whole one what was forgotten. */
static void expect_it_searches(const struct scene* scene, edgescout_tracker* tracker) {
  OK(es_tracker_remove(tracker, 1));
  update(tracker, &scene->image, 1.1);
  size_t count = 1;
  OK(es_tracker_count(tracker, &count));
  CHECK(count == 0);
  const edgescout_limit over = {.struct_size = sizeof over, .max_seconds = 1e-9};
  edgescout_search search = {.struct_size = sizeof search, .backend = scene->backend};
  search.frame =
      (edgescout_frame){.struct_size = sizeof search.frame, .image = &scene->image, .time_s = 1.1};
  search.limit = &over;
  size_t found = 7;
  OK(es_tracker_search(tracker, &search, &found));
  CHECK(found == 0);
  search.limit = NULL;
  OK(es_tracker_search(tracker, &search, &found));
  CHECK(found == 1);
  update(tracker, &scene->image, 1.2);
  CHECK(track_of(tracker).id == 2 && track_of(tracker).state == EDGESCOUT_TRACKED);
}

/* The part after an image with the same distance everywhere, followed from its pose. */
static edgescout_track track_before_wall(const struct scene* scene, const double pose[16],
                                         uint16_t wall_mm, const edgescout_camera* depth_camera) {
  static uint16_t values[WIDTH * HEIGHT];
  for (int i = 0; i < WIDTH * HEIGHT; ++i) values[i] = wall_mm;
  const edgescout_image depth = {.struct_size = sizeof depth,
                                 .pixels = values,
                                 .width = WIDTH,
                                 .height = HEIGHT,
                                 .format = EDGESCOUT_MONO16};
  edgescout_tracker* tracker = example_tracker(scene);
  int32_t id = 0;
  OK(es_tracker_add(tracker, 0, pose, &id));
  const edgescout_frame frame = {.struct_size = sizeof frame,
                                 .image = &scene->image,
                                 .time_s = 1,
                                 .depth = &depth,
                                 .depth_camera = depth_camera};
  OK(es_tracker_update(tracker, &frame));
  const edgescout_track track = track_of(tracker);
  OK(es_free(tracker));
  return track;
}

/* The part lies some 0.33 m away. */
static void expect_depth_to_count(const struct scene* scene, const double pose[16]) {
  const edgescout_track grey = track_before_wall(scene, pose, 0, NULL);
  CHECK(grey.state == EDGESCOUT_TRACKED);
  CHECK(track_before_wall(scene, pose, 800, NULL).state == EDGESCOUT_DOUBTFUL);
  const edgescout_track beside = track_before_wall(scene, pose, 0, scene->camera);
  CHECK(memcmp(beside.camera_from_object, grey.camera_from_object,
               sizeof grey.camera_from_object) == 0);
  CHECK(track_before_wall(scene, pose, 800, scene->camera).state == EDGESCOUT_DOUBTFUL);
}

static void expect_refusals_of_depth(const struct scene* scene, edgescout_tracker* tracker) {
  edgescout_image depth = scene->image;
  edgescout_frame frame = {
      .struct_size = sizeof frame, .image = &scene->image, .time_s = 2, .depth = &depth};
  EXPECT(EDGESCOUT_BAD_INPUT, es_tracker_update(tracker, &frame));
  SAYS("depth: format: found a picture");
  static const uint16_t values[WIDTH * HEIGHT] = {330};
  depth = (edgescout_image){.struct_size = sizeof depth,
                            .pixels = values,
                            .width = WIDTH,
                            .height = HEIGHT - 1,
                            .format = EDGESCOUT_MONO16};
  EXPECT(EDGESCOUT_BAD_INPUT, es_tracker_update(tracker, &frame));
  SAYS("found 200x209, expected 200x210");
  frame.depth = NULL;
  frame.camera_from_depth = near_pose;
  EXPECT(EDGESCOUT_BAD_INPUT, es_tracker_update(tracker, &frame));
  SAYS("frame.depth: found NULL");
}

/* A program of the first header: its frames end before `depth`, and what follows a frame in a
   search lies there. */
static void expect_it_knows_the_first_header(const struct scene* scene,
                                             edgescout_tracker* tracker) {
  struct {
    size_t struct_size;
    struct {
      size_t struct_size;
      const edgescout_image* image;
      double time_s;
    } frame;
    edgescout_backend* backend;
    const edgescout_limit* limit;
  } first = {sizeof first, {sizeof first.frame, &scene->image, 2}, scene->backend, NULL};
  CHECK(sizeof first == 48 && sizeof first.frame == offsetof(edgescout_frame, depth));
  OK(es_tracker_update(tracker, (const edgescout_frame*)(const void*)&first.frame));
  CHECK(track_of(tracker).state == EDGESCOUT_TRACKED);
  OK(es_tracker_remove(tracker, track_of(tracker).id));
  first.frame.time_s = 2.1;
  OK(es_tracker_update(tracker, (const edgescout_frame*)(const void*)&first.frame));
  size_t found = 0;
  OK(es_tracker_search(tracker, (const edgescout_search*)(const void*)&first, &found));
  CHECK(found == 1);
}

/* The header before frames had a limit, and one with longer frames. */
static void expect_frames_of_other_sizes(const struct scene* scene, edgescout_tracker* tracker) {
  struct {
    size_t struct_size;
    unsigned char frame[offsetof(edgescout_frame, limit)];
    edgescout_backend* backend;
    const edgescout_limit* limit;
  } earlier = {.struct_size = sizeof earlier, .backend = scene->backend};
  struct {
    size_t struct_size;
    edgescout_frame frame;
    size_t more;
    edgescout_backend* backend;
    const edgescout_limit* limit;
    size_t more_behind;
  } newer = {.struct_size = sizeof newer, .backend = scene->backend};
  CHECK(sizeof earlier == 72 && sizeof earlier.frame == 48);
  edgescout_frame frame = {
      .struct_size = sizeof earlier.frame, .image = &scene->image, .time_s = 3};
  memcpy(earlier.frame, &frame, sizeof earlier.frame);
  newer.frame = frame;
  newer.frame.struct_size = sizeof newer.frame + sizeof newer.more;
  const void* const searches[] = {&earlier, &newer};
  for (int i = 0; i < 2; ++i) {
    OK(es_tracker_remove(tracker, track_of(tracker).id));
    size_t found = 0;
    OK(es_tracker_search(tracker, searches[i], &found));
    CHECK(found == 1);
    frame.time_s += 1;
    OK(es_tracker_update(tracker, &frame));
    CHECK(track_of(tracker).state == EDGESCOUT_TRACKED);
  }
  size_t found = 0;
  newer.more_behind = 1;
  EXPECT(EDGESCOUT_WRONG_VERSION, es_tracker_search(tracker, searches[1], &found));
  SAYS("search: found fields that version ");
  newer.more_behind = 0;
  newer.frame.struct_size = 60000;
  EXPECT(EDGESCOUT_WRONG_VERSION, es_tracker_search(tracker, searches[1], &found));
  SAYS("search.struct_size: found 96, expected at least 60024 with this frame");
}

static int32_t ask(void* user) {
  ++*(int*)user;
  return 1;
}

/* The part followed from a pose that only registration brings onto it. */
static edgescout_track track_from_far(const struct scene* scene, const double pose[16],
                                      const edgescout_options* options,
                                      const edgescout_limit* limit) {
  const edgescout_tracker_plan plan = {sizeof plan, scene->templates, scene->camera, scene->backend,
                                       options};
  edgescout_tracker* tracker = NULL;
  OK(es_tracker_create(&plan, &tracker));
  double turned[16];
  memcpy(turned, pose, sizeof turned);
  for (int row = 0; row < 3; ++row) { /* by 0.5 rad about the object's z */
    turned[4 * row] = 0.8775826 * pose[4 * row] + 0.4794255 * pose[4 * row + 1];
    turned[4 * row + 1] = -0.4794255 * pose[4 * row] + 0.8775826 * pose[4 * row + 1];
  }
  int32_t id = 0;
  OK(es_tracker_add(tracker, 0, turned, &id));
  const edgescout_frame frame = {
      .struct_size = sizeof frame, .image = &scene->image, .time_s = 1, .limit = limit};
  OK(es_tracker_update(tracker, &frame));
  const edgescout_track track = track_of(tracker);
  OK(es_free(tracker));
  return track;
}

/* Where the limit is over, an update is as one that registers nothing. */
static void expect_limits_of_updates(const struct scene* scene, const double pose[16],
                                     edgescout_tracker* tracker) {
  edgescout_options* options = NULL;
  OK(es_options_create(EDGESCOUT_TRACK_OPTIONS, &options));
  OK(es_options_set(options, "no-register", "true"));
  const edgescout_track plain = track_from_far(scene, pose, options, NULL),
                        whole = track_from_far(scene, pose, NULL, NULL);
  OK(es_free(options));
  CHECK(plain.state == EDGESCOUT_DOUBTFUL && whole.state == EDGESCOUT_TRACKED);
  int asked = 0;
  edgescout_limit limits[] = {{.struct_size = sizeof *limits, .max_seconds = 1e-9},
                              {.struct_size = sizeof *limits, .cancelled = ask, .user = &asked}};
  for (int i = 0; i < 2; ++i) {
    const edgescout_track limited = track_from_far(scene, pose, NULL, &limits[i]);
    CHECK(limited.state == plain.state && limited.above_chance == plain.above_chance);
    CHECK(memcmp(limited.camera_from_object, plain.camera_from_object,
                 sizeof plain.camera_from_object) == 0);
  }
  CHECK(asked > 0);
  limits[0].max_seconds = -1;
  const edgescout_frame frame = {
      .struct_size = sizeof frame, .image = &scene->image, .time_s = 10, .limit = limits};
  EXPECT(EDGESCOUT_BAD_INPUT, es_tracker_update(tracker, &frame));
  SAYS("limit.max_seconds: found -1");
  const edgescout_search search = {sizeof search, frame, scene->backend, NULL};
  size_t found = 0;
  EXPECT(EDGESCOUT_BAD_INPUT, es_tracker_search(tracker, &search, &found));
  SAYS("search.frame.limit: found a limit");
}

void test_tracker(void) {
  struct scene scene;
  open_scene(&scene);
  edgescout_options* options = NULL;
  OK(es_options_create(EDGESCOUT_TRACK_OPTIONS, &options));
  OK(es_options_set(options, "coarse-poses", "500"));
  OK(es_options_set(options, "medium-poses", "60"));
  OK(es_options_set(options, "candidates", "5"));
  const edgescout_tracker_plan plan = {sizeof plan, scene.templates, scene.camera, scene.backend,
                                       options};
  edgescout_tracker* tracker = NULL;
  OK(es_tracker_create(&plan, &tracker));
  OK(es_free(options));
  expect_it_follows(&scene, tracker);
  expect_refusals(&scene, tracker);
  expect_it_searches(&scene, tracker);
  const edgescout_track found = track_of(tracker);
  expect_depth_to_count(&scene, found.camera_from_object);
  expect_refusals_of_depth(&scene, tracker);
  expect_it_knows_the_first_header(&scene, tracker);
  update(tracker, &scene.image, 2.2);
  expect_frames_of_other_sizes(&scene, tracker);
  expect_limits_of_updates(&scene, found.camera_from_object, tracker);
  OK(es_free(tracker));
  close_scene(&scene);
}
