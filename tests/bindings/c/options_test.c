/* Options by their names, as text. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bindings/c/scene.h"

static const char* value_of(const edgescout_options* options, const char* name) {
  edgescout_option option = {.struct_size = sizeof option};
  OK(es_options_get(options, name, &option));
  return option.value;
}

/* Each option of each kind says what it is, and takes the value that it shows. */
static void expect_lists(void) {
  for (int32_t kind = EDGESCOUT_IMAGE_OPTIONS; kind <= EDGESCOUT_DEPTH_OPTIONS; ++kind) {
    edgescout_options* options = NULL;
    OK(es_options_create(kind, &options));
    size_t count = 0;
    OK(es_options_count(options, &count));
    CHECK(count >= 4);
    for (size_t i = 0; i < count; ++i) {
      edgescout_option option = {.struct_size = sizeof option};
      OK(es_options_at(options, i, &option));
      CHECK(strlen(option.name) > 2 && strlen(option.help) > 10 && strlen(option.group) > 2);
      CHECK(strcmp(option.value, option.default_value) == 0);
      CHECK(option.type >= EDGESCOUT_INTEGER && option.type <= EDGESCOUT_CHOICE);
      CHECK((option.type == EDGESCOUT_CHOICE) == (option.word_count > 0));
      char name[128], value[128];
      snprintf(name, sizeof name, "%s", option.name);
      snprintf(value, sizeof value, "%s", option.value);
      for (char* at = name; *at; ++at)
        if (*at == '-') *at = '_';
      OK(es_options_set(options, name, value));
      CHECK(strcmp(value_of(options, name), value) == 0);
    }
    edgescout_option option = {.struct_size = sizeof option};
    EXPECT(EDGESCOUT_BAD_INPUT, es_options_at(options, count, &option));
    SAYS("index: found ");
    OK(es_free(options));
  }
  edgescout_options* none = NULL;
  EXPECT(EDGESCOUT_BAD_INPUT, es_options_create(7, &none));
  EXPECT(EDGESCOUT_BAD_INPUT, es_options_create(-1, &none));
}

static void expect_refused(edgescout_options* options, const char* name, const char* value,
                           const char* message) {
  EXPECT(EDGESCOUT_BAD_INPUT, es_options_set(options, name, value));
  SAYS(message);
}

static void expect_refusals(void) {
  edgescout_options* options = NULL;
  OK(es_options_create(EDGESCOUT_DETECT_OPTIONS, &options));
  OK(es_options_set(options, "min-probability", "0.25"));
  expect_refused(options, "min-probability", "2", "detect.min_probability: found 2");
  expect_refused(options, "min-probability", "nan", "detect.min_probability: found nan");
  expect_refused(options, "min-probability", "", "found \"\", expected a number");
  expect_refused(options, "min-probability", "0.5x", "found \"0.5x\", expected a number");
  expect_refused(options, "min-probability", " 0.5", "found \" 0.5\"");
  expect_refused(options, "min-probabilty", "0.5", "expected min-probability");
  expect_refused(options, "", "0.5", "no option of the name \"\"");
  expect_refused(options, "no such\nthing", "1", "expected one of its ");
  CHECK(strcmp(value_of(options, "min-probability"), "0.25") == 0); /* as it was */
  expect_refused(options, "bins", "60.5", "expected an integer");
  expect_refused(options, "bins", "99999999999", "expected an integer");
  expect_refused(options, "faint-edges", "1", "found \"1\", expected true or false");
  expect_refused(options, "edges", "sobel", "found \"sobel\", expected one of gradient, lsd");
  expect_refused(options, "world-box", "1 2", "found 2 numbers, expected 6");
  expect_refused(options, "world-box", "1 2 3 4 5 six", "expected 6 numbers or none");
  OK(es_options_set(options, "world-box", "-1,-1,-1, 1 1 1"));
  CHECK(strcmp(value_of(options, "world-box"), "-1 -1 -1 1 1 1") == 0);
  OK(es_options_set(options, "world-box", ""));
  CHECK(strcmp(value_of(options, "world-box"), "") == 0);

  edgescout_options* copy = NULL;
  OK(es_options_copy(options, &copy));
  OK(es_options_set(options, "min-probability", "0.75"));
  CHECK(strcmp(value_of(copy, "min-probability"), "0.25") == 0);
  edgescout_option option = {.struct_size = sizeof option};
  OK(es_options_get(copy, "min-probability", &option));
  CHECK(strcmp(option.default_value, "0.4") == 0 && option.low == 0 && option.high == 1);
  OK(es_free(options));
  CHECK(strcmp(value_of(copy, "min-probability"), "0.25") == 0);
  OK(es_free(copy));
}

/* Options that each are right and together are not are refused by the call. */
static void expect_wrong_together(void) {
  struct scene scene;
  open_scene(&scene);
  edgescout_options* options = NULL;
  OK(es_options_create(EDGESCOUT_DETECT_OPTIONS, &options));
  OK(es_options_set(options, "edge-low", "100"));
  OK(es_options_set(options, "edge-high", "50"));
  scene.request.options = options;
  edgescout_detections* out = NULL;
  EXPECT(EDGESCOUT_BAD_INPUT, es_detect(&scene.request, &out));
  SAYS("edge.high_threshold: found 50");
  CHECK(out == NULL);
  OK(es_free(options));
  OK(es_options_create(EDGESCOUT_SCOUT_OPTIONS, &options));
  scene.request.options = options;
  EXPECT(EDGESCOUT_WRONG_KIND, es_detect(&scene.request, &out));
  SAYS("options: found those of scout, expected those of detect");
  OK(es_free(options));
  close_scene(&scene);
}

void test_options(void) {
  expect_lists();
  expect_refusals();
  expect_wrong_together();
}
