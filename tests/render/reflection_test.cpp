#include "host/render/reflection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/render/parts.h"
#include "kernels/thread_pool.h"
#include "tests/render/lights.h"

namespace edgescout::test {
namespace {

// A scene of boxes under far light, without lamps, on a white desk.
struct Stage {
  explicit Stage(const FarLight& far_light, double irradiance = 1) {
    scene.board_side_m = 0;
    scene.desk_albedo = 0.9;
    scene.ambient = 0.5;
    scene.environment = scene.environment_with_lamps =
        std::make_shared<Environment>(far_light, irradiance, std::span<const FarLamp>());
  }
  void add_box(const Eigen::Vector3d& size_m, const Eigen::Vector3d& at_m,
               const Material& material) {
    Object box;
    box.mesh = make_box(size_m);
    scene.placed.push_back(
        {static_cast<int>(scene.objects.size()), {Eigen::Quaterniond::Identity(), at_m}, material});
    scene.objects.push_back(box);
  }
  // Mean light of a surface of the given material.
  double seen(const ShadedPoint& surface, const Material& material, int samples = 2000) const {
    ThreadPool pool(1);
    const WorldTriangles triangles(scene);
    const Lighting lighting(scene, triangles, pool);
    const Reflections reflections(scene, triangles, lighting);
    constexpr double GOLDEN = 0.6180339887498949;  // its multiples spread evenly over 0 to 1
    double sum = 0;
    for (int i = 0; i < samples; ++i)
      sum += reflections.at(surface, material,
                            {(i + 0.5) / samples, std::fmod(i * GOLDEN, 1.0), samples, i % 8});
    return sum / samples;
  }
  SimulatedScene scene;
};

Material metal(double reflectance, double roughness, double anisotropy = 0) {
  Material material;
  material.albedo = material.specular = 0;
  material.reflectance = reflectance;
  material.roughness = roughness;
  material.anisotropy = anisotropy;
  return material;
}

FarLight everywhere() {
  return [](const Eigen::Vector3d&) { return 1.0; };
}

ShadedPoint upward(const Eigen::Vector3d& to_viewer) {
  return {{0, 0, 0.05}, Eigen::Vector3d::UnitZ(), to_viewer.normalized(), Eigen::Vector3d::UnitX()};
}

TEST(Reflections, AMirrorShowsWhatLiesInTheMirroredDirection) {
  const Stage stage(bright_east(), 2);
  const Material mirror = metal(0.8, 0.02);
  EXPECT_NEAR(stage.seen(upward({-0.5, 0, 1}), mirror, 20), 0.8 * 3, 0.05);
  EXPECT_NEAR(stage.seen(upward({0.5, 0, 1}), mirror, 20), 0.8 * 1, 0.05) << "from the other side";
}

// Under even light a white surface without absorption is as bright as the light, less what its
// facets send into the surface.
TEST(Reflections, ASurfaceGivesBackAsMuchAsItReceives) {
  const Stage stage(everywhere());
  for (const auto& [roughness, least] : {std::pair{0.1, 0.99}, {0.3, 0.97}, {0.5, 0.8}})
    for (const double anisotropy : {0.0, 0.8}) {
      const double light = stage.seen(upward({0.3, 0.2, 1}), metal(1, roughness, anisotropy));
      EXPECT_LT(light, 1.001) << roughness;
      EXPECT_GT(light, least) << roughness;
    }
}

TEST(Reflections, GlossGrowsTowardsGrazingView) {
  const Stage stage(everywhere());
  const double above = stage.seen(upward({0, 0, 1}), metal(0.04, 0.05), 50),
               grazing = stage.seen(upward({1, 0, 0.1}), metal(0.04, 0.05), 50);
  EXPECT_NEAR(above, 0.04, 0.002);
  EXPECT_GT(grazing, 0.4);
}

TEST(Reflections, RoughnessBlursABorder) {
  const Stage stage(bright_east(), 2);
  // Mirrored, just east of the border.
  const ShadedPoint surface = upward({-0.1, 0, 1});
  EXPECT_NEAR(stage.seen(surface, metal(1, 0.05)), 3, 0.15);
  const Material rough = metal(1, 0.7);
  EXPECT_NEAR(stage.seen(surface, rough) / Stage(everywhere()).seen(surface, rough), 2, 0.25);
}

TEST(Reflections, APartHidesWhatLiesBehindIt) {
  Stage stage(everywhere());
  Material black;
  black.albedo = black.specular = 0;
  stage.add_box({0.05, 0.05, 0.05}, {0.1, 0, 0.15}, black);
  const Material mirror = metal(0.8, 0.02);
  EXPECT_NEAR(stage.seen(upward({-1, 0, 1}), mirror, 20), 0, 1e-3);
  EXPECT_NEAR(stage.seen(upward({-1, 1.5, 1}), mirror, 20), 0.8, 0.05) << "beside it";
}

// A mirror over a desk that ten lamps light: what it shows is what the desk receives from all.
TEST(Reflections, TheEighthsOfTheLightsAreTogetherAllOfThem) {
  Stage stage(everywhere());
  stage.scene.options.shadows = false;
  for (int i = 0; i < 10; ++i) stage.scene.lights.push_back({{0.1 * i, 0.3, 1}, 0.01 * (i + 1)});
  const ShadedPoint wall{
      {0, 0, 0.05}, Eigen::Vector3d::UnitX(), Eigen::Vector3d(1, 0, 1).normalized(), {0, 1, 0}};
  ThreadPool pool(1);
  const WorldTriangles triangles(stage.scene);
  const double irradiance =
      Lighting(stage.scene, triangles, pool).diffuse({0.05, 0, 0}, Eigen::Vector3d::UnitZ());
  ASSERT_GT(irradiance, stage.scene.ambient + 0.3);
  EXPECT_NEAR(stage.seen(wall, metal(0.8, 0.02), 80), 0.8 * 0.9 * irradiance, 0.01);
}

TEST(Reflections, AWallMirrorsTheDesk) {
  const Stage stage(bright_east(), 2);
  const ShadedPoint wall{{0, 0, 0.05},
                         Eigen::Vector3d::UnitX(),
                         Eigen::Vector3d(1, 0, 1).normalized(),
                         Eigen::Vector3d::UnitY()};
  const double irradiance = stage.scene.ambient;
  EXPECT_NEAR(stage.seen(wall, metal(0.8, 0.02), 20), 0.8 * 0.9 * irradiance, 0.02);
}

// A lamp's reflection in brushed metal is a streak across the grain.
TEST(Reflections, BrushedMetalSpreadsAcrossItsGrain) {
  const FarLight lamp = [](const Eigen::Vector3d& direction) {
    return direction.z() > std::cos(0.05) ? 100.0 : 0.0;
  };
  const Stage stage(lamp);
  const Material brushed = metal(1, 0.4, 0.9);
  const double along = stage.seen(upward({0.5, 0, 1}), brushed, 20000),
               across = stage.seen(upward({0, 0.5, 1}), brushed, 20000);
  EXPECT_GT(across, 3 * along);
}

// A rough surface gets its highlight from the lamp itself: as much as from a disc of the same
// light.
TEST(Reflections, AHighlightIsThatOfALampThatIsMirrored) {
  const double half_angle = 0.03, lamp_light = 400;
  const FarLight lamp = [=](const Eigen::Vector3d& direction) {
    return direction.z() > std::cos(half_angle) ? lamp_light : 0.0;
  };
  const double irradiance = lamp_light * std::pow(std::sin(half_angle), 2);
  const Stage stage(lamp, irradiance);
  for (const double roughness : {0.3, 0.5})
    for (const double tilt : {0.0, 0.1, 0.3}) {
      const ShadedPoint surface = upward({tilt, 0, 1});
      const Material rough = metal(0.7, roughness);
      const double highlight =
          irradiance * Microfacets(surface, rough).highlight(Eigen::Vector3d::UnitZ());
      EXPECT_NEAR(stage.seen(surface, rough, 20000) / highlight, 1, 0.15)
          << roughness << " " << tilt;
    }
}

}  // namespace
}  // namespace edgescout::test
