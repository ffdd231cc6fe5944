#include "host/track/cropped_registration.h"

#include <gtest/gtest.h>

#include "host/core/lens.h"
#include "host/core/pose_error.h"
#include "host/render/parts.h"
#include "tests/track/flat_images.h"

namespace edgescout {
namespace {

const Object part = make_part("bearing_block");
const EdgeModel model = make_edge_model(part.mesh);
Se3 pose_at(double x_m, double z_m) { return {so3_exp({0.6, -0.4, 0.3}), {x_m, 0.01, z_m}}; }

TEST(CroppedRegistration, PosesKeepTheirFrameInACrop) {
  Camera camera = test::flat_camera();
  camera.distortion = {-0.2, 0.05, 0.001, 0};
  ThreadPool pool(1);
  const Se3 pose = pose_at(0.06, 0.5);
  const Image image = test::flat_image(part.mesh, pose, pool);
  const std::optional<Crop> crop = crop_around(searched(image, camera), model, pose);
  ASSERT_TRUE(crop);
  EXPECT_LT(crop->camera.width * crop->camera.height, camera.width * camera.height);
  const Eigen::Vector2d in_image = pixel_seeing(camera, {0.13, 0.02}),
                        in_crop = pixel_seeing(crop->camera, {0.13, 0.02});
  const Eigen::Vector2i offset = (in_image - in_crop).array().round().matrix().cast<int>();
  EXPECT_NEAR((in_image - in_crop - offset.cast<double>()).norm(), 0, 1e-9);
  EXPECT_EQ(crop->image.at(10, 20), image.at(10 + offset.x(), 20 + offset.y()));
}

TEST(CroppedRegistration, AnObjectOutsideOfTheImageHasNoCrop) {
  const Image image{320, 240, std::vector<std::uint8_t>(320 * 240, 50)};
  const SearchedImage given = searched(image, test::flat_camera());
  EXPECT_FALSE(crop_around(given, model, pose_at(3, 0.5)));
  EXPECT_FALSE(crop_around(given, model, pose_at(0, -0.5)));
}

TEST(CroppedRegistration, FindsThePoseFromOneTurnedAndShifted) {
  ThreadPool pool(1);
  const Se3 truth = pose_at(0.02, 0.4);
  const Image image = test::flat_image(part.mesh, truth, pool);
  Vector6d off;
  off << 0.008, -0.006, 0.015, 0.15, -0.1, 0.1;
  const Se3 start = retract(truth, off);
  const auto backend = make_backend("cpu");
  const std::optional<Detection> found =
      register_in_crop(searched(image, test::flat_camera()), model, {&start, 1}, *backend, {});
  ASSERT_TRUE(found);
  EXPECT_LT(mssd_m(found->world_from_object, truth, part), 0.05 * part.mesh.diameter_m);
  EXPECT_GT(found->probability, 0.4);
}

// The part fills most of an image of nine times as many pixels.
TEST(CroppedRegistration, ReducesLargeCrops) {
  ThreadPool pool(1);
  const Camera camera = scaled(test::flat_camera(), 3);
  const Se3 truth = pose_at(0.01, 0.3);
  const Image image = test::flat_image(part.mesh, truth, pool, camera);
  const SearchedImage given = searched(image, camera);
  const std::optional<Crop> crop = crop_around(given, model, truth);
  ASSERT_TRUE(crop);
  EXPECT_GT(crop->reduction, 1);
  EXPECT_EQ(crop->image.pixels.size(), std::size_t(crop->image.width) * crop->image.height);
  EXPECT_LE(crop->image.pixels.size(), 400u * 400);
  EXPECT_EQ(crop->camera.width, crop->image.width);
  EXPECT_EQ(crop->camera.height, crop->image.height);
  // The corner of the first pixel of the crop is that of a pixel of the image.
  const Eigen::Vector3d corner = ray_through(crop->camera, {-0.5, -0.5});
  const Eigen::Vector2d seen = project(camera, corner) + Eigen::Vector2d(0.5, 0.5);
  EXPECT_LT((seen - Eigen::Vector2d(seen.array().round())).norm(), 1e-9);

  Vector6d off;
  off << 0.006, -0.005, 0.011, 0.15, -0.1, 0.1;
  const Se3 start = retract(truth, off);
  const auto backend = make_backend("cpu");
  const std::optional<CroppedDetection> found =
      register_in_crop(given, model, {&start, 1}, *backend, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->reduction, crop->reduction);
  EXPECT_GT(found->probability, 0.4);
  EXPECT_LT(mssd_m(found->world_from_object, truth, part), 0.02 * part.mesh.diameter_m);
}

TEST(CroppedRegistration, IsEmptyWhereItsLimitIsOverBeforeTheEnd) {
  ThreadPool pool(1);
  const Se3 truth = pose_at(0.02, 0.4);
  const Image image = test::flat_image(part.mesh, truth, pool);
  const auto backend = make_backend("cpu");
  const auto with = [&](const TimeLimit& limit) {
    return register_in_crop(searched(image, test::flat_camera()), model, {&truth, 1}, *backend, {},
                            limit);
  };
  int asked = 0;
  EXPECT_TRUE(with({{}, [&] { return ++asked < 0; }}));
  EXPECT_GT(asked, 1);
  const int in_all = asked;
  asked = 0;
  EXPECT_FALSE(with({{}, [&] { return ++asked > in_all / 2; }}));
  EXPECT_FALSE(with({{}, [] { return true; }}));
}

}  // namespace
}  // namespace edgescout
