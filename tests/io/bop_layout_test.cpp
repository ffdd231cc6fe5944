// The folders of BOP's sets: where the files of each camera lie.
#include <gtest/gtest.h>

#include "host/io/bop.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

constexpr const char* pinhole = R"({"0": {"cam_K": [500,0,3,0,500,4,0,0,1]}})";

// The camera's files, with its focal length to tell it from others.
void write_camera(const TemporaryFolder& folder, const std::string& name, int focal_px) {
  const std::string f = std::to_string(focal_px);
  folder.write("scene_camera_" + name + ".json",
               R"({"0": {"cam_K": [)" + f + ",0,3,0," + f + ",4,0,0,1]}}");
  folder.write("scene_gt_" + name + ".json",
               R"({"0": [{"obj_id": )" + f +
                   R"(, "cam_R_m2c": [1,0,0,0,1,0,0,0,1], "cam_t_m2c": [0,0,500]}]})");
  folder.write("scene_gt_info_" + name + ".json", R"({"0": [{"visib_fract": 0.5}]})");
}

struct CameraFolder {
  const char* camera;
  const char* folder;
};

// IPD, XYZ-IBD, ITODD-MV, HOT3D, and those who name the folder as the camera.
TEST(BopLayout, HasTheImagesOfEachCameraInItsFolder) {
  const TemporaryFolder folder;
  int focal_px = 100;
  const std::vector<CameraFolder> all{
      {"3dlong", "gray_3dlong"},     {"cam1", "rgb_cam1"},           {"gray1", "gray1"},
      {"photoneo", "gray_photoneo"}, {"realsense", "rgb_realsense"}, {"rgb", "rgb"}};
  for (const CameraFolder& of : all) {
    write_camera(folder, of.camera, focal_px++);
    folder.write(std::string(of.folder) + "/000000.png", "");
    folder.write("depth_" + std::string(of.camera) + "/000000.png", "");
    folder.write("aolp_" + std::string(of.camera) + "/000000.png", "");
  }
  EXPECT_TRUE(is_bop_scene(folder.path()));
  std::vector<std::string> names;
  for (const CameraFolder& of : all) names.emplace_back(of.camera);
  EXPECT_EQ(bop_cameras(folder.path()), names);
  focal_px = 100;
  for (const CameraFolder& of : all) {
    const BopScene scene = load_bop_scene(folder.path(), of.camera);
    EXPECT_EQ(scene.camera_name, of.camera);
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.images[0].file, folder.path() / of.folder / "000000.png");
    EXPECT_EQ(scene.images[0].camera.fx, focal_px);
    EXPECT_EQ(scene.truth.at(0).at(0).object_id, focal_px++);
    EXPECT_EQ(scene.truth.at(0).at(0).visible_fraction, 0.5);
  }
  expect_input_error([&] { load_bop_scene(folder.path()); },
                     {"cameras", "3dlong, cam1", "the name of one"});
  expect_input_error([&] { load_bop_scene(folder.path(), "cam9"); }, {"scene_camera_cam9.json"});
}

TEST(BopLayout, TakesTheOnlyCamera) {
  const TemporaryFolder folder;
  write_camera(folder, "xyz", 300);
  EXPECT_EQ(load_bop_scene(folder.path()).camera_name, "xyz");
  EXPECT_EQ(load_bop_scene(folder.path()).images[0].file,
            folder.path() / "rgb_xyz" / "000000.png");  // missing, and named so
  folder.write("scene_camera.json", pinhole);           // now that is the scene's own camera
  EXPECT_EQ(load_bop_scene(folder.path()).camera_name, "");
  EXPECT_EQ(bop_cameras(folder.path()), (std::vector<std::string>{"", "xyz"}));
}

TEST(BopLayout, FindsImagesOfEveryEnding) {
  for (const char* file :
       {"gray/000000.tif", "gray/000000.tiff", "rgb/000000.bmp", "rgb/000000.jpeg",
        "rgb/000000.JPG", "grey/000000.png", "color/000000.png", "mono/000000.pgm", "rgb/0.png"}) {
    const TemporaryFolder folder;
    folder.write("scene_camera.json", pinhole);
    folder.write(file, "");
    folder.write("mask/000000_000000.png", "");
    EXPECT_EQ(load_bop_scene(folder.path()).images[0].file, folder.path() / file);
  }
}

TEST(BopLayout, PrefersGreyAndWhatLosesNothing) {
  const TemporaryFolder folder;
  folder.write("scene_camera.json", pinhole);
  for (const char* file :
       {"rgb/000000.png", "gray/000000.jpg", "gray/000000.png", "gray/0.png", "gray/000000.txt"})
    folder.write(file, "");
  EXPECT_EQ(load_bop_scene(folder.path()).images[0].file, folder.path() / "gray/000000.png");
}

// HOT3D's entries have no cam_K.
TEST(BopLayout, ReadsTheCameraModelsOfHeadsets) {
  const TemporaryFolder folder;
  folder.write("scene_camera_rgb.json",
               R"({"0": {"cam_model": {"image_height": 1408, "image_width": 1408,
          "projection_model_type": "CameraModelType.FISHEYE624",
          "projection_params": [610.5, 714.6, 706.8, 0.4, -0.49, 0.17, 1.13, -1.66, 0.63, 0.0001,
                                0.0002, 0.0003, -0.0004, 0.0005, 0.0006]},
          "cam_R_w2c": [1,0,0,0,1,0,0,0,1], "cam_t_w2c": [0,0,1], "depth_scale": 1.0}})");
  const BopImage image = load_bop_images(folder.path(), "rgb").images.at(0);
  EXPECT_EQ(image.camera.width, 1408);
  EXPECT_EQ(image.camera.lens, LensModel::Fisheye);
  EXPECT_NEAR(image.camera.fx, 610.5, 1e-9);
  EXPECT_TRUE(image.camera_from_world);
}

}  // namespace
}  // namespace edgescout::test
