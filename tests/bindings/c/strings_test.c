/* Strings are read up to their end and no further, whatever they hold; refusals are of one line. */
#include <stdlib.h>
#include <string.h>

#include "tests/bindings/c/scene.h"

/* Set before calls of the functions below. */
static struct scene scene;
static edgescout_options* options;
static edgescout_scout* scout;

#define MAKING(type, call)                       \
  edgescout_##type* out = NULL;                  \
  const edgescout_status status = call;          \
  CHECK((status == EDGESCOUT_OK) == (out != 0)); \
  OK(es_free(out));                              \
  return status;

/* Each calls a function with `text` in place of one string, of which nothing is kept. */
static edgescout_status device(const char* text) {
  MAKING(backend, es_backend_create(text, 0, &out))
}
static edgescout_status camera_file(const char* text) {
  MAKING(camera, es_camera_load(text, NULL, &out))
}
static edgescout_status camera_name(const char* text) {
  MAKING(camera, es_camera_load(EXAMPLE("visp/cube_camera.yaml"), text, &out))
}
static edgescout_status picture_file(const char* text) {
  MAKING(picture, es_picture_load(text, NULL, &out))
}
static edgescout_status saved_picture(const char* text) {
  return es_picture_save_png(scene.picture, text);
}
static edgescout_status mesh_file(const char* text) { MAKING(mesh, es_mesh_load(text, "mm", &out)) }
static edgescout_status unit(const char* text) {
  MAKING(mesh, es_mesh_load(EXAMPLE("parts/obj_000001.ply"), text, &out))
}
static edgescout_status mesh_name(const char* text) {
  const double vertices_m[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const int32_t triangles[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  const edgescout_mesh_arrays arrays = {sizeof arrays, text, vertices_m, 4, triangles, 4};
  edgescout_mesh* out = NULL;
  const edgescout_status status = es_mesh_create(&arrays, &out);
  edgescout_mesh_info info = {.struct_size = sizeof info};
  OK(es_mesh_get(out, &info));
  CHECK(info.name != text && strcmp(info.name, text) == 0);
  OK(es_free(out));
  return status;
}
static edgescout_status templates_file(const char* text) {
  MAKING(templates, es_templates_load(text, &out))
}
static edgescout_status saved_templates(const char* text) {
  return es_templates_save(scene.templates, text);
}
static edgescout_status symmetry(const char* text) {
  const edgescout_limit over = {.struct_size = sizeof over, .max_seconds = 1e-9};
  const edgescout_part part = {.struct_size = sizeof part,
                               .mesh = scene.mesh,
                               .backend = scene.backend,
                               .camera = scene.camera,
                               .symmetry = text,
                               .limit = &over};
  MAKING(templates, es_templates_build(&part, &out))
}
static edgescout_status option_set(const char* text) {
  return es_options_set(options, text, "0.5");
}
static edgescout_status option_value(const char* text) {
  return es_options_set(options, "min-probability", text);
}
static edgescout_status option_get(const char* text) {
  edgescout_option out = {.struct_size = sizeof out};
  return es_options_get(options, text, &out);
}
static edgescout_status reason(const char* text) {
  edgescout_scout* const own = example_scout(&scene);
  const edgescout_status status = es_scout_unreachable(own, 0, text);
  OK(es_free(own));
  return status;
}
static edgescout_status saved_state(const char* text) { return es_scout_save(scout, text); }
static edgescout_status state_file(const char* text) { return es_scout_resume(scout, text, NULL); }

static const struct place {
  edgescout_status (*call)(const char* text);
  const char* before; /* what is put before the text */
  edgescout_status expected;
} places[] = {{device, "", EDGESCOUT_BAD_INPUT},
              {camera_file, "", EDGESCOUT_BAD_INPUT},
              {camera_name, "no", EDGESCOUT_BAD_INPUT},
              {picture_file, "", EDGESCOUT_BAD_INPUT},
              {saved_picture, "/dev/null/", EDGESCOUT_BAD_INPUT},
              {mesh_file, "", EDGESCOUT_BAD_INPUT},
              {unit, "", EDGESCOUT_BAD_INPUT},
              {mesh_name, "", EDGESCOUT_OK},
              {templates_file, "", EDGESCOUT_BAD_INPUT},
              {saved_templates, "/dev/null/", EDGESCOUT_BAD_INPUT},
              {symmetry, "q", EDGESCOUT_BAD_INPUT},
              {option_set, "", EDGESCOUT_BAD_INPUT},
              {option_value, "", EDGESCOUT_BAD_INPUT},
              {option_get, "", EDGESCOUT_BAD_INPUT},
              {saved_state, "/dev/null/", EDGESCOUT_BAD_INPUT},
              {state_file, "", EDGESCOUT_BAD_INPUT},
              {reason, "", EDGESCOUT_OK}};

/* In a block of its own that ends with it: one byte too far is found by what watches memory. */
static void expect(const struct place* place, const char* text) {
  const size_t before = strlen(place->before), size = strlen(text);
  char* const block = malloc(before + size + 1);
  memcpy(block, place->before, before);
  memcpy(block + before, text, size + 1);
  EXPECT(place->expected, place->call(block));
  CHECK(!strchr(es_last_error(), '\n'));
  free(block);
}

void test_strings(void) {
  open_scene(&scene);
  OK(es_options_create(EDGESCOUT_DETECT_OPTIONS, &options));
  scout = example_scout(&scene);
  char* const endless = malloc(100001);
  memset(endless, 'x', 100000);
  endless[100000] = '\0';
  const char* const texts[] = {"", "x", "\xff\xfe\x80", "two\nlines\r\x1b[1m", "%s%n{}", endless};
  for (size_t i = 0; i < sizeof places / sizeof *places; ++i)
    for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) expect(&places[i], texts[k]);
  free(endless);
  OK(es_free(scout));
  OK(es_free(options));
  close_scene(&scene);
}
