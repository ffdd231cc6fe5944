// What the ranges change in a scene and in its images.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "host/io/image.h"
#include "host/render/parts.h"
#include "host/render/photographs.h"
#include "host/render/renderer.h"
#include "kernels/thread_pool.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

std::vector<Object> one_model() { return {make_part("l_bracket")}; }

RenderOptions small_scene(unsigned seed = 5) {
  RenderOptions options;
  options.seed = seed;
  options.width = 160;
  options.height = 120;
  options.focal_px = 180;
  options.objects = 4;
  options.clutter = 0;
  return options;
}

Image image_of(const SimulatedScene& scene) {
  ThreadPool pool(2);
  return render(scene, pool).front().image;
}

double mean_of(const Image& image) {
  double sum = 0;
  for (const std::uint8_t grey : image.pixels) sum += grey;
  return sum / static_cast<double>(image.pixels.size());
}

double deviation_of(const Image& image) {
  const double mean = mean_of(image);
  double sum = 0;
  for (const std::uint8_t grey : image.pixels) sum += (grey - mean) * (grey - mean);
  return std::sqrt(sum / static_cast<double>(image.pixels.size()));
}

// Every range at once, for tests of what must hold with all of it.
RenderOptions everything(unsigned seed) {
  RenderOptions options = small_scene(seed);
  options.clutter = 1;
  options.clutter_ranges.occluders = {1, 2};
  options.clutter_ranges.span_px = {30, 60};
  options.surfaces.metal = 0.5;
  options.surfaces.anisotropy = {0, 0.9};
  options.surfaces.gloss = {0.02, 0.1};
  options.surfaces.board_gloss = {0, 0.1};
  options.surfaces.albedo = {0.05, 0.8};
  options.light.lamp_width = {0.05, 0.4};
  options.light.lamp_share = {0.2, 0.8};
  options.camera.brightness = {0.3, 1.5};
  options.camera.contrast = {0.3, 1.1};
  options.camera.gamma = {1.8, 2.6};
  options.camera.lens_residue_px = {-1, 1};
  options.camera.defocus_px = {0, 2};
  options.camera.motion_px = {0, 3};
  options.camera.vignetting = {0, 0.4};
  options.camera.noise_grey = {0, 5};
  options.camera.sharpening = {0, 2};
  options.camera.jpeg_quality = {40, 95};
  return options;
}

// Photographs with texture, as files.
struct PhotographFolder {
  PhotographFolder() {
    for (int i = 0; i < 3; ++i) {
      Image image{120, 90, {}};
      for (int y = 0; y < 90; ++y)
        for (int x = 0; x < 120; ++x)
          image.pixels.push_back(static_cast<std::uint8_t>(((x / (7 + i) + y / 5) % 2) * 200 + 20));
      save_png(image, folder.path() / (std::to_string(i) + ".png"));
    }
    files = list_photographs(folder.path());
  }
  TemporaryFolder folder;
  PhotographFolders files;
};

TEST(SceneRanges, AreTheSameForTheSameSeedOnAnyNumberOfThreads) {
  const PhotographFolder photographs;
  SceneFiles files;
  files.backgrounds = files.board_textures = files.environments = photographs.files;
  files.clutter = {make_part("hex_nut").mesh};
  ThreadPool one(1), three(3);
  const Rendering a = render(make_scene(one_model(), everything(7), files), one).front();
  const Rendering b = render(make_scene(one_model(), everything(7), files), three).front();
  const Rendering other = render(make_scene(one_model(), everything(8), files), one).front();
  EXPECT_EQ(a.image.pixels, b.image.pixels);
  EXPECT_EQ(a.visible_fraction, b.visible_fraction);
  EXPECT_NE(a.image.pixels, other.image.pixels);
}

// A range that is switched on leaves the poses, cameras and lights of the scene.
TEST(SceneRanges, OfTheCameraLeaveTheSceneAsItIs) {
  RenderOptions options = small_scene();
  const SimulatedScene before = make_scene(one_model(), options);
  options.camera = everything(5).camera;
  options.surfaces.albedo = {0.2, 0.3};
  const SimulatedScene after = make_scene(one_model(), options);
  ASSERT_EQ(before.placed.size(), after.placed.size());
  for (std::size_t i = 0; i < before.placed.size(); ++i)
    EXPECT_EQ(
        distance_between_m(before.placed[i].world_from_object, after.placed[i].world_from_object),
        0);
  EXPECT_EQ(before.board.pixels, after.board.pixels);
  EXPECT_EQ(distance_between_m(before.views[0].camera_from_world, after.views[0].camera_from_world),
            0);
}

TEST(SceneRanges, BrightnessAndContrastGoDownToNearlyNone) {
  RenderOptions options = small_scene();
  options.noise_grey = 0;
  const Image plain = image_of(make_scene(one_model(), options));
  options.camera.contrast = {0.02, 0.02};
  const Image flat = image_of(make_scene(one_model(), options));
  EXPECT_LT(deviation_of(flat), 0.05 * deviation_of(plain));
  EXPECT_NEAR(mean_of(flat), mean_of(plain), 20);
  options.camera.contrast = {1, 1};
  options.camera.brightness = {0.02, 0.02};
  const Image dark = image_of(make_scene(one_model(), options));
  EXPECT_NEAR(mean_of(dark) / mean_of(plain), std::pow(0.02, 1 / 2.2), 0.02);
}

TEST(SceneRanges, SpanSetsTheSizeOfTheParts) {
  RenderOptions options = small_scene();
  options.width = 640;
  options.height = 480;
  options.focal_px = 700;
  options.views = 10;
  options.clutter_ranges.span_px = {40, 80};
  const std::vector<Object> models = one_model();
  const SimulatedScene scene = make_scene(models, options);
  double smallest = 1e9, largest = 0;
  for (const SceneView& view : scene.views) {
    double nearest_px = 1e9;
    for (const PlacedObject& part : scene.placed) {
      const Eigen::Vector3d x = view.camera_from_world * part.world_from_object.translation_m;
      const double span = view.camera.fx * models[0].mesh.diameter_m / x.z();
      smallest = std::min(smallest, span);
      largest = std::max(largest, span);
      nearest_px =
          std::min(nearest_px, (project(view.camera, x) - Eigen::Vector2d(320, 240)).norm());
    }
    EXPECT_LT(nearest_px, 320) << "a part is in the image";
  }
  EXPECT_GT(smallest, 40 * 0.75) << "parts lie before and behind the one that is looked at";
  EXPECT_LT(largest, 80 * 1.35);
  EXPECT_GT(largest, 1.3 * smallest);
}

TEST(SceneRanges, ClutterComesFromFilesInTheSizeThatIsAskedFor) {
  SceneFiles files;
  files.clutter = {make_part("hex_nut").mesh, make_part("gear_plate").mesh};
  for (Mesh& mesh : files.clutter) {  // a file in another unit
    for (Eigen::Vector3d& vertex_m : mesh.vertices_m) vertex_m *= 1000;
    mesh.box_min_m *= 1000, mesh.box_max_m *= 1000, mesh.diameter_m *= 1000;
  }
  RenderOptions options = small_scene();
  options.clutter_ranges.file_parts = {4, 6};
  options.clutter_ranges.size = {0.5, 0.8};
  const std::vector<Object> models = one_model();
  std::set<std::size_t> counts;
  for (options.seed = 1; options.seed < 12; ++options.seed) {
    const SimulatedScene scene = make_scene(models, options, files);
    std::size_t foreign = 0;
    for (const PlacedObject& part : scene.placed) {
      if (part.target) continue;
      ++foreign;
      const double ratio = scene.objects[part.object].mesh.diameter_m / models[0].mesh.diameter_m;
      EXPECT_GE(ratio, 0.5);
      EXPECT_LE(ratio, 0.8);
      EXPECT_LT(part.world_from_object.translation_m.norm(), 0.5) << "on the board";
    }
    counts.insert(foreign);
  }
  EXPECT_EQ(counts, (std::set<std::size_t>{4, 5, 6}));
}

// Silhouettes do not know of occluders: what is hidden is missing from the visible fraction.
TEST(SceneRanges, OccludersHideParts) {
  RenderOptions options = small_scene();
  options.objects = 1;
  double without = 0, with = 0;
  ThreadPool pool(2);
  for (options.seed = 1; options.seed <= 6; ++options.seed) {
    options.clutter_ranges.occluders = {0, 0};
    without += render(make_scene(one_model(), options), pool).front().visible_fraction[0];
    options.clutter_ranges.occluders = {3, 3};
    const SimulatedScene scene = make_scene(one_model(), options);
    const Rendering rendering = render(scene, pool).front();
    with += rendering.visible_fraction[0];
    int hanging = 0;
    for (const PlacedObject& part : scene.placed) hanging += part.hangs;
    EXPECT_EQ(hanging, 3);
  }
  EXPECT_GT(without, 5.5);
  EXPECT_LT(with, 0.85 * without);
  EXPECT_GT(with, 0.1);
}

TEST(SceneRanges, ABackgroundIsSeenBesideTheBoard) {
  const PhotographFolder photographs;
  SceneFiles files;
  files.backgrounds = photographs.files;
  RenderOptions options = small_scene(2);
  options.noise_grey = options.blur_px = 0;
  options.shadows = false;
  const SimulatedScene scene = make_scene(one_model(), options, files);
  const Image& photograph = scene.views[0].background;
  ASSERT_EQ(photograph.width, 160);
  ThreadPool pool(2);
  const Rendering rendering = render(scene, pool).front();
  int same = 0, beside = 0;
  for (std::size_t i = 0; i < photograph.pixels.size(); ++i) {
    if (rendering.placed[i] >= 0) continue;
    ++beside;
    same += std::abs(int(rendering.image.pixels[i]) - int(photograph.pixels[i])) <= 1;
  }
  EXPECT_GT(beside, 5000);
  EXPECT_GT(same, beside / 4);
}

TEST(SceneRanges, PartsCastShadowsOnTheBackground) {
  const PhotographFolder photographs;
  SceneFiles files;
  files.backgrounds = photographs.files;
  RenderOptions options = small_scene(2);
  const SimulatedScene lit = make_scene(one_model(), options, files);
  options.shadows = false;
  EXPECT_LT(mean_of(image_of(lit)) + 1, mean_of(image_of(make_scene(one_model(), options, files))));
}

TEST(SceneRanges, SharesLeaveScenesPlain) {
  const PhotographFolder photographs;
  SceneFiles files;
  files.backgrounds = files.board_textures = photographs.files;
  RenderOptions options = small_scene();
  options.clutter_ranges.background_share = 0.5;
  options.clutter_ranges.board_texture_share = 0;
  int with = 0;
  for (options.seed = 0; options.seed < 30; ++options.seed)
    with += !make_scene(one_model(), options, files).views[0].background.pixels.empty();
  EXPECT_GT(with, 6);
  EXPECT_LT(with, 24);
  options.clutter_ranges.background_share = 0;
  EXPECT_EQ(make_scene(one_model(), options, files).board.pixels,
            make_scene(one_model(), options).board.pixels);
}

TEST(SceneRanges, ABoardShowsItsPhotograph) {
  const PhotographFolder photographs;
  SceneFiles files;
  files.board_textures = photographs.files;
  const SimulatedScene plain = make_scene(one_model(), small_scene()),
                       textured = make_scene(one_model(), small_scene(), files);
  EXPECT_GT(deviation_of(textured.board), 3 * deviation_of(plain.board));
}

TEST(SceneRanges, MetalChangesWithTheView) {
  RenderOptions options = small_scene();
  options.surfaces.metal = 1;
  const SimulatedScene scene = make_scene(one_model(), options);
  ASSERT_TRUE(scene.environment);
  for (const PlacedObject& part : scene.placed) EXPECT_GT(part.material.reflectance, 0);
  EXPECT_FALSE(make_scene(one_model(), small_scene()).environment);
}

// The share of the pixels that a part covers whatever its surface, light and camera.
TEST(SceneRanges, VisibleFractionsDoNotDependOnTheLook) {
  RenderOptions options = small_scene();
  ThreadPool pool(2);
  const std::vector<double> plain =
      render(make_scene(one_model(), options), pool).front().visible_fraction;
  const RenderOptions all = everything(5);
  options.surfaces = all.surfaces;
  options.light = all.light;
  options.camera = all.camera;
  EXPECT_EQ(render(make_scene(one_model(), options), pool).front().visible_fraction, plain);
}

TEST(SceneRanges, WideLampsSoftenShadows) {
  RenderOptions options = small_scene();
  options.light.lamp_share = {1, 1};
  const auto lamps_of = [&](double width) {
    options.light.lamp_width = {width, width};
    const SimulatedScene made = make_scene(one_model(), options);
    double spread = 0;
    for (const Light& light : made.lights)
      if (light.irradiance > 0)
        spread = std::max(spread, (light.position_m - made.lights[0].position_m).norm() /
                                      light.position_m.norm());
    return spread;
  };
  EXPECT_GT(lamps_of(0.3), lamps_of(0.01));
}

TEST(SceneRanges, OutOfBoundsAreRefusedByName) {
  const auto refused = [](auto change, std::initializer_list<std::string> words) {
    RenderOptions options;
    change(options);
    expect_input_error([&] { options.validate(); }, words);
  };
  refused([](RenderOptions& o) { o.camera.jpeg_quality = {90, 30}; }, {"camera.jpeg", "90", "30"});
  refused([](RenderOptions& o) { o.camera.vignetting = {0, 1}; }, {"camera.vignetting"});
  refused([](RenderOptions& o) { o.camera.defocus_px = {0, NAN}; }, {"camera.defocus"});
  refused([](RenderOptions& o) { o.surfaces.metal = 1.5; }, {"surfaces.metal"});
  refused([](RenderOptions& o) { o.surfaces.roughness = {0, 0.4}; }, {"surfaces.roughness"});
  refused([](RenderOptions& o) { o.light.lamp_share = {0, 2}; }, {"light.lamp_share"});
  refused([](RenderOptions& o) { o.clutter_ranges.span_px = {0, 50}; }, {"span_px"});
}

}  // namespace
}  // namespace edgescout::test
