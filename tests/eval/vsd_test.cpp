// BOP's visible surface discrepancy: cases that a hand works out, and a second implementation by
// rays.
#include "host/eval/vsd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/core/random.h"
#include "host/eval/vsd_tables.h"
#include "host/io/depth_png.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

constexpr double DELTA_M = 0.015;
constexpr float NOWHERE = std::numeric_limits<float>::infinity();

// 40 x 40 mm; diameter 56.6 mm.
Object plate() {
  Object object;
  object.mesh.vertices_m = {{-0.02, -0.02, 0}, {0.02, -0.02, 0}, {0.02, 0.02, 0}, {-0.02, 0.02, 0}};
  object.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  object.mesh.diameter_m = 0.04 * std::sqrt(2.0);
  return object;
}

// A plate at 1 m covers 40 x 40 pixels: 80 to 119.
Camera plate_camera() {
  Camera camera;
  camera.width = camera.height = 200;
  camera.fx = camera.fy = 1000;
  camera.cx = camera.cy = 99.6;
  return camera;
}

Se3 plate_at(double x_m, double z_m) { return {Eigen::Quaterniond::Identity(), {x_m, 0, z_m}}; }

DepthImage nothing_measured() { return {200, 200, std::vector<float>(40000, DEPTH_MISSING)}; }

// Measured at one depth in the columns [from, to).
DepthImage measured_in(int from, int to, float z_m) {
  DepthImage depth = nothing_measured();
  for (int y = 0; y < 200; ++y)
    for (int x = from; x < to; ++x) depth.z_m[std::size_t{200} * y + x] = z_m;
  return depth;
}

VsdErrors plate_error(const Se3& estimate, const Se3& truth, const DepthImage& depth) {
  const VsdObject object(plate());
  const Camera camera = plate_camera();
  return vsd(object.seen_by(camera, estimate), object.seen_by(camera, truth),
             distances_of(depth, camera), object.diameter_m(), DELTA_M);
}

void expect_all(const VsdErrors& errors, double expected) {
  for (const double error : errors) EXPECT_NEAR(error, expected, 1e-12);
}

TEST(Vsd, OfTheTruthIsZero) {
  expect_all(plate_error(plate_at(0, 1), plate_at(0, 1), nothing_measured()), 0);
  expect_all(plate_error(plate_at(0, 1), plate_at(0, 1), measured_in(0, 200, 1)), 0);
  expect_all(plate_error(plate_at(0, 1), plate_at(0, 1), measured_in(0, 200, 2)), 0);
}

// 5 mm are 8.8 % of the diameter, 10 mm 17.7 %.
TEST(Vsd, AlongTheAxisCountsFromTauOn) {
  const VsdErrors five = plate_error(plate_at(0, 1.005), plate_at(0, 1), nothing_measured());
  EXPECT_EQ(five[0], 1);
  for (int tau = 1; tau < VSD_TAUS; ++tau) EXPECT_EQ(five[tau], 0) << tau;
  const VsdErrors ten = plate_error(plate_at(0, 1.0099), plate_at(0, 1), nothing_measured());
  for (int tau = 0; tau < VSD_TAUS; ++tau) EXPECT_EQ(ten[tau], tau < 3) << tau;
}

// 20 of 60 columns are of both.
TEST(Vsd, AsideByHalfItsWidthIsTwoThirds) {
  expect_all(plate_error(plate_at(0.02, 1), plate_at(0, 1), nothing_measured()), 2.0 / 3);
}

// The left half of the truth is hidden: 20 columns are of both, 20 of the estimate alone.
TEST(Vsd, LeavesOutWhatANearerSurfaceHides) {
  expect_all(plate_error(plate_at(0.02, 1), plate_at(0, 1), measured_in(0, 100, 0.9f)), 0.5);
}

TEST(Vsd, AllowsDeltaBeforeTheMeasuredSurface) {
  expect_all(plate_error(plate_at(0.02, 1), plate_at(0, 1), measured_in(0, 100, 0.99f)), 2.0 / 3);
  expect_all(plate_error(plate_at(0, 1), plate_at(0, 1), measured_in(0, 200, 0.98f)), 1);
}

// The estimate lies 50 mm behind the measured truth. It counts as visible there, so it is compared.
TEST(Vsd, ComparesAnEstimateBehindTheVisibleTruth) {
  expect_all(plate_error(plate_at(0, 1.05), plate_at(0, 1), measured_in(0, 200, 1)), 1);
}

TEST(Vsd, IsOneWhereNothingIsCommonOrSeen) {
  expect_all(plate_error(plate_at(0.06, 1), plate_at(0, 1), nothing_measured()), 1);
  expect_all(plate_error(plate_at(0, 1), plate_at(0, 1), measured_in(0, 200, 0.5f)), 1);
  expect_all(plate_error(plate_at(5, 1), plate_at(0, 1), nothing_measured()), 1);
  expect_all(plate_error(plate_at(0, -1), plate_at(0, 1), nothing_measured()), 1);
}

// Distance to the nearest triangle along a pixel's ray (Moeller and Trumbore).
float cast_ray(const Mesh& mesh, const Se3& pose, const Eigen::Vector3d& ray) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& [i, j, k] : mesh.triangles) {
    const Eigen::Vector3d a = pose * mesh.vertices_m[i], e1 = pose * mesh.vertices_m[j] - a,
                          e2 = pose * mesh.vertices_m[k] - a, n = ray.cross(e2), q = (-a).cross(e1);
    const double determinant = e1.dot(n), u = -a.dot(n) / determinant, v = ray.dot(q) / determinant,
                 t = e2.dot(q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0) nearest = std::min(nearest, t * ray.norm());
  }
  return static_cast<float>(nearest);
}

struct SecondVsd {
  VsdErrors errors;
  int visible;
};

SecondVsd vsd_by_rays(const Object& object, const Camera& camera, const Se3& estimate,
                      const Se3& truth, const DepthImage& depth) {
  std::vector<double> differences;  // infinite where one pose alone is visible
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray = ray_through(camera, Eigen::Vector2d(x, y));
      const double measured = depth.at(x, y) * ray.norm();
      const float e = cast_ray(object.mesh, estimate, ray), t = cast_ray(object.mesh, truth, ray);
      const bool see_t = t < NOWHERE && (measured == 0 || t <= measured + DELTA_M);
      const bool see_e = e < NOWHERE && (measured == 0 || e <= measured + DELTA_M || see_t);
      if (see_t && see_e)
        differences.push_back(std::abs(t - e));
      else if (see_t || see_e)
        differences.push_back(NOWHERE);
    }
  SecondVsd second{{}, static_cast<int>(differences.size())};
  for (int tau = 0; tau < VSD_TAUS; ++tau) {
    const double bound_m = 0.05 * (tau + 1) * object.mesh.diameter_m;
    const auto wrong = std::ranges::count_if(differences, [&](double d) { return d >= bound_m; });
    second.errors[tau] = differences.empty() ? 1 : static_cast<double>(wrong) / second.visible;
  }
  return second;
}

Object tetrahedron() {
  Object object;
  object.mesh.vertices_m = {
      {0.03, 0.03, 0.03}, {0.03, -0.03, -0.03}, {-0.03, 0.03, -0.03}, {-0.03, -0.03, 0.03}};
  object.mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  object.mesh.diameter_m = 0.06 * std::sqrt(2.0);
  return object;
}

TEST(Vsd, AgreesWithRaysOnRandomCases) {
  const Object object = tetrahedron();
  const VsdObject drawn(object);
  Camera camera;
  camera.width = 80;
  camera.height = 60;
  camera.fx = camera.fy = 200;
  camera.cx = 39.3;
  camera.cy = 30.1;
  Random random(7);
  double sum = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const Se3 truth{random.rotation(),
                    {random.uniform(-0.05, 0.05), 0.01, random.uniform(0.3, 0.5)}};
    Vector6d step;
    step << 0.01 * random.direction(), 0.3 * random.direction();
    const Se3 estimate = retract(truth, step);
    DepthImage depth{80, 60, {}};
    const float plane_m = static_cast<float>(truth.translation_m.z() + random.uniform(-0.05, 0.05));
    for (int i = 0; i < 80 * 60; ++i)
      depth.z_m.push_back(random.uniform() < 0.3 ? DEPTH_MISSING
                                                 : plane_m + 0.001f * (i % 80 - 40));
    const VsdErrors errors = vsd(drawn.seen_by(camera, estimate), drawn.seen_by(camera, truth),
                                 distances_of(depth, camera), object.mesh.diameter_m, DELTA_M);
    const SecondVsd second = vsd_by_rays(object, camera, estimate, truth, depth);
    for (int tau = 0; tau < VSD_TAUS; ++tau)  // a ray through an edge may slip to either side
      EXPECT_NEAR(errors[tau], second.errors[tau], 2.5 / std::max(1, second.visible))
          << trial << ", tau " << tau;
    sum += errors[1];
  }
  EXPECT_GT(sum, 3) << "not all alike";
  EXPECT_LT(sum, 27);
}

EvaluationImage plate_image(const std::filesystem::path& depth_file) {
  EvaluationImage image;
  image.camera = plate_camera();
  image.truth = {{1, plate_at(0, 1), 1.0}};
  image.depth_file = depth_file;
  image.depth_unit_m = 1e-4;
  BopResult found;
  found.object_id = 1;
  found.score = 0.9;
  found.camera_from_object = plate_at(0, 1.005);
  BopResult second = found;
  second.score = 0.5;
  second.camera_from_object = plate_at(0, 1);
  image.estimates = {second, found};
  return image;
}

// The better score counts, and it lies 5 mm off: wrong at the smallest of ten taus.
TEST(Vsd, GivesTheAverageRecall) {
  const TemporaryFolder folder;
  write_depth_png(measured_in(0, 200, 1), 1e-4, folder.path() / "depth.png");
  std::vector<EvaluationImage> images{plate_image(folder.path() / "depth.png")};
  const std::map<int, Object> objects{{1, plate()}};
  EXPECT_FALSE(evaluate(images, objects, {}).has_vsd);
  ThreadPool pool(2);
  add_vsd(images, objects, DELTA_M, pool);
  const Recalls recalls = evaluate(images, objects, {});
  ASSERT_TRUE(recalls.has_vsd);
  EXPECT_NEAR(recalls.ar_vsd, 0.9, 1e-12);
  EXPECT_EQ(recalls.vsd[0][9], 0);
  EXPECT_EQ(recalls.vsd[1][0], 1);
  EXPECT_NEAR(recalls.ar(), (recalls.ar_vsd + recalls.ar_mssd + recalls.ar_mspd) / 3, 1e-12);
  images.push_back(plate_image(""));
  add_vsd(images, objects, DELTA_M, pool);
  EXPECT_FALSE(evaluate(images, objects, {}).has_vsd) << "one image has no depth";
}

TEST(Vsd, RefusesDepthOfAnotherSize) {
  const TemporaryFolder folder;
  write_depth_png({20, 16, std::vector<float>(320, 1.0f)}, 1e-4, folder.path() / "depth.png");
  std::vector<EvaluationImage> images{plate_image(folder.path() / "depth.png")};
  ThreadPool pool(2);
  try {
    add_vsd(images, {{1, plate()}}, DELTA_M, pool);
    FAIL();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("depth.png"), std::string::npos) << text;
    EXPECT_NE(text.find("20x16"), std::string::npos) << text;
    EXPECT_NE(text.find("200x200"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace edgescout::test
