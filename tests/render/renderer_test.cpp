#include "host/render/renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/render/parts.h"
#include "host/render/solid.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

std::vector<Object> objects() {
  return {make_part("l_bracket"), make_part("gear_plate"), make_part("stepped_shaft")};
}

RenderOptions small_options() {
  RenderOptions options;
  options.seed = 5;
  options.width = 161;
  options.height = 120;
  options.focal_px = 180;
  options.objects = 5;
  options.views = 2;
  options.pile = 0.7;
  return options;
}

// One object, seen alone, from straight above, with nothing random.
SimulatedScene plain_scene(const Mesh& mesh, const Se3& world_from_object, double camera_height_m) {
  RenderOptions options = small_options();
  options.noise_grey = 0;
  options.blur_px = 0;
  SimulatedScene scene;
  scene.options = options;
  Object object;
  object.mesh = mesh;
  scene.objects = {object};
  scene.placed.push_back({0, world_from_object, {}, true});
  scene.lights.push_back({{0.5, 0.3, 2}, 0.8});
  scene.board = {2, 2, {100, 100, 100, 100}};
  scene.board_side_m = 0.1;
  SceneView view;
  view.camera.width = options.width;
  view.camera.height = options.height;
  view.camera.fx = view.camera.fy = options.focal_px;
  view.camera.cx = 80;
  view.camera.cy = 60;
  view.camera_from_world.rotation = so3_exp({3.14159265358979, 0, 0});
  view.camera_from_world.translation_m = {0, 0, camera_height_m};
  scene.views = {view};
  return scene;
}

// Nearest triangle along a ray by brute force (Moeller and Trumbore): depth (the ray's z is 1) and
// owner.
std::pair<double, int> cast(const SimulatedScene& scene, const SceneView& view,
                            const Eigen::Vector3d& ray) {
  double nearest = std::numeric_limits<double>::infinity();
  int owner = -1;
  for (std::size_t p = 0; p < scene.placed.size(); ++p) {
    const Mesh& mesh = scene.objects[scene.placed[p].object].mesh;
    const Se3 pose = view.camera_from_world * scene.placed[p].world_from_object;
    for (const auto& [ia, ib, ic] : mesh.triangles) {
      const Eigen::Vector3d a = pose * mesh.vertices_m[ia], e1 = pose * mesh.vertices_m[ib] - a,
                            e2 = pose * mesh.vertices_m[ic] - a;
      const Eigen::Vector3d n = ray.cross(e2), q = (-a).cross(e1);
      const double determinant = e1.dot(n);
      if (determinant == 0) continue;
      const double u = -a.dot(n) / determinant, v = ray.dot(q) / determinant,
                   t = e2.dot(q) / determinant;
      if (u < 0 || v < 0 || u + v > 1 || t <= 0 || t >= nearest) continue;
      nearest = t;
      owner = static_cast<int>(p);
    }
  }
  return {nearest, owner};
}

TEST(Render, DepthAndOwnersAreThoseOfRays) {
  const SimulatedScene scene = make_scene(objects(), small_options());
  ThreadPool pool(2);
  const std::vector<Rendering> renderings = render(scene, pool);
  ASSERT_EQ(renderings.size(), 2u);
  for (std::size_t v = 0; v < 2; ++v) {
    const SceneView& view = scene.views[v];
    const Se3 world_from_camera = inverse(view.camera_from_world);
    int owned = 0, disagreeing = 0;
    for (int y = 0; y < view.camera.height; y += 3)
      for (int x = 0; x < view.camera.width; x += 3) {
        const Eigen::Vector3d ray = ray_through(view.camera, Eigen::Vector2d(x, y));
        auto [depth, owner] = cast(scene, view, ray);
        if (owner < 0)
          depth = -world_from_camera.translation_m.z() / (world_from_camera.rotation * ray).z();
        const std::size_t i = static_cast<std::size_t>(y) * view.camera.width + x;
        owned += owner >= 0;
        // A ray through a shared edge may slip to either side of it.
        if (renderings[v].placed[i] != owner) {
          ++disagreeing;
        } else {
          EXPECT_NEAR(renderings[v].depth_m[i], depth, 1e-5 * depth) << x << ", " << y;
        }
      }
    EXPECT_GT(owned, 100);
    EXPECT_LE(disagreeing, 2);
  }
}

TEST(Render, VerticesOfTheTruthFallOnTheirMask) {
  const Object part = make_part("hex_nut");
  const Se3 pose{so3_exp({0.4, -0.3, 0.2}), {0.01, -0.005, 0.03}};
  const SimulatedScene scene = plain_scene(part.mesh, pose, 0.3);
  ThreadPool pool(1);
  const Rendering rendering = render(scene, pool).front();
  const auto covered = [&](int x, int y) {
    return rendering.placed[static_cast<std::size_t>(y) * 161 + x] == 0;
  };
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const Eigen::Vector3d& v : part.mesh.vertices_m) {
    const Eigen::Vector2d p =
        project(scene.views[0].camera, scene.views[0].camera_from_world * (pose * v));
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    bool touched = false;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        touched |= covered(static_cast<int>(std::lround(p.x())) + dx,
                           static_cast<int>(std::lround(p.y())) + dy);
    EXPECT_TRUE(touched) << p.transpose();
  }
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 161; ++x)
      if (covered(x, y)) {
        EXPECT_TRUE(x >= low.x() && x <= high.x() && y >= low.y() && y <= high.y());
      }
}

TEST(Render, VisibleFractionIsThatOfAKnownOverlap) {
  // A square of 40 mm, half covered by another at 0.1 m above it that seems just as large.
  SimulatedScene scene = plain_scene(make_box({0.04, 0.04, 0.002}),
                                     {Eigen::Quaterniond::Identity(), {0, 0, 0.001}}, 0.4);
  const double scale = (0.4 - 0.101) / (0.4 - 0.002);
  Object cover;
  cover.mesh = make_box({0.04 * scale, 0.04 * scale, 0.002});
  scene.objects.push_back(cover);
  scene.placed.push_back({1, {Eigen::Quaterniond::Identity(), {0.02 * scale, 0, 0.1}}, {}, true});
  ThreadPool pool(1);
  const Rendering rendering = render(scene, pool).front();
  EXPECT_NEAR(rendering.visible_fraction[0], 0.5, 0.06);
  EXPECT_DOUBLE_EQ(rendering.visible_fraction[1], 1);
}

// Its silhouette is 170,000 px wide: no memory holds it.
TEST(Render, APartThatTouchesTheCameraIsHardlyVisible) {
  const SimulatedScene scene =
      plain_scene(make_box({1, 1, 0.002}),
                  {Eigen::Quaterniond::Identity(), {0, 0, 0.4 - 0.00105 - 0.001}}, 0.4);
  ThreadPool pool(1);
  const Camera& camera = scene.views[0].camera;
  const double side_px = camera.fx / 0.00105;
  const double expected = camera.width * camera.height / (side_px * side_px);
  EXPECT_NEAR(render(scene, pool).front().visible_fraction[0] / expected, 1, 0.01);
}

TEST(Render, WhatLeavesTheImageIsNotVisible) {
  const SimulatedScene half =
      plain_scene(make_box({0.04, 0.04, 0.002}),
                  {Eigen::Quaterniond::Identity(), {80.5 / 180 * 0.398, 0, 0.001}}, 0.4);
  ThreadPool pool(1);
  EXPECT_NEAR(render(half, pool).front().visible_fraction[0], 0.5, 0.06);
  const SimulatedScene outside = plain_scene(make_box({0.04, 0.04, 0.002}),
                                             {Eigen::Quaterniond::Identity(), {1, 0, 0.001}}, 0.4);
  EXPECT_DOUBLE_EQ(render(outside, pool).front().visible_fraction[0], 0);
}

TEST(Render, CastsShadowsOnlyWhereAsked) {
  SimulatedScene scene = plain_scene(make_box({0.02, 0.02, 0.02}),
                                     {Eigen::Quaterniond::Identity(), {0, 0, 0.05}}, 0.4);
  scene.lights = {{{1, 0, 1}, 0.8}};
  scene.desk_albedo = 100 / 255.0;
  ThreadPool pool(1);
  // The middle of the shadow, 50 mm to the left of the box.
  const Eigen::Vector2d p = project(
      scene.views[0].camera, scene.views[0].camera_from_world * Eigen::Vector3d(-0.05, 0, 0));
  const auto grey = [&] {
    return int(
        render(scene, pool).front().image.at(static_cast<int>(p.x()), static_cast<int>(p.y())));
  };
  const int shaded = grey();
  scene.options.shadows = false;
  EXPECT_LT(shaded + 50, grey());
}

TEST(Render, IsTheSameForTheSameSeedOnAnyNumberOfThreads) {
  ThreadPool one(1), three(3);
  const std::vector<Rendering> a = render(make_scene(objects(), small_options()), one);
  const std::vector<Rendering> b = render(make_scene(objects(), small_options()), three);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t v = 0; v < a.size(); ++v) {
    EXPECT_EQ(a[v].image.pixels, b[v].image.pixels);
    EXPECT_EQ(a[v].placed, b[v].placed);
    EXPECT_EQ(a[v].depth_m, b[v].depth_m);
    EXPECT_EQ(a[v].visible_fraction, b[v].visible_fraction);
  }
  RenderOptions other = small_options();
  ++other.seed;
  EXPECT_NE(render(make_scene(objects(), other), one)[0].image.pixels, a[0].image.pixels);
}

TEST(Render, NoiseAndBlurDoWhatTheySay) {
  SimulatedScene scene = plain_scene(make_box({0.001, 0.001, 0.001}),
                                     {Eigen::Quaterniond::Identity(), {0.5, 0.5, 0}}, 0.4);
  scene.board_side_m = 5;
  scene.options.shadows = false;
  ThreadPool pool(1);
  const std::vector<std::uint8_t> clean = render(scene, pool).front().image.pixels;
  scene.options.noise_grey = 5;
  const std::vector<std::uint8_t> noisy = render(scene, pool).front().image.pixels;
  double squares = 0;
  for (std::size_t i = 0; i < clean.size(); ++i)
    squares += std::pow(double(noisy[i]) - clean[i], 2);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(clean.size())), 5, 0.2);
}

TEST(SimulatedScene, ClutterAddsForeignPartsAndPrint) {
  for (const auto& [clutter, foreign] : {std::pair{0, 0}, {1, 3}, {2, 8}}) {
    RenderOptions options = small_options();
    options.clutter = clutter;
    const SimulatedScene scene = make_scene(objects(), options);
    int targets = 0;
    for (const PlacedObject& part : scene.placed) targets += part.target;
    EXPECT_EQ(targets, 5);
    EXPECT_EQ(static_cast<int>(scene.placed.size()) - targets, foreign);
  }
}

TEST(SimulatedScene, DealsInstancesEvenly) {
  RenderOptions options = small_options();
  options.objects = 7;
  int counts[3] = {};
  for (const PlacedObject& part : make_scene(objects(), options).placed)
    if (part.target) ++counts[part.object];
  for (const int count : counts) EXPECT_TRUE(count == 2 || count == 3);
}

// CAD files have their origin anywhere: parts lie in the same heap, before the same cameras.
TEST(SimulatedScene, LaysPartsTheSameWhereverTheirOriginLies) {
  RenderOptions options = small_options();
  options.objects = 6;
  options.pile = 0.7;
  const std::vector<Object> here = objects();
  std::vector<Object> elsewhere = here;
  const Eigen::Vector3d shift_m(0.3, -0.2, 0.25);
  for (Object& object : elsewhere) {
    for (Eigen::Vector3d& vertex_m : object.mesh.vertices_m) vertex_m += shift_m;
    object.mesh.box_min_m += shift_m, object.mesh.box_max_m += shift_m;
  }
  const SimulatedScene a = make_scene(here, options), b = make_scene(elsewhere, options);
  ASSERT_EQ(a.placed.size(), b.placed.size());
  for (std::size_t i = 0; i < a.placed.size(); ++i) {
    if (!a.placed[i].target) continue;
    // rounding moves contact by a cell at most
    EXPECT_LT((a.placed[i].world_from_object * Eigen::Vector3d::Zero() -
               b.placed[i].world_from_object * shift_m)
                  .norm(),
              0.25 * here[static_cast<std::size_t>(a.placed[i].object)].mesh.diameter_m)
        << i;
  }
  EXPECT_NEAR(a.views[0].camera_from_world.translation_m.norm(),
              b.views[0].camera_from_world.translation_m.norm(),
              0.1 * a.views[0].camera_from_world.translation_m.norm());
}

TEST(SimulatedScene, KeepsCamerasWhereAsked) {
  RenderOptions options = small_options();
  options.views = 12;
  options.min_distance_m = 0.3;
  options.max_distance_m = 0.6;
  options.min_elevation_deg = 50;
  options.max_elevation_deg = 60;
  for (const SceneView& view : make_scene(objects(), options).views) {
    const Se3 world_from_camera = inverse(view.camera_from_world);
    const Eigen::Vector3d eye = world_from_camera.translation_m,
                          forward = world_from_camera.rotation * Eigen::Vector3d::UnitZ();
    const double elevation = std::asin(-forward.z()) * 180 / 3.14159265358979;
    EXPECT_GT(elevation, 50 - 1e-6);
    EXPECT_LT(elevation, 60 + 1e-6);
    const double distance = eye.z() / -forward.z();  // to what the camera looks at on the board
    EXPECT_GT(distance, 0.3 - 1e-9);
    EXPECT_LT(distance, 0.6 + 1e-9);
  }
}

TEST(RenderOptions, OutOfRangeIsRefusedByName) {
  const auto refused = [](auto change) {
    RenderOptions options;
    change(options);
    try {
      options.validate();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refused([](RenderOptions& o) { o.objects = 21; }).find("objects"), std::string::npos);
  EXPECT_NE(refused([](RenderOptions& o) { o.clutter = -1; }).find("clutter"), std::string::npos);
  EXPECT_NE(refused([](RenderOptions& o) { o.blur_px = std::nan(""); }).find("blur_px"),
            std::string::npos);
  EXPECT_NE(refused([](RenderOptions& o) { o.supersampling = 2; }).find("supersampling"),
            std::string::npos);
  EXPECT_NE(refused([](RenderOptions& o) { o.max_elevation_deg = 20; }).find("max_elevation_deg"),
            std::string::npos);
  EXPECT_NE(refused([](RenderOptions& o) { o.max_distance_m = 1; }).find("min_distance_m"),
            std::string::npos);
  EXPECT_EQ(refused([](RenderOptions&) {}), "");
  EXPECT_THROW(make_scene({}, RenderOptions{}), InputError);
  EXPECT_THROW(make_scene(std::vector{Object{}}, RenderOptions{}), InputError);
}

}  // namespace
}  // namespace edgescout
