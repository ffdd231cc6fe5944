// Templates from the cache: the same bits as built, and built wherever anything differs.
#include "host/model/template_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "host/model/template_parts.h"
#include "tests/examples.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"
#include "tests/model/box.h"
#include "tests/model/solids.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

namespace fs = std::filesystem;

TemplateOptions coarse_options() {
  TemplateOptions options;
  options.frequency = 2;
  options.distance_min_m = 0.3;
  options.distance_max_m = 0.5;
  return options;
}

Object block() {
  Object object{7, box_mesh(0.06, 0.04, 0.02), {}};
  object.symmetries.discrete.push_back({Eigen::Quaterniond(0, 0, 0, 1), Eigen::Vector3d::Zero()});
  return object;
}

struct Kept {
  TemporaryFolder folder;
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  TemplateCacheOptions options{folder.path(), 1, "test"};

  CachedTemplates get(const Object& object, const TemplateOptions& templates) {
    return TemplateCache(options).get(object, templates, *backend);
  }
  fs::path entry() const { return *fs::directory_iterator(folder.path()); }
};

// All that a set holds, bit by bit. What the model computes of mesh and options has no pointers.
std::string bytes_of(const TemplateSet& set) {
  BinaryWriter out;
  out.put(set.object_id);
  put_options(out, set.options);
  put_symmetries(out, set.symmetries);
  put_views(out, set.views);
  const EdgeModel& model = set.model;
  out.put_text(model.mesh.name);
  put_mesh(out, model.mesh);
  for (const Eigen::Vector3d& normal : model.mesh.face_normals) out.put_point(normal);
  for (const Eigen::Vector3d& corner : {model.mesh.box_min_m, model.mesh.box_max_m})
    out.put_point(corner);
  for (double v : {model.mesh.diameter_m, model.raster_step_m, model.radius_m}) out.put(v);
  out.put_point(model.center_m);
  for (const EdgeModel::Segment& crease : model.creases) {
    out.put_point(crease.from_m), out.put_point(crease.to_m);
    out.put(crease.is_open_border);
  }
  for (const RasterPoint& point : model.crease_points)
    out.put_point(point.point_m), out.put_point(point.tangent);
  for (const auto& normals : model.corner_normals)
    for (const Eigen::Vector3d& normal : normals) out.put_point(normal);
  out.put_list(model.curved);
  out.put_list(model.occluding.vertices_m);
  out.put_list(model.occluding.triangles);
  return out.bytes;
}

Mesh example_part(const std::string& file) {
  return load_mesh(examples() / "parts" / file, LengthUnit::Millimetre);
}

TEST(TemplateCache, GivesTheBitsOfBuiltTemplates) {
  const Mesh creased = example_part("obj_000001.ply"), turned = example_part("obj_000003.ply"),
             dense = icosphere(0.03, 5);
  ASSERT_LT(occluding_surface(dense).triangles.size(), 3 * dense.triangles.size());
  for (const Mesh& mesh : {creased, turned, dense}) {
    Kept kept;
    const Object object{3, mesh, block().symmetries};
    const std::string built = bytes_of(build_templates(object, coarse_options(), *kept.backend));
    const CachedTemplates first = kept.get(object, coarse_options());
    const CachedTemplates second = kept.get(object, coarse_options());
    EXPECT_FALSE(first.are_cached);
    EXPECT_TRUE(second.are_cached);
    EXPECT_EQ(bytes_of(first.set), built);
    EXPECT_EQ(bytes_of(second.set), built);
    EXPECT_GT(second.seconds, 0);
    EXPECT_EQ(kept.folder.entries(), 1u);
  }
}

TEST(TemplateCache, CallsTheProgressWhereItBuilds) {
  Kept kept;
  TemplateCache cache(kept.options);
  int calls = 0;
  const auto count = [&calls](int, int) { ++calls; };
  cache.get(block(), coarse_options(), *kept.backend, count);
  EXPECT_GT(calls, 0);
  calls = 0;
  cache.get(block(), coarse_options(), *kept.backend, count);
  EXPECT_EQ(calls, 0);
}

TEST(TemplateCache, ChangedOptionsMiss) {
  Kept kept;
  kept.get(block(), coarse_options());
  const auto expect_built = [&](auto change) {
    TemplateOptions options = coarse_options();
    change(options);
    const CachedTemplates found = kept.get(block(), options);
    EXPECT_FALSE(found.are_cached);
    EXPECT_EQ(bytes_of(found.set), bytes_of(build_templates(block(), options, *kept.backend)));
  };
  expect_built([](auto& o) { o.frequency = 3; });
  expect_built([](auto& o) { o.range.latitude_min_deg = -80; });
  expect_built([](auto& o) { o.range.latitude_max_deg = 80; });
  expect_built([](auto& o) { o.range.longitude_min_deg = 10; });
  expect_built([](auto& o) { o.range.longitude_max_deg = 350; });
  expect_built([](auto& o) { o.in_plane_steps = 12; });
  expect_built([](auto& o) { o.distance_min_m = std::nextafter(0.3, 1); });
  expect_built([](auto& o) { o.distance_max_m = std::nextafter(0.5, 1); });
  expect_built([](auto& o) { o.distance_ratio = 1.2; });
  expect_built([](auto& o) { o.edges.crease_angle_deg = 30; });
  expect_built([](auto& o) { o.edges.raster_step_m = 0.002; });
  EXPECT_TRUE(kept.get(block(), coarse_options()).are_cached);
}

TEST(TemplateCache, AChangedObjectMisses) {
  Kept kept;
  kept.get(block(), coarse_options());
  Object moved = block(), turned = block(), symmetric = block();
  moved.mesh.vertices_m[3].x() = std::nextafter(moved.mesh.vertices_m[3].x(), 1);
  std::ranges::rotate(turned.mesh.triangles[2], turned.mesh.triangles[2].begin() + 1);
  symmetric.symmetries.discrete.pop_back();
  for (const Object& other : {moved, turned, symmetric})
    EXPECT_FALSE(kept.get(other, coarse_options()).are_cached);
  EXPECT_TRUE(kept.get(block(), coarse_options()).are_cached);
}

TEST(TemplateCache, AnotherBackendOrProgramMisses) {
  Kept kept;
  kept.get(block(), coarse_options());
  EXPECT_FALSE(TemplateCache(kept.options)
                   .get(block(), coarse_options(), *make_backend("cpu-reference"))
                   .are_cached);
  kept.options.program = "another";
  EXPECT_FALSE(kept.get(block(), coarse_options()).are_cached);
}

// Neither changes the templates.
TEST(TemplateCache, AnotherNameOrIdIsTheCallers) {
  Kept kept;
  kept.get(block(), coarse_options());
  Object renamed = block();
  renamed.id = 8;
  renamed.mesh.name = "renamed";
  const CachedTemplates found = kept.get(renamed, coarse_options());
  EXPECT_TRUE(found.are_cached);
  EXPECT_EQ(found.set.object_id, 8);
  EXPECT_EQ(found.set.model.mesh.name, "renamed");
}

TEST(TemplateCache, DamagedEntriesAreBuiltAnew) {
  Kept kept;
  const std::string built = bytes_of(kept.get(block(), coarse_options()).set);
  const fs::path file = kept.entry();
  const std::string whole = content_of(file);
  const auto expect_built = [&](const std::string& bad) {
    kept.folder.write(file.filename().string(), bad);
    const CollectedLog log;
    const CachedTemplates found = kept.get(block(), coarse_options());
    EXPECT_FALSE(found.are_cached);
    EXPECT_EQ(bytes_of(found.set), built);
    ASSERT_EQ(log.messages.size(), 1u);
    EXPECT_EQ(content_of(file), whole);
  };
  Random random = test_random();
  for (int i = 0; i < 20; ++i) {
    const auto at = static_cast<std::size_t>(random.below(static_cast<int>(whole.size())));
    std::string bad = whole;
    bad[at] = static_cast<char>(bad[at] ^ (1 << random.below(8)));
    expect_built(bad);
    expect_built(whole.substr(0, at));
  }
}

TEST(TemplateCache, KeepsNothingOfWhatCannotBeBuilt) {
  Kept kept;
  TemplateOptions wrong = coarse_options();
  wrong.distance_ratio = 1;
  expect_input_error([&] { kept.get(block(), wrong); }, {"distance_ratio"});
  EXPECT_EQ(kept.folder.entries(), 0u);
  kept.options.max_size_gib = -1;
  expect_input_error([&] { kept.get(block(), coarse_options()); }, {"template_cache_size"});
}

TEST(TemplateCache, ObeysItsSize) {
  Kept kept;
  kept.get(block(), coarse_options());
  const double bytes = static_cast<double>(fs::file_size(kept.entry()));
  kept.options.max_size_gib = 1.5 * bytes / (1 << 30);
  TemplateOptions other = coarse_options();
  other.distance_ratio = 1.2;
  kept.get(block(), other);
  EXPECT_EQ(kept.folder.entries(), 1u);
  EXPECT_TRUE(kept.get(block(), other).are_cached);
}

class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old, was_set_ = true;
    value ? ::setenv(name, value, 1) : ::unsetenv(name);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { was_set_ ? ::setenv(name_, old_.c_str(), 1) : ::unsetenv(name_); }

 private:
  const char* name_;
  std::string old_;
  bool was_set_ = false;
};

fs::path folder_with(const char* xdg, const char* home) {
  const Variable first("XDG_CACHE_HOME", xdg), second("HOME", home);
  return default_template_folder();
}

TEST(TemplateCache, LiesInTheUsersCacheFolder) {
  EXPECT_EQ(folder_with("/caches", "/home/me"), "/caches/edgescout/templates");
  for (const char* unusable : {"", "caches", static_cast<const char*>(nullptr)}) {
    EXPECT_EQ(folder_with(unusable, "/home/me"), "/home/me/.cache/edgescout/templates");
    EXPECT_EQ(folder_with(unusable, unusable), "");
  }
}

// The templates of a part at version 1. Where they change, the version in template_cache.cpp must
// be raised with these numbers: else programs read templates of before the change. Compilers round
// in their own ways, which may move a point.
TEST(TemplateCache, VersionIsThatOfTheseTemplates) {
  const Object part{1, example_part("obj_000001.ply"), {}};
  const TemplateSet set = build_templates(part, coarse_options(), *make_cpu_backend(1));
  double points = 0, sum_m = 0;
  for (const TemplateView& view : set.views) {
    points += static_cast<double>(view.points.size());
    for (const ModelPoint& p : view.points)
      sum_m += std::abs(p.x_m) + std::abs(p.y_m) * p.tz * p.tz;
  }
  EXPECT_EQ(set.views.size(), 42u);
  EXPECT_NEAR(points, 22491, 2);
  EXPECT_NEAR(sum_m, 587.46, 0.1);
}

}  // namespace
}  // namespace edgescout::test
