// Images from files. One that cannot be read is an AcquisitionError.
#include "host/active/recorded_views.h"

#include <gtest/gtest.h>

#include "host/io/mesh.h"
#include "host/pipeline.h"
#include "host/register/pose_features.h"
#include "host/render/renderer.h"
#include "host/render/write_bop.h"
#include "kernels/thread_pool.h"
#include "tests/active/tiny_scene.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

namespace fs = std::filesystem;

struct Recorded {
  TemporaryFolder folder;
  SimulatedScene scene = tiny_scene(3);
  std::vector<Rendering> renderings;
  fs::path bop = folder.path() / "000004";
  Recorded() {
    ThreadPool pool(2);
    renderings = render(scene, pool);
    write_bop_scene(scene, renderings, bop);
  }
};

TEST(RecordedViews, AreThoseOfABopScene) {
  const Recorded t;
  RecordedViews source = load_recorded_views(t.bop);
  EXPECT_EQ(source.camera().width, 160);
  EXPECT_EQ(source.camera().fx, 200);
  ASSERT_EQ(source.views().size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const Shot shot = source.acquire(i);
    EXPECT_EQ(shot.image.pixels, t.renderings[i].image.pixels);
    EXPECT_LT(distance_between_m(shot.camera_from_world, t.scene.views[i].camera_from_world), 1e-9);
    EXPECT_LT(distance_between_m(source.views()[i], t.scene.views[i].camera_from_world), 1e-9);
  }
}

TEST(RecordedViews, AreReadWithTheOptionsOfImages) {
  const Recorded t;
  ImageOptions reading;
  reading.black_white = {0, 127.5};
  RecordedViews source = load_recorded_views(t.bop, {}, "", reading);
  const std::vector<std::uint8_t> pixels = source.acquire(0).image.pixels;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    ASSERT_NEAR(pixels[i], std::min(255, 2 * t.renderings[0].image.pixels[i]), 1);
}

TEST(RecordedViews, AnImageThatCannotBeReadIsAFailedAcquisition) {
  const Recorded t;
  fs::remove(t.bop / "gray/000000.png");
  t.folder.write("000004/gray/000001.png", "no image");
  RecordedViews source = load_recorded_views(t.bop);
  EXPECT_EQ(source.camera().height, 120) << "of the first image that can be read";
  EXPECT_THROW(source.acquire(0), AcquisitionError);
  EXPECT_THROW(source.acquire(1), AcquisitionError);
  EXPECT_EQ(source.acquire(2).image.width, 160);
}

TEST(RecordedViews, RefuseFoldersOfNoKnownForm) {
  const Recorded t;
  expect_input_error([&] { load_recorded_views(t.folder.path()); },
                     {"scene_camera.json", "CameraPose"});
  std::string cameras = content_of(t.bop / "scene_camera.json");
  t.folder.write("a/scene_camera.json",
                 std::string(cameras).replace(cameras.find("200.0"), 5, "201.0"));
  expect_input_error([&] { load_recorded_views(t.folder.path() / "a"); },
                     {"000001", "camera", "one camera"});
  cameras.replace(cameras.rfind("cam_R_w2c"), 9, "cam_R_xyz");
  t.folder.write("b/scene_camera.json", cameras);
  expect_input_error([&] { load_recorded_views(t.folder.path() / "b"); }, {"000002", "world pose"});
}

// The form of Castle-simu.
TEST(RecordedViews, AreThoseOfAVispFolder) {
  const Recorded t;
  Camera camera = t.scene.views[0].camera;
  const fs::path folder = t.folder.path() / "castle";
  t.folder.write("castle/CameraPose/Camera_001.txt",
                 "1 0 0 0.05\n0 -1 0 0.1\n0 0 -1 0.6\n0 0 0 1\n");
  t.folder.write("castle/CameraPose/Camera_002.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0.5\n0 0 0 1\n");
  fs::create_directories(folder / "Images");
  fs::copy_file(t.bop / "gray/000000.png", folder / "Images/Image_0002.pgm");
  RecordedViews source = load_recorded_views(folder, camera);
  ASSERT_EQ(source.views().size(), 2u);
  EXPECT_EQ(source.views()[0] * Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1.05, -1.9, -2.4));
  EXPECT_THROW(source.acquire(0), AcquisitionError);
  EXPECT_EQ(source.acquire(1).image.pixels, t.renderings[0].image.pixels);
  expect_input_error([&] { load_recorded_views(folder); }, {"castle", "camera"});
  // Numbers may be left out.
  t.folder.write("castle/CameraPose/Camera_017.txt", "1 0 0 7\n0 1 0 0\n0 0 1 0.5\n0 0 0 1\n");
  const RecordedViews gap = load_recorded_views(folder, camera);
  ASSERT_EQ(gap.views().size(), 3u);
  EXPECT_EQ(gap.recordings()[2].file.filename(), "Image_0017.pgm");
  EXPECT_EQ(gap.views()[2].translation_m.x(), 7);
  fs::remove(folder / "CameraPose/Camera_017.txt");
  t.folder.write("castle/CameraPose/Camera_002.txt", "1 0 0 0\n0 2 0 0\n0 0 1 0.5\n0 0 0 1\n");
  expect_input_error([&] { load_recorded_views(folder, camera); }, {"Camera_002.txt", "rotation"});
  t.folder.write("castle/CameraPose/Camera_002.txt", "1 0 0 0\n0 1 0\n");
  expect_input_error([&] { load_recorded_views(folder, camera); }, {"Camera_002.txt"});
}

// The folder itself, where Debian's package visp-images-data is installed: the castle's edges lie
// where its model has them, in every image.
TEST(RecordedViews, AreThoseOfTheCastle) {
  const fs::path folder = "/usr/share/visp-images-data/ViSP-images/mbt-depth/Castle-simu";
  if (!fs::exists(folder)) GTEST_SKIP() << "visp-images-data is not installed";
  const Camera camera{640, 480, 700, 700, 320, 240, {}};  // as its Config/chateau.xml says
  RecordedViews source = load_recorded_views(folder, camera);
  const std::vector<Se3> views = source.views();
  ASSERT_EQ(views.size(), 40u);
  const auto backend = make_cpu_backend(2);
  const std::vector<EdgeModel> models{
      make_edge_model(load_mesh(folder / "Models" / "chateau.cao", LengthUnit::Metre))};
  const std::vector<ObjectPose> poses{{0, Se3{}},
                                      {0, {Eigen::Quaterniond::Identity(), {0.01, 0.01, 0}}}};
  std::vector<StageSeconds> stages;
  double worst_px = 0;
  for (int v = 0; v < 40; v += 3) {
    const Shot shot = source.acquire(v);
    ObjectView view =
        prepare_view(shot.image, camera, shot.camera_from_world, *backend, {}, &stages);
    add_tensors(view, 1.0, *backend, {});
    const std::vector<PoseFeatures> features =
        pooled_features({models, {&view, 1}, *backend}, poses);
    EXPECT_GT(features[0].points, 100) << v;
    EXPECT_GT(features[1].mean_px, 1.5 * features[0].mean_px) << v;
    worst_px = std::max(worst_px, features[0].mean_px);
  }
  std::printf("at its place %.1f px at most\n", worst_px);
  EXPECT_LT(worst_px, 6);
}

}  // namespace
}  // namespace edgescout::test
