// The content of template sets, and intact and damaged template files.
#include "host/model/template_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "host/io/mesh.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"
#include "tests/model/box.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

TemplateSet small_set() {
  Object object{7, box_mesh(0.06, 0.04, 0.02), {}};
  object.symmetries.discrete.push_back({Eigen::Quaterniond(0, 0, 0, 1), {0.001, 0, 0}});
  TemplateOptions options;
  options.frequency = 1;
  options.in_plane_steps = 12;
  options.distance_min_m = 0.3;
  options.distance_max_m = 0.5;
  options.range.latitude_min_deg = -80;
  const std::unique_ptr<Backend> backend = make_cpu_backend(1);
  return build_templates(object, options, *backend);
}

bool same_points(const std::vector<ModelPoint>& a, const std::vector<ModelPoint>& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(ModelPoint)) == 0;
}

TEST(TemplateSet, HoldsWhatIsVisibleFromEveryViewpoint) {
  Object object{1, box_mesh(0.06, 0.04, 0.02), {}};
  TemplateOptions options;
  options.frequency = 2;
  options.distance_min_m = options.distance_max_m = 0.4;
  const std::unique_ptr<Backend> backend = make_cpu_backend(1);
  int last = 0;
  const TemplateSet set = build_templates(object, options, *backend, [&](int done, int all) {
    EXPECT_EQ(all, 42);
    EXPECT_GT(done, last);
    last = done;
  });
  EXPECT_EQ(last, 42);
  ASSERT_EQ(set.views.size(), 42u);
  for (const TemplateView& view : set.views) {
    const Eigen::Vector3d towards_camera =
        -(view.camera_from_object.conjugate() * Eigen::Vector3d::UnitZ());
    ASSERT_FALSE(view.points.empty());
    // The corner of the box that is farthest from the camera is hidden, and so are its three edges'
    // ends.
    const Eigen::Vector3d half(0.03, 0.02, 0.01);
    Eigen::Vector3d hidden;
    for (int i = 0; i < 3; ++i) hidden[i] = towards_camera[i] > 0 ? -half[i] : half[i];
    if (towards_camera.cwiseAbs().minCoeff() < 0.2) continue;  // looks along a face
    for (const ModelPoint& p : view.points)
      EXPECT_GT((Eigen::Vector3d(p.x_m, p.y_m, p.z_m) - hidden).norm(), 0.004);
  }
}

TEST(TemplateSet, OptionsOutOfBoundsAreNamed) {
  const auto refused = [](auto change, const char* field) {
    TemplateOptions options;
    change(options);
    expect_input_error([&] { options.validate(); }, {field});
  };
  refused([](auto& o) { o.frequency = 0; }, "viewpoints");
  refused([](auto& o) { o.in_plane_steps = 361; }, "in_plane_steps");
  refused([](auto& o) { o.distance_min_m = std::nan(""); }, "distance_min");
  refused([](auto& o) { o.distance_min_m = 2, o.distance_max_m = 1; }, "distance_max");
  refused([](auto& o) { o.distance_max_m = 1; }, "distance_min");
  refused([](auto& o) { o.distance_ratio = 1; }, "distance_ratio");
  refused([](auto& o) { o.range.latitude_min_deg = 95; }, "latitude_min");
}

TEST(TemplateSet, DistancesRunFromNearToFarInEqualRatios) {
  TemplateOptions options;
  options.distance_min_m = 0.5;
  options.distance_max_m = 1;
  const std::vector<double> distances = template_distances_m(options);
  ASSERT_EQ(distances.size(), 9u);  // 1.1^7 < 2 < 1.1^8
  EXPECT_DOUBLE_EQ(distances.front(), 0.5);
  EXPECT_NEAR(distances.back(), 1, 1e-12);
  for (std::size_t i = 1; i < distances.size(); ++i)
    EXPECT_NEAR(distances[i] / distances[i - 1], std::pow(2, 1 / 8.0), 1e-12);
}

TEST(TemplateSet, DefaultDistancesShowTheObjectInAllToATwentiethOfTheLargerSide) {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 800;
  const TemplateOptions options = with_default_distances({}, 0.1, camera);
  EXPECT_NEAR(800 * 0.1 / options.distance_min_m, 640, 1e-9);
  EXPECT_NEAR(800 * 0.1 / options.distance_max_m, 32, 1e-9);
}

// Parts of 130 mm and distances of 350 to 800 mm, each taken for metres.
TEST(TemplateSet, AWrongUnitIsNamed) {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 800;
  expect_input_error([&] { with_default_distances({}, 130, camera); },
                     {"diameter: found 130 m", "another unit (unit)", "distance_min"});
  TemplateOptions options;
  options.distance_min_m = 350, options.distance_max_m = 800;
  const Object part{1, box_mesh(0.06, 0.04, 0.02), {}};
  const std::unique_ptr<Backend> backend = make_cpu_backend(1);
  expect_input_error(
      [&] { build_templates(part, options, *backend); },
      {"distances: found 350 m and more", "distance_min and distance_max in metres", "(unit)"});
}

TEST(TemplateSet, ScalesDivideARangeIntoEqualRatios) {
  TemplateOptions options;
  options.distance_min_m = 0.4, options.distance_max_m = 1;
  EXPECT_EQ(distance_scales(options).size(), 1u);  // 2.5 : 1
  options.distance_min_m = 0.125, options.distance_max_m = 2.5;
  const std::vector<DistanceRange> scales = distance_scales(options);
  ASSERT_EQ(scales.size(), 4u);
  EXPECT_DOUBLE_EQ(scales.front().min_m, 0.125);
  EXPECT_NEAR(scales.back().max_m, 2.5, 1e-12);
  for (std::size_t i = 0; i < scales.size(); ++i) {
    EXPECT_NEAR(scales[i].max_m / scales[i].min_m, std::pow(20, 0.25), 1e-9);
    if (i > 0) {
      EXPECT_NEAR(scales[i].min_m, scales[i - 1].max_m, 1e-12);
    }
    const std::vector<double> distances = template_distances_m(options, scales[i]);
    EXPECT_NEAR(distances.front(), scales[i].min_m, 1e-12);
    EXPECT_NEAR(distances.back(), scales[i].max_m, 1e-9);
  }
}

TEST(TemplateFile, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const TemplateSet set = small_set();
  save_templates(set, folder.path() / "set.est");
  const TemplateSet read = load_templates(folder.path() / "set.est");
  EXPECT_EQ(read.object_id, 7);
  EXPECT_EQ(read.model.mesh.name, set.model.mesh.name);
  EXPECT_EQ(read.model.mesh.vertices_m.size(), set.model.mesh.vertices_m.size());
  EXPECT_EQ(read.model.mesh.triangles, set.model.mesh.triangles);
  EXPECT_EQ(read.model.creases.size(), set.model.creases.size());
  EXPECT_DOUBLE_EQ(read.model.raster_step_m, set.model.raster_step_m);
  EXPECT_EQ(read.options.in_plane_steps, 12);
  EXPECT_EQ(read.options.frequency, 1);
  EXPECT_EQ(read.options.distance_min_m, 0.3);
  EXPECT_EQ(read.options.distance_max_m, 0.5);
  EXPECT_EQ(read.options.range.latitude_min_deg, -80);
  ASSERT_EQ(read.symmetries.discrete.size(), 2u);
  EXPECT_EQ(read.symmetries.discrete[1].translation_m.x(), 0.001);
  ASSERT_EQ(read.views.size(), set.views.size());
  for (std::size_t i = 0; i < read.views.size(); ++i) {
    EXPECT_LT(read.views[i].camera_from_object.angularDistance(set.views[i].camera_from_object),
              1e-9);
    EXPECT_TRUE(same_points(read.views[i].points, set.views[i].points)) << i;
  }
}

TEST(TemplateFile, CutShortIsRefusedWhereverTheCutIs) {
  const TemporaryFolder folder;
  save_templates(small_set(), folder.path() / "set.est");
  const std::string whole = content_of(folder.path() / "set.est");
  for (std::size_t i = 0; i < 100; ++i) {
    // The header byte by byte, then evenly over the payload.
    const std::size_t length = i < 40 ? i : 40 + (whole.size() - 41) * (i - 40) / 59;
    ASSERT_LT(length, whole.size());
    const std::string cut = folder.write("cut.est", whole.substr(0, length));
    expect_input_error([&] { load_templates(cut); }, {"cut.est"});
  }
  const std::string longer = folder.write("longer.est", whole + "x");
  expect_input_error([&] { load_templates(longer); }, {"longer.est", "length"});
}

TEST(TemplateFile, WithAByteFlippedIsRefused) {
  const TemporaryFolder folder;
  save_templates(small_set(), folder.path() / "set.est");
  const std::string whole = content_of(folder.path() / "set.est");
  Random random = test_random();
  for (int i = 0; i < 100; ++i) {
    std::string bad = whole;
    const std::size_t at =
        i < 28 ? static_cast<std::size_t>(i)
               : static_cast<std::size_t>(random.below(static_cast<int>(whole.size())));
    bad[at] = static_cast<char>(bad[at] ^ (1 << random.below(8)));
    const std::string file = folder.write("bad.est", bad);
    expect_input_error([&] { load_templates(file); }, {"bad.est"});
  }
}

TEST(TemplateFile, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  save_templates(small_set(), folder.path() / "set.est");
  const std::string whole = content_of(folder.path() / "set.est");
  std::string version = whole, payload = whole;
  ++version[8];
  ++payload.back();
  const std::string a = folder.write("a.est", version), b = folder.write("b.est", payload),
                    c = folder.write("c.est", "solid box"), d = folder.write("d.est", "");
  expect_input_error([&] { load_templates(a); }, {"a.est", "version", "expected 1"});
  expect_input_error([&] { load_templates(b); }, {"b.est", "checksum"});
  expect_input_error([&] { load_templates(c); }, {"c.est", "template file"});
  expect_input_error([&] { load_templates(d); }, {"d.est", "template file"});
  expect_input_error([&] { load_templates(folder.path() / "none.est"); }, {"none.est"});
}

}  // namespace
}  // namespace edgescout::test
