// Makes scenes with known poses: parts on a printed board, apart or in a pile, with lights and with
// cameras on a hemisphere.
//
// World frame: the board is the plane z = 0, +z up, metres. Objects, options and files determine a
// scene completely.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "host/core/types.h"
#include "host/render/depth_sensor.h"
#include "host/render/environment.h"
#include "host/render/photographs.h"
#include "host/render/ranges.h"

namespace edgescout {

struct RenderOptions {
  unsigned seed = 1;
  int width = 1024;
  int height = 768;
  double focal_px = 1200;
  int objects = 8;    // instances, divided evenly among the models; [1, 20]
  int views = 1;      // [1, 50]
  int clutter = 1;    // 0: bare board; 1: printed shapes and 3 foreign parts; 2: many and 8
  double pile = 0.5;  // 0: all apart, nothing hides anything; 1: all dropped on one pile
  double min_elevation_deg = 35;  // of the cameras over the board; [10, 90]
  double max_elevation_deg = 80;
  // Camera to the middle of the parts. Both 0: such that the parts fill the image.
  double min_distance_m = 0;
  double max_distance_m = 0;
  double blur_px = 0.6;   // standard deviation of a Gaussian; [0, 10]
  double noise_grey = 2;  // the same, grey levels; [0, 50]
  // Samples per pixel and axis; odd, so that one sample is at the pixel's centre; [1, 7].
  int supersampling = 3;
  bool shadows = true;
  ClutterRanges clutter_ranges;
  SurfaceRanges surfaces;
  LightRanges light;
  CameraRanges camera;
  DepthSensor depth;
  // Throws InputError naming the field and the violated bound.
  void validate() const;
};

struct Material {
  double albedo = 0.3;    // diffuse reflectance, linear
  double specular = 0.1;  // strength of the Blinn-Phong highlight
  double shininess = 30;  // its exponent
  // Mirror-like reflection of the surroundings (reflection.h), in place of that highlight.
  double reflectance = 0;  // at normal incidence; 0: none
  double roughness = 0;
  double anisotropy = 0;
  // Whether lamps are mirrored as discs. On a rougher surface they are highlights.
  bool mirrors_lamps() const { return roughness < 0.2; }
};

struct PlacedObject {
  int object = 0;  // index into SimulatedScene::objects
  Se3 world_from_object;
  Material material;
  bool target = true;  // false: a foreign part, for which no ground truth is written
  bool hangs = false;  // a foreign part in the air, before the cameras
};

struct Light {
  Eigen::Vector3d position_m;
  // At the world's origin on a surface that faces the light. Falls with the squared distance.
  double irradiance = 0;
  int shadow_px = 512;  // side of its shadow map; smaller is softer
  bool is_sky = false;  // a direction of the sky, no lamp
};

struct SceneView {
  Camera camera;
  Se3 camera_from_world;
  Image background = {};  // a photograph of the camera's size in place of the desk; may be empty
};

// What scenes take from files. Lists may be empty.
struct SceneFiles {
  std::vector<Mesh> clutter;  // foreign parts; any unit, since they are scaled
  PhotographFolders backgrounds, board_textures, environments;
};

// Not the Scene of register/scene.h, which holds what registration works on.
struct SimulatedScene {
  RenderOptions options;
  std::vector<Object> objects;  // the targets' models first, then the foreign parts'
  std::vector<PlacedObject> placed;
  std::vector<Light> lights;  // lamps as clusters of points, then the sky
  double ambient = 0.05;      // irradiance from all directions, without shadows
  Image board;              // print, albedo * 255, over the square of board_side_m about the origin
  double board_side_m = 0;  // 0: there is no board
  Se3 world_from_board;     // turns and shifts it in its plane
  double desk_albedo = 0.2;               // of the plane around it
  Material board_material{0, 0.015, 12};  // paper: nearly matt; its albedo is the print
  // What surfaces reflect; null: none does.
  std::shared_ptr<const Environment> environment, environment_with_lamps;
  std::vector<SceneView> views;
};

// InputError: options out of bounds, no object, an object without triangles, a photograph that
// cannot be read.
SimulatedScene make_scene(std::span<const Object> objects, const RenderOptions& options,
                          const SceneFiles& files = {});

}  // namespace edgescout
