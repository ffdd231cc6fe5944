/* The scout, step by step. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tests/bindings/c/scene.h"

static void give(edgescout_scout* scout, int32_t view) {
  edgescout_image image;
  edgescout_picture* const picture = picture_of_view(view, &image);
  const edgescout_shot shot = {.struct_size = sizeof shot, .view = view, .image = &image};
  OK(es_scout_give(scout, &shot));
  OK(es_free(picture));
}

static int32_t proposed(edgescout_scout* scout) {
  edgescout_proposal proposal = {.struct_size = sizeof proposal};
  OK(es_scout_propose(scout, NULL, &proposal));
  if (proposal.view >= 0)
    for (int i = 0; i < 16; ++i)
      CHECK(fabs(proposal.camera_from_world[i] - camera_from_world_views[proposal.view][i]) <
            1e-12);
  return proposal.view;
}

static edgescout_scout_state state_of(const edgescout_scout* scout) {
  edgescout_scout_state state = {.struct_size = sizeof state};
  OK(es_scout_get(scout, &state));
  return state;
}

static edgescout_detection best_of(const edgescout_detections* detections) {
  edgescout_detection best = {.struct_size = sizeof best};
  OK(es_detections_at(detections, 0, &best));
  return best;
}

static edgescout_expectation expectation_of(const edgescout_scout* scout, int32_t view) {
  edgescout_expectation expectation = {.struct_size = sizeof expectation};
  OK(es_scout_expectation(scout, view, &expectation));
  return expectation;
}

/* Goes on from a file as it would have without. What it found outlives all else. */
static void expect_it_finds_the_part(struct scene* scene) {
  edgescout_scout* const scout = example_scout(scene);
  CHECK(proposed(scout) == 0 && proposed(scout) == 0);
  CHECK(expectation_of(scout, 1).value == 0);
  give(scout, 0);
  OK(es_scout_save(scout, "c_interface.state"));
  edgescout_scout* const again = example_scout(scene);
  OK(es_scout_resume(again, "c_interface.state", NULL));
  remove("c_interface.state");
  edgescout_scout* const both[2] = {scout, again};
  edgescout_detections* found[2];
  for (int i = 0; i < 2; ++i) {
    CHECK(state_of(both[i]).image_count == 1 && state_of(both[i]).end == EDGESCOUT_GOES_ON);
    CHECK(proposed(both[i]) == 1);
    CHECK(!expectation_of(both[i], 0).is_open && expectation_of(both[i], 1).is_open);
    const edgescout_expectation open = expectation_of(both[i], 1);
    CHECK(open.value > 0 && open.value == open.information + open.discovery - open.motion_cost);
    give(both[i], 1);
    CHECK(proposed(both[i]) == -1);
    CHECK(state_of(both[i]).end == EDGESCOUT_NO_VIEW_LEFT);
    OK(es_scout_detections(both[i], &found[i]));
    OK(es_free(both[i]));
  }
  OK(es_free(scene->templates));
  const edgescout_detection best = best_of(found[0]), same = best_of(found[1]);
  CHECK(best.probability > 0.8 && strcmp(best.name, "obj_000006") == 0 && best.object_id == 6);
  CHECK(best.supporting_image_count > 0 && best.supporting_images[0] < 2);
  CHECK(memcmp(best.world_from_object, same.world_from_object, sizeof best.world_from_object) == 0);
  OK(es_free(found[0]));
  OK(es_free(found[1]));
}

static int32_t only_the_second(int32_t view, void* user) {
  ++*(int*)user;
  return view == 1;
}

static void expect_other_views_where_one_fails(const struct scene* scene) {
  edgescout_scout* scout = example_scout(scene);
  OK(es_scout_unreachable(scout, proposed(scout), "no path"));
  CHECK(proposed(scout) == 1 && state_of(scout).failed_count == 1);
  edgescout_image image;
  edgescout_picture* const picture = picture_of_view(0, &image);
  edgescout_shot shot = {.struct_size = sizeof shot, .image = &image};
  EXPECT(EDGESCOUT_BAD_INPUT, es_scout_give(scout, &shot));
  SAYS("found 0 again");
  shot.view = 2;
  EXPECT(EDGESCOUT_BAD_INPUT, es_scout_give(scout, &shot));
  SAYS("view: found 2, expected one of 2");
  shot.view = -1;
  EXPECT(EDGESCOUT_BAD_INPUT, es_scout_give(scout, &shot));
  edgescout_expectation expectation = {.struct_size = sizeof expectation};
  EXPECT(EDGESCOUT_BAD_INPUT, es_scout_expectation(scout, 2, &expectation));
  EXPECT(EDGESCOUT_BAD_INPUT, es_scout_unreachable(scout, 2, NULL));
  shot.view = 1;
  image.height = 100;
  EXPECT(EDGESCOUT_BAD_INPUT, es_scout_give(scout, &shot));
  SAYS("image size");
  image.height = scout_window.height;
  double bent[16];
  memcpy(bent, camera_from_world_views[1], sizeof bent);
  bent[0] = 2;
  shot.camera_from_world = bent;
  EXPECT(EDGESCOUT_BAD_INPUT, es_scout_give(scout, &shot));
  SAYS("shot.camera_from_world");
  edgescout_scout_step step = {.struct_size = sizeof step};
  EXPECT(EDGESCOUT_BAD_INPUT, es_scout_step_at(scout, 0, &step));
  OK(es_free(picture));
  OK(es_free(scout));

  int asked = 0;
  edgescout_scout_plan plan = example_plan(scene);
  plan.reachable = only_the_second;
  plan.user = &asked;
  OK(es_scout_create(&plan, &scout));
  CHECK(proposed(scout) == 1 && asked > 0);
  give(scout, 1);
  OK(es_scout_step_at(scout, 0, &step));
  CHECK(step.view == 1 && fabs(step.camera_from_world[11] - 0.3667710046368189) < 1e-12);
  CHECK(step.entropy_nats == state_of(scout).entropy_nats);
  CHECK(proposed(scout) == -1);
  OK(es_free(scout));
  plan.view_count = 0;
  EXPECT(EDGESCOUT_BAD_INPUT, es_scout_create(&plan, &scout));
}

void test_scout(void) {
  struct scene scene;
  open_scene(&scene);
  OK(es_free(scene.templates));
  scene.templates = templates_of_part(6, "0.37", "0.37", "2", scene.backend);
  expect_other_views_where_one_fails(&scene);
  expect_it_finds_the_part(&scene);
  scene.templates = NULL;
  close_scene(&scene);
}
