#include "host/render/write_bop.h"

#include <gtest/gtest.h>

#include "host/io/bop.h"
#include "host/io/image.h"
#include "host/io/mesh.h"
#include "host/render/parts.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {
namespace {

namespace fs = std::filesystem;

class WriteBop : public testing::Test {
 protected:
  WriteBop() {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::path(testing::TempDir()) / ("edgescout_write_bop_" + name);
    fs::remove_all(folder_);
  }
  ~WriteBop() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(WriteBop, SceneReadsBack) {
  const std::vector<Object> objects{make_part("hex_nut"), make_part("u_channel")};
  RenderOptions options;
  options.width = 128;
  options.height = 96;
  options.focal_px = 140;
  options.objects = 4;
  options.views = 3;
  ThreadPool pool(2);
  const SimulatedScene scene = make_scene(objects, options);
  const std::vector<Rendering> renderings = render(scene, pool);
  write_bop_scene(scene, renderings, folder_ / "000007");

  ASSERT_TRUE(is_bop_scene(folder_ / "000007"));
  const BopScene back = load_bop_scene(folder_ / "000007");
  EXPECT_EQ(back.scene_id, 7);
  ASSERT_EQ(back.images.size(), 3u);
  for (std::size_t v = 0; v < 3; ++v) {
    EXPECT_EQ(load_image(back.images[v].file).pixels, renderings[v].image.pixels);
    EXPECT_NEAR(back.images[v].camera.fx, 140, 1e-9);
    EXPECT_NEAR(back.images[v].camera.cx, 63.5, 1e-9);
    const Se3& camera_from_world = scene.views[v].camera_from_world;
    ASSERT_TRUE(back.images[v].camera_from_world.has_value());
    EXPECT_LT(local_coordinates(*back.images[v].camera_from_world, camera_from_world).norm(), 1e-9);
    const std::vector<BopTruth>& truth = back.truth.at(static_cast<int>(v));
    ASSERT_EQ(truth.size(), 4u) << "targets only";
    std::size_t t = 0;
    for (std::size_t p = 0; p < scene.placed.size(); ++p) {
      if (!scene.placed[p].target) continue;
      EXPECT_EQ(truth[t].object_id, scene.objects[scene.placed[p].object].id);
      EXPECT_LT(local_coordinates(truth[t].camera_from_object,
                                  camera_from_world * scene.placed[p].world_from_object)
                    .norm(),
                1e-9);
      EXPECT_NEAR(truth[t].visible_fraction, renderings[v].visible_fraction[p], 1e-12);
      ++t;
    }
  }
}

TEST_F(WriteBop, ModelsReadBack) {
  std::vector<Object> objects;
  for (const std::string& name : part_names()) objects.push_back(make_part(name));
  write_bop_models(objects, turning_axes(objects), folder_);
  const std::map<int, Symmetries> symmetries = load_symmetries(folder_ / "models_info.json");
  ASSERT_EQ(symmetries.size(), objects.size());
  for (const Object& object : objects) {
    const Mesh mesh = load_mesh(folder_ / ("obj_00000" + std::to_string(object.id) + ".ply"),
                                LengthUnit::Millimetre);
    EXPECT_EQ(mesh.triangles.size(), object.mesh.triangles.size());
    EXPECT_NEAR(mesh.diameter_m, object.mesh.diameter_m, 1e-7);
    // The same group, in whatever order.
    const std::vector<Se3>& group = symmetries.at(object.id).discrete;
    ASSERT_EQ(group.size(), object.symmetries.discrete.size()) << object.mesh.name;
    for (const Se3& member : object.symmetries.discrete) {
      double nearest = 10;
      for (const Se3& back : group)
        nearest = std::min(nearest, local_coordinates(back, member).norm());
      EXPECT_LT(nearest, 1e-9) << object.mesh.name;
    }
  }
}

TEST_F(WriteBop, RefusesAFolderItCannotWrite) {
  fs::create_directories(folder_);
  save_png(Image{16, 16, std::vector<std::uint8_t>(256, 0)}, folder_ / "file");
  EXPECT_THROW(write_bop_models(std::vector{make_part("hex_nut")}, {}, folder_ / "file" / "models"),
               InputError);
}

}  // namespace
}  // namespace edgescout
