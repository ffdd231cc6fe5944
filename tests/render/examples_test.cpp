// The files under docs/examples are what today's code makes and reads.
#include <gtest/gtest.h>

#include <algorithm>

#include "host/io/bop.h"
#include "host/io/image.h"
#include "host/io/mesh.h"
#include "host/render/parts.h"
#include "host/render/raster.h"
#include "kernels/thread_pool.h"
#include "tests/examples.h"

namespace edgescout {
namespace {

namespace fs = std::filesystem;

using test::examples;

TEST(Examples, PartsAreThoseOfTheCode) {
  const std::map<int, Symmetries> symmetries =
      load_symmetries(examples() / "parts/models_info.json");
  for (const std::string& name : part_names()) {
    const Object part = make_part(name);
    const fs::path file = examples() / ("parts/obj_00000" + std::to_string(part.id) + ".ply");
    const Mesh mesh = load_mesh(file, LengthUnit::Millimetre);
    ASSERT_EQ(mesh.vertices_m.size(), part.mesh.vertices_m.size()) << name;
    EXPECT_EQ(mesh.triangles.size(), part.mesh.triangles.size()) << name;
    EXPECT_NEAR(mesh.diameter_m, part.mesh.diameter_m, 1e-7) << name;
    EXPECT_EQ(symmetries.at(part.id).discrete.size(), part.symmetries.discrete.size()) << name;
  }
}

// Pixels on one side of an outline differ from those on the other where the truth is right: the
// mean step of grey over the silhouettes of well visible parts is far larger than over the same
// outlines moved by 6 px.
double mean_step(const Image& image, const std::vector<int>& owner, int shift) {
  double sum = 0;
  int count = 0;
  for (int y = 8; y < image.height - 8; ++y)
    for (int x = 8; x < image.width - 8; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * image.width + x;
      if ((owner[i - 2] >= 0) == (owner[i + 2] >= 0)) continue;
      sum += std::abs(int(image.at(x + shift - 2, y)) - int(image.at(x + shift + 2, y)));
      ++count;
    }
  return sum / std::max(1, count);
}

TEST(Examples, TruthLiesOnTheImages) {
  std::map<int, Object> parts;
  for (const std::string& name : part_names()) parts[make_part(name).id] = make_part(name);
  ThreadPool pool(1);
  int images = 0;
  for (const char* folder : {"scenes/000000", "scenes/000001"}) {
    const BopScene scene = load_bop_scene(examples() / folder);
    for (const BopImage& bop : scene.images) {
      const Image image = load_image(bop.file);
      Camera camera = bop.camera;
      camera.width = image.width;
      camera.height = image.height;
      EXPECT_TRUE(bop.camera_from_world.has_value());
      Triangles triangles;
      for (const BopTruth& truth : scene.truth.at(bop.image_id))
        triangles.add(parts.at(truth.object_id).mesh, truth.camera_from_object);
      EXPECT_EQ(scene.truth.at(bop.image_id).size(), 8u);
      const Raster raster = rasterize(triangles, camera, Se3{}, pool);
      const double there = mean_step(image, raster.triangle, 0);
      EXPECT_GT(there, 1.5 * mean_step(image, raster.triangle, 6)) << bop.file;
      EXPECT_GT(there, 1.5 * mean_step(image, raster.triangle, -6)) << bop.file;
      ++images;
    }
  }
  EXPECT_EQ(images, 3);
}

}  // namespace
}  // namespace edgescout
