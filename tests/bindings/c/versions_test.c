/* Versions, statuses, messages of the log. */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bindings/c/scene.h"

static void* message_of_another_thread(void* unused) {
  (void)unused;
  CHECK(strcmp(es_last_error(), "") == 0);
  EXPECT(EDGESCOUT_NULL, es_options_create(0, NULL));
  SAYS("out: found NULL");
  return NULL;
}

void test_versions(void) {
  CHECK(strcmp(es_version(), EXPECTED_VERSION) == 0);
  CHECK(es_abi() == EDGESCOUT_ABI);
  CHECK(strcmp(es_last_error(), "") == 0);
  OK(es_require_abi(EDGESCOUT_ABI));
  EXPECT(EDGESCOUT_WRONG_VERSION, es_require_abi(EDGESCOUT_ABI + 1));
  SAYS("abi: found 1, expected 0 of this library, " EXPECTED_VERSION);
  OK(es_require_abi(EDGESCOUT_ABI));
  SAYS("abi: found 1"); /* a call that succeeds keeps the message */
  pthread_t thread;
  CHECK(pthread_create(&thread, NULL, message_of_another_thread, NULL) == 0);
  pthread_join(thread, NULL);
  SAYS("abi: found 1");

  CHECK(strcmp(es_status_name(EDGESCOUT_BAD_HANDLE), "bad handle") == 0);
  CHECK(strcmp(es_status_name(EDGESCOUT_INTERNAL), "internal") == 0);
  CHECK(strcmp(es_status_name(-1), "unknown") == 0);
  CHECK(strcmp(es_status_name(11), "unknown") == 0);

  /* A message longer than there is room for. */
  char* const name = malloc(10001);
  memset(name, 'x', 10000);
  name[10000] = '\0';
  edgescout_camera* camera = NULL;
  EXPECT(EDGESCOUT_BAD_INPUT, es_camera_load(name, NULL, &camera));
  CHECK(strlen(es_last_error()) < 4096 && strstr(es_last_error(), "..."));
  /* It is cut between letters, not in one. */
  for (int shift = 0; shift < 2; ++shift) {
    for (int i = 0; i < 10000; ++i) name[i] = (i + shift) % 2 ? '\xa4' : '\xc3'; /* "\u00e4" */
    if (shift) name[0] = 'x';
    EXPECT(EDGESCOUT_BAD_INPUT, es_camera_load(name, NULL, &camera));
    const char* const cut = strstr(es_last_error(), "...");
    CHECK(cut && cut[-1] == '\xa4');
  }
  free(name);
}

struct logged {
  int count;
  int32_t level;
  char last[1024];
};

static void keep(int32_t level, const char* message, void* user) {
  struct logged* const logged = user;
  ++logged->count;
  logged->level = level;
  strncat(logged->last, message, sizeof logged->last - 1);
  es_set_log_sink(NULL, NULL); /* a sink may call the library */
}

void test_log(void) {
  struct logged logged = {0, -1, ""};
  struct scene scene;
  open_scene(&scene);
  edgescout_scout* const scout = example_scout(&scene);
  OK(es_set_log_sink(keep, &logged));
  OK(es_scout_unreachable(scout, 0, "no path"));
  OK(es_scout_unreachable(scout, 1, NULL));
  CHECK(logged.count == 1 && logged.level == EDGESCOUT_WARNING);
  CHECK(strstr(logged.last, "no path") != NULL);
  OK(es_free(scout));
  close_scene(&scene);
}
