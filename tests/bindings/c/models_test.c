/* Meshes, cameras, templates, backends, poses of cameras. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/bindings/c/scene.h"

static void expect_meshes(const struct scene* scene) {
  edgescout_mesh_info info = {.struct_size = sizeof info};
  OK(es_mesh_get(scene->mesh, &info));
  CHECK(strcmp(info.name, "obj_000001") == 0 && info.vertex_count > 10);
  CHECK(info.diameter_m > 0.02 && info.diameter_m < 0.2);
  CHECK(info.box_max_m[0] > info.box_min_m[0]);
  double* const vertices_m = malloc(3 * info.vertex_count * sizeof *vertices_m);
  int32_t* const triangles = malloc(3 * info.triangle_count * sizeof *triangles);
  OK(es_mesh_copy(scene->mesh, vertices_m, triangles));
  edgescout_mesh_arrays arrays = {.struct_size = sizeof arrays, .name = "made"};
  arrays.vertices_m = vertices_m;
  arrays.vertex_count = info.vertex_count;
  arrays.triangles = triangles;
  arrays.triangle_count = info.triangle_count;
  edgescout_mesh* made = NULL;
  OK(es_mesh_create(&arrays, &made));
  edgescout_mesh_info same = {.struct_size = sizeof same};
  OK(es_mesh_get(made, &same));
  CHECK(same.vertex_count == info.vertex_count && same.diameter_m == info.diameter_m);
  CHECK(strcmp(same.name, "made") == 0);
  OK(es_free(made));

  triangles[0] = (int32_t)info.vertex_count;
  EXPECT(EDGESCOUT_BAD_INPUT, es_mesh_create(&arrays, &made));
  SAYS("found vertex index");
  triangles[0] = -1;
  EXPECT(EDGESCOUT_BAD_INPUT, es_mesh_create(&arrays, &made));
  arrays.vertex_count = 0;
  EXPECT(EDGESCOUT_BAD_INPUT, es_mesh_create(&arrays, &made));
  SAYS("vertices: found none, expected at least 3");
  arrays.vertex_count = info.vertex_count;
  triangles[0] = triangles[1];
  vertices_m[0] = NAN;
  EXPECT(EDGESCOUT_BAD_INPUT, es_mesh_create(&arrays, &made));
  SAYS("finite");
  arrays.vertex_count = SIZE_MAX;
  EXPECT(EDGESCOUT_BAD_INPUT, es_mesh_create(&arrays, &made));
  SAYS("arrays.vertex_count: found 18446744073709551615 items");
  EXPECT(EDGESCOUT_BAD_INPUT, es_mesh_load("no_such.stl", "mm", &made));
  SAYS("no_such.stl");
  EXPECT(EDGESCOUT_BAD_INPUT, es_mesh_load(EXAMPLE("parts/obj_000001.ply"), "feet", &made));
  SAYS("feet");
  EXPECT(EDGESCOUT_BAD_INPUT, es_mesh_load(EXAMPLE("parts/obj_000001.ply"), NULL, &made));
  free(vertices_m);
  free(triangles);
}

static void expect_cameras(void) {
  edgescout_camera_model model = {.struct_size = sizeof model, .width = 640, .height = 480};
  model.fx = 700;
  model.fy = 710;
  model.cx = 320;
  model.cy = 240;
  model.distortion[0] = 0.1;
  model.distortion[13] = 0.01;
  edgescout_camera* camera = NULL;
  OK(es_camera_create(&model, &camera));
  edgescout_camera_model same = {.struct_size = sizeof same};
  OK(es_camera_get(camera, &same));
  CHECK(memcmp(&same, &model, sizeof same) == 0);
  OK(es_free(camera));
  model.lens = 5;
  EXPECT(EDGESCOUT_BAD_INPUT, es_camera_create(&model, &camera));
  SAYS("model.lens: found 5");
  model.lens = EDGESCOUT_FISHEYE;
  model.fx = 0;
  EXPECT(EDGESCOUT_BAD_INPUT, es_camera_create(&model, &camera));
  SAYS("model: fx: found 0");
  OK(es_camera_load(EXAMPLE("visp/cube_camera.yaml"), NULL, &camera));
  OK(es_camera_get(camera, &same));
  CHECK(same.fx > 100);
  OK(es_free(camera));
  EXPECT(EDGESCOUT_BAD_INPUT, es_camera_load(EXAMPLE("README.md"), NULL, &camera));
  EXPECT(EDGESCOUT_BAD_INPUT, es_camera_load(EXAMPLE("visp/cube_camera.yaml"), "left", &camera));
}

static edgescout_part part_of(const struct scene* scene) {
  return (edgescout_part){.struct_size = sizeof(edgescout_part),
                          .mesh = scene->mesh,
                          .backend = scene->backend,
                          .camera = scene->camera,
                          .object_id = 9};
}

static size_t symmetries_of(const edgescout_part* part) {
  edgescout_templates* templates = NULL;
  OK(es_templates_build(part, &templates));
  edgescout_templates_info info = {.struct_size = sizeof info};
  OK(es_templates_at(templates, 0, &info));
  CHECK(info.object_id == 9 && info.distance_min_m > 0);
  CHECK(info.distance_max_m > 10 * info.distance_min_m); /* by the camera */
  OK(es_free(templates));
  return info.symmetry_count;
}

static void expect_symmetries(const struct scene* scene, const edgescout_options* one_view) {
  edgescout_part part = part_of(scene);
  part.options = one_view;
  CHECK(symmetries_of(&part) == 1);
  part.symmetry = "z2";
  CHECK(symmetries_of(&part) == 2);
  const double poses[32] = {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,
                            2,  0, 0, 0, 0, 1,  0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  part.symmetry_poses = poses;
  part.symmetry_pose_count = 1;
  edgescout_templates* templates = NULL;
  EXPECT(EDGESCOUT_BAD_INPUT, es_templates_build(&part, &templates));
  SAYS("part.symmetry: found words and poses");
  part.symmetry = NULL;
  CHECK(symmetries_of(&part) == 2);
  part.symmetry_pose_count = 2;
  EXPECT(EDGESCOUT_BAD_INPUT, es_templates_build(&part, &templates));
  SAYS("part.symmetry_poses[1]");
  part = part_of(scene);
  part.symmetry = "q9";
  EXPECT(EDGESCOUT_BAD_INPUT, es_templates_build(&part, &templates));
  SAYS("q9");
  part = part_of(scene);
  part.camera = NULL;
  EXPECT(EDGESCOUT_BAD_INPUT, es_templates_build(&part, &templates));
  SAYS("distance-min, distance-max: found 0, expected both, or a camera");
}

static void expect_files(const struct scene* scene) {
  OK(es_templates_save(scene->templates, "c_interface.templates"));
  edgescout_templates *loaded = NULL, *both = NULL;
  OK(es_templates_load("c_interface.templates", &loaded));
  remove("c_interface.templates");
  EXPECT(EDGESCOUT_BAD_INPUT, es_templates_load("c_interface.templates", &both));
  const edgescout_templates* const parts[2] = {scene->templates, loaded};
  OK(es_templates_join(parts, 2, &both));
  OK(es_free(loaded)); /* the joined ones are a copy */
  size_t count = 0;
  OK(es_templates_count(both, &count));
  CHECK(count == 2);
  edgescout_templates_info infos[2];
  for (size_t i = 0; i < 2; ++i) {
    infos[i].struct_size = sizeof *infos;
    OK(es_templates_at(both, i, &infos[i]));
  }
  CHECK(infos[0].distance_min_m == infos[1].distance_min_m && infos[1].distance_min_m == 0.34);
  EXPECT(EDGESCOUT_BAD_INPUT, es_templates_at(both, 2, &infos[0]));
  SAYS("index: found 2, expected below 2");
  EXPECT(EDGESCOUT_BAD_INPUT, es_templates_save(both, "c_interface.templates"));
  SAYS("templates: found 2 parts, expected 1");
  OK(es_free(both));
  EXPECT(EDGESCOUT_BAD_INPUT, es_templates_join(parts, 0, &both));
}

/* The second time the folder has them. */
static void expect_kept_templates(const struct scene* scene, const edgescout_options* one_view) {
  edgescout_part part = part_of(scene);
  part.options = one_view;
  part.cache_folder = "c_interface_cache";
  edgescout_templates* templates = NULL;
  for (int i = 0; i < 2; ++i) {
    OK(es_templates_build(&part, &templates));
    OK(es_free(templates));
  }
  CHECK(system("test $(find c_interface_cache -type f | wc -l) -ge 1") == 0);
  CHECK(system("rm -r c_interface_cache") == 0);
}

static void expect_backends(void) {
  edgescout_backend* backend = NULL;
  OK(es_backend_create("cpu-reference", 0, &backend));
  const char* name = NULL;
  OK(es_backend_name(backend, &name));
  CHECK(strcmp(name, "cpu-reference") == 0);
  OK(es_free(backend));
  EXPECT(EDGESCOUT_BAD_INPUT, es_backend_create("tpu", 0, &backend));
  SAYS("tpu");
  EXPECT(EDGESCOUT_BAD_INPUT, es_backend_create("auto", 2, &backend));
  SAYS("threads: found 2 for auto");
  EXPECT(EDGESCOUT_BAD_INPUT, es_backend_create("cpu", -1, &backend));
  CHECK(backend == NULL);
  size_t count = 0;
  OK(es_device_count(&count));
  edgescout_device device = {.struct_size = sizeof device};
  for (size_t i = 0; i < count; ++i) {
    OK(es_device_at(i, &device));
    CHECK(strlen(device.name) > 0);
  }
  EXPECT(EDGESCOUT_BAD_INPUT, es_device_at(count, &device));
}

static void expect_poses_of_cameras(void) {
  edgescout_hemisphere rings = {.struct_size = sizeof rings, .center_m = {0.1, 0.2, 0.3}};
  rings.radius_m = 0.5;
  rings.count = 8;
  size_t count = 0;
  OK(es_hemisphere_views(&rings, NULL, 0, &count));
  CHECK(count == 8);
  double poses[8][16];
  OK(es_hemisphere_views(&rings, poses[0], 8, &count));
  for (size_t i = 0; i < count; ++i) {
    const double* const p = poses[i];
    const double z = p[8] * 0.1 + p[9] * 0.2 + p[10] * 0.3 + p[11];
    CHECK(fabs(z - 0.5) < 1e-9 && p[15] == 1 && p[12] == 0);
  }
  EXPECT(EDGESCOUT_BAD_INPUT, es_hemisphere_views(&rings, poses[0], 7, &count));
  SAYS("capacity: found 7, expected at least 8");
  const double elevations_deg[1] = {95};
  rings.elevations_deg = elevations_deg;
  rings.elevation_count = 1;
  EXPECT(EDGESCOUT_BAD_INPUT, es_hemisphere_views(&rings, poses[0], 8, &count));
  rings.elevation_count = -1;
  EXPECT(EDGESCOUT_BAD_INPUT, es_hemisphere_views(&rings, poses[0], 8, &count));
  const double eye_m[3] = {0, 0, 1}, target_m[3] = {0, 0, 0};
  OK(es_look_at(eye_m, target_m, poses[0]));
  CHECK(poses[0][11] == 1);
  EXPECT(EDGESCOUT_BAD_INPUT, es_look_at(eye_m, eye_m, poses[0]));
}

void test_models(void) {
  struct scene scene;
  open_scene(&scene);
  edgescout_options* one_view = NULL;
  OK(es_options_create(EDGESCOUT_TEMPLATE_OPTIONS, &one_view));
  OK(es_options_set(one_view, "viewpoints", "1"));
  expect_meshes(&scene);
  expect_cameras();
  expect_symmetries(&scene, one_view);
  expect_files(&scene);
  expect_kept_templates(&scene, one_view);
  expect_backends();
  expect_poses_of_cameras();
  OK(es_free(one_view));
  close_scene(&scene);
}
