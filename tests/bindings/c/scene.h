/* The example scene with one of its parts, as handles. */
#ifndef EDGESCOUT_TESTS_SCENE_H
#define EDGESCOUT_TESTS_SCENE_H

#include "tests/bindings/c/library.h"
#include "tests/bindings/c/views.h"

extern const char* examples_folder; /* docs/examples */
#define EXAMPLE(file) example_file(file)
const char* example_file(const char* name); /* valid until the next call */

/* A part of the images that shows the part: less to search. */
struct window {
  int32_t x, y, width, height;
};
extern const struct window part_window;  /* of scenes/000000, part 1 */
extern const struct window scout_window; /* of both views of scenes/000001, part 6 */
edgescout_camera* camera_of(struct window window);
/* The window of the image, whose pixels stay where they are. */
edgescout_image cut_out(edgescout_image image, struct window window);
/* Of scenes/000001; the image lasts as long as the picture. */
edgescout_picture* picture_of_view(int view, edgescout_image* image);

struct scene {
  edgescout_backend* backend;
  edgescout_mesh* mesh;
  edgescout_camera* camera;
  edgescout_camera* scout_camera;
  edgescout_options *detect_options, *scout_options; /* quick ones */
  edgescout_templates* templates;
  edgescout_picture* picture;
  edgescout_image image;
  edgescout_view view;
  edgescout_request request;
};

/* Of a kind, with less work than usual. */
edgescout_options* quick_options(int32_t kind);

/* Part 1 in its window of scenes/000000, with few templates. */
void open_scene(struct scene* scene);
void close_scene(struct scene* scene);

/* Templates of a part at its distances, with a number of `viewpoints`. */
edgescout_templates* templates_of_part(int part, const char* distance_min, const char* distance_max,
                                       const char* viewpoints, edgescout_backend* backend);
/* A scout of the scene's templates in the windows of scenes/000001. */
edgescout_scout_plan example_plan(const struct scene* scene);
edgescout_scout* example_scout(const struct scene* scene);

/* Of the scene's templates and camera, with the usual options. */
edgescout_tracker* example_tracker(const struct scene* scene);

/* Tests, by their names on the command line. */
void test_versions(void);
void test_handles(void);
void test_nulls(void);
void test_structs(void);
void test_strings(void);
void test_options(void);
void test_images(void);
void test_depth(void);
void test_models(void);
void test_limits(void);
void test_busy(void);
void test_scout(void);
void test_tracker(void);
void test_memory(void);
void test_log(void);
/* Prints what the functions find, to be compared with what C++ finds. */
void print_results(void);

#endif
