// Scenes with known poses: parts lying or piled on a printed board, lights, and cameras on a
// hemisphere.
//
// World frame: the board is the plane z = 0, +z up, metres. A scene is fully determined by its
// objects and options.
#pragma once

#include <span>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

struct RenderOptions {
  unsigned seed = 1;
  int width = 1024;
  int height = 768;
  double focal_px = 1200;
  int objects = 8;    // instances, dealt evenly over the models; [1, 20]
  int views = 1;      // [1, 50]
  int clutter = 1;    // 0: bare board; 1: printed shapes and 3 foreign parts; 2: many and 8
  double pile = 0.5;  // 0: apart, nothing hides anything; 1: all dropped on one heap
  double min_elevation_deg = 35;  // of the cameras over the board; [10, 90]
  double max_elevation_deg = 80;
  double min_distance_m =
      0;  // camera to the middle of the parts; both 0: so that they fill the image
  double max_distance_m = 0;
  double blur_px = 0.6;   // standard deviation of a Gaussian; [0, 10]
  double noise_grey = 2;  // the same, grey levels; [0, 50]
  int supersampling =
      3;  // samples a pixel and axis; odd, so that one sits on the pixel's centre; [1, 7]
  bool shadows = true;
  // Throws InputError naming the field and the violated bound.
  void validate() const;
};

struct Material {
  double albedo = 0.3;    // diffuse reflectance, linear
  double specular = 0.1;  // strength of the Blinn-Phong highlight
  double shininess = 30;  // its exponent
};

struct PlacedObject {
  int object = 0;  // index into Scene::objects
  Se3 world_from_object;
  Material material;
  bool target = true;  // false: a foreign part, no ground truth is written
};

struct Light {
  Eigen::Vector3d position_m;
  // at the world's origin on a surface facing the light; falls with the squared distance
  double irradiance = 0;
  int shadow_px = 512;  // side of its shadow map: fewer, softer
};

struct SceneView {
  Camera camera;
  Se3 camera_from_world;
};

struct Scene {
  RenderOptions options;
  std::vector<Object> objects;  // the targets' models first, then the foreign parts'
  std::vector<PlacedObject> placed;
  std::vector<Light> lights;  // key lights as clusters of points, then the sky
  double ambient = 0.05;      // irradiance that comes from everywhere and casts no shadow
  Image board;  // print, albedo * 255, over the square of board_side_m about the origin
  double board_side_m = 0;
  Se3 world_from_board;      // turns and shifts it in its plane
  double desk_albedo = 0.2;  // of the plane around it
  std::vector<SceneView> views;
};

// InputError: options out of range, no object, an object without triangles.
Scene make_scene(std::span<const Object> objects, const RenderOptions& options);

}  // namespace edgescout
