#include "tests/bindings/c/scene.h"

#include <stdio.h>

const char* examples_folder = "docs/examples";

const char* example_file(const char* name) {
  static char file[4096];
  snprintf(file, sizeof file, "%s/%s", examples_folder, name);
  return file;
}

edgescout_templates* templates_of_part(int part, const char* distance_min, const char* distance_max,
                                       const char* viewpoints, edgescout_backend* backend) {
  char name[64];
  snprintf(name, sizeof name, "parts/obj_%06d.ply", part);
  edgescout_mesh* mesh = NULL;
  OK(es_mesh_load(EXAMPLE(name), "mm", &mesh));
  edgescout_options* options = NULL;
  OK(es_options_create(EDGESCOUT_TEMPLATE_OPTIONS, &options));
  OK(es_options_set(options, "distance-min", distance_min));
  OK(es_options_set(options, "distance-max", distance_max));
  OK(es_options_set(options, "viewpoints", viewpoints));
  edgescout_part what = {.struct_size = sizeof what};
  what.mesh = mesh;
  what.backend = backend;
  what.options = options;
  what.object_id = part;
  edgescout_templates* templates = NULL;
  OK(es_templates_build(&what, &templates));
  OK(es_free(options));
  OK(es_free(mesh));
  return templates;
}

const struct window part_window = {0, 160, 200, 210};
const struct window scout_window = {150, 215, 320, 160};

edgescout_camera* camera_of(struct window window) {
  edgescout_camera_model model = {.struct_size = sizeof model};
  model.width = window.width;
  model.height = window.height;
  model.fx = model.fy = 700;
  model.cx = 319.5 - window.x;
  model.cy = 239.5 - window.y;
  edgescout_camera* camera = NULL;
  OK(es_camera_create(&model, &camera));
  return camera;
}

edgescout_image cut_out(edgescout_image image, struct window window) {
  image.pixels = (const uint8_t*)image.pixels + window.y * image.row_stride_bytes + window.x;
  image.width = window.width;
  image.height = window.height;
  return image;
}

edgescout_picture* picture_of_view(int view, edgescout_image* image) {
  char name[64];
  snprintf(name, sizeof name, "scenes/000001/gray/%06d.png", view);
  edgescout_picture* picture = NULL;
  OK(es_picture_load(EXAMPLE(name), NULL, &picture));
  *image = (edgescout_image){.struct_size = sizeof *image};
  OK(es_picture_get(picture, image));
  *image = cut_out(*image, scout_window);
  return picture;
}

edgescout_options* quick_options(int32_t kind) {
  edgescout_options* options = NULL;
  OK(es_options_create(kind, &options));
  OK(es_options_set(options, "coarse-poses", "500"));
  OK(es_options_set(options, "medium_poses", "60"));
  OK(es_options_set(options, "coarse-poses-joint", "200"));
  OK(es_options_set(options, "medium-poses-joint", "40"));
  OK(es_options_set(options, "candidates", "5"));
  if (kind != EDGESCOUT_SCOUT_OPTIONS) return options;
  OK(es_options_set(options, "particles", "40"));
  OK(es_options_set(options, "combinations", "100"));
  OK(es_options_set(options, "max-searches", "1"));
  return options;
}

void open_scene(struct scene* scene) {
  *scene = (struct scene){.image = {.struct_size = sizeof scene->image},
                          .view = {.struct_size = sizeof scene->view},
                          .request = {.struct_size = sizeof scene->request}};
  OK(es_backend_create("cpu", 2, &scene->backend));
  OK(es_mesh_load(EXAMPLE("parts/obj_000001.ply"), "mm", &scene->mesh));
  scene->camera = camera_of(part_window);
  scene->scout_camera = camera_of(scout_window);
  scene->detect_options = quick_options(EDGESCOUT_DETECT_OPTIONS);
  scene->scout_options = quick_options(EDGESCOUT_SCOUT_OPTIONS);
  scene->templates = templates_of_part(1, "0.34", "0.34", "2", scene->backend);
  OK(es_picture_load(EXAMPLE("scenes/000000/gray/000000.png"), NULL, &scene->picture));
  OK(es_picture_get(scene->picture, &scene->image));
  scene->image = cut_out(scene->image, part_window);
  scene->view.image = &scene->image;
  scene->view.camera = scene->camera;
  scene->request.views = &scene->view;
  scene->request.view_count = 1;
  scene->request.templates = scene->templates;
  scene->request.backend = scene->backend;
  scene->request.options = scene->detect_options;
}

void close_scene(struct scene* scene) {
  OK(es_free(scene->picture));
  OK(es_free(scene->templates));
  OK(es_free(scene->scout_options));
  OK(es_free(scene->detect_options));
  OK(es_free(scene->scout_camera));
  OK(es_free(scene->camera));
  OK(es_free(scene->mesh));
  OK(es_free(scene->backend));
}

edgescout_scout_plan example_plan(const struct scene* scene) {
  edgescout_scout_plan plan = {.struct_size = sizeof plan};
  plan.templates = scene->templates;
  plan.camera = scene->scout_camera;
  plan.options = scene->scout_options;
  plan.camera_from_world = camera_from_world_views[0];
  plan.view_count = SCOUT_VIEWS;
  plan.backend = scene->backend;
  return plan;
}

edgescout_scout* example_scout(const struct scene* scene) {
  const edgescout_scout_plan plan = example_plan(scene);
  edgescout_scout* scout = NULL;
  OK(es_scout_create(&plan, &scout));
  return scout;
}
