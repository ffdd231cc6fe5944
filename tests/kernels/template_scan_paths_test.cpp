// template_scan on every path: equal to template_project and template_score of the same path, and
// to the reference but where a projected point is rounded the other way (template_scan.h).
#include <algorithm>

#include "kernels/error.h"
#include "kernels/template_scan.h"
#include "tests/kernels/template_hits.h"
#include "tests/kernels/template_project_oracle.h"

namespace edgescout {

namespace {

constexpr int scan_width = 70, scan_height = 50, scan_bins = 12;

// What a TemplateScan refers to.
struct ScanWork {
  std::vector<ModelPoint> points;
  std::vector<ViewpointPoints> viewpoints;
  std::vector<float> distances_m;
  std::vector<TemplateRegion> regions;
  std::vector<TemplateAnchors> anchors;
  std::vector<Pose> turned;
  std::vector<std::uint32_t> numbers;
  TemplateScan scan;

  void refer() {
    scan.viewpoints = viewpoints;
    scan.distances_m = distances_m;
    scan.regions = regions;
    scan.anchors = anchors;
    scan.turned = turned;
    scan.numbers = numbers;
  }
};

struct ScanSize {
  int viewpoints, steps, distances, regions, max_points, max_columns, max_rows, anchor_step;
};

ScanWork random_scan(std::mt19937& rng, const ScanSize& size) {
  const auto in = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(rng);
  };
  ScanWork work;
  work.points = test::random_points(rng, size.max_points + 40);
  for (int v = 0; v < size.viewpoints; ++v) {
    const auto count = static_cast<std::uint32_t>(v == 1 ? 0 : in(1, size.max_points));
    work.viewpoints.push_back({static_cast<std::uint32_t>(in(0, 40)), count});
  }
  for (int d = 0; d < size.distances; ++d) work.distances_m.push_back(0.35f + 0.1f * float(d));
  for (int r = 0; r < size.regions; ++r) {
    work.regions.push_back(
        {float(in(0, scan_width)), float(in(0, scan_height)), 0.05f, -0.03f, 0.99f});
    for (int d = 0; d < size.distances; ++d)
      work.anchors.push_back(
          in(0, 6) == 0 ? TemplateAnchors{}
                        : TemplateAnchors{in(-20, scan_width + 9), in(-20, scan_height + 9),
                                          static_cast<std::uint32_t>(in(1, size.max_columns)),
                                          static_cast<std::uint32_t>(in(1, size.max_rows))});
  }
  for (int t = 0; t < size.regions * size.viewpoints * size.steps; ++t) {
    Pose pose = test::random_pose(rng, 0.3f);
    pose.m[3] = 0.01f * float(in(-3, 3)), pose.m[7] = 0.01f * float(in(-3, 3));
    pose.m[11] = in(0, 9) == 0 ? -0.3f : 0;  // some too near
    work.turned.push_back(pose);
  }
  const int all = size.viewpoints * size.steps * size.distances;
  for (int t = 0; t < all; ++t) work.numbers.push_back(static_cast<std::uint32_t>(t));
  work.scan.project = {{90, 80, 35, 25}, scan_bins, 0.05f};
  work.scan.anchor_step = size.anchor_step;
  work.scan.in_plane_steps = static_cast<std::uint32_t>(size.steps);
  work.refer();
  return work;
}

// Other numbers in every region, some of no template.
void number_by_region(ScanWork& work, std::mt19937& rng, int places) {
  const auto all = static_cast<int>(work.scan.turns() * work.distances_m.size());
  work.numbers.clear();
  for (std::size_t i = 0; i < work.regions.size() * std::size_t(places); ++i) {
    const int number = std::uniform_int_distribution<int>(-2, all - 1)(rng);
    work.numbers.push_back(number < 0 ? TEMPLATE_SCAN_NONE : static_cast<std::uint32_t>(number));
  }
  work.scan.same_numbers = false;
  work.refer();
}

ViewHandle scanned_view_by(Backend& backend) {
  std::mt19937 rng(11);
  TensorOptions options;
  options.bins = scan_bins;
  std::vector<EdgePoint> edges;
  for (int i = 0; i < 150; ++i) {
    const auto in = [&](float most) { return std::uniform_real_distribution<float>(0, most)(rng); };
    edges.push_back({in(scan_width - 1), in(scan_height - 1), in(3.14f)});
  }
  return backend.make_view(edges, scan_width, scan_height, {}, {90, 80, 35, 25}, options);
}

std::vector<TemplateHit> scan_by(Backend& backend, const ScanWork& work) {
  const ViewHandle view = scanned_view_by(backend);
  std::vector<TemplateHit> hits(work.scan.hits(), TemplateHit{7, 7, 7});
  backend.template_scan(*view, *backend.make_model_points(work.points), work.scan, hits);
  return hits;
}

// By the two kernels that it is made of.
std::vector<TemplateHit> parts_by(Backend& backend, const ScanWork& work) {
  const ViewHandle view = scanned_view_by(backend);
  const ModelPointsHandle points = backend.make_model_points(work.points);
  std::vector<TemplateHit> hits(work.scan.hits());
  scan_by_parts(
      work.scan, hits,
      [&](const RegionJobs& jobs, auto projected, auto too_near) {
        backend.template_project(*points, jobs.projections, work.scan.project, projected, too_near);
      },
      [&](const RegionJobs& jobs, auto projected, auto of_jobs) {
        backend.template_score(*view, projected, jobs.jobs, work.scan.anchor_step, of_jobs);
      });
  return hits;
}

void expect_agreement(Backend& tested, Backend& reference, const ScanWork& work) {
  const std::vector<TemplateHit> found = scan_by(tested, work);
  EXPECT_EQ(found, parts_by(tested, work));
  const std::vector<TemplateHit> expected = scan_by(reference, work);
  std::size_t different = 0;
  for (std::size_t i = 0; i < found.size(); ++i) different += !(found[i] == expected[i]);
  EXPECT_LE(different, found.size() / 50);
}

void expect_agreement_of_sizes(Backend& tested, Backend& reference) {
  std::mt19937 rng = test::test_rng();
  for (const ScanSize& size :
       {ScanSize{5, 3, 2, 3, 60, 32, 16, 2}, ScanSize{4, 2, 3, 2, 15, 7, 3, 1},
        ScanSize{3, 4, 1, 2, 256, 70, 40, 3}, ScanSize{2, 1, 1, 4, 1, 1, 1, 5},
        ScanSize{4, 5, 2, 3, 16, 33, 17, 16}}) {
    SCOPED_TRACE("up to " + std::to_string(size.max_points) + " points, step " +
                 std::to_string(size.anchor_step));
    ScanWork work = random_scan(rng, size);
    expect_agreement(tested, reference, work);
    number_by_region(work, rng, 9);
    expect_agreement(tested, reference, work);
  }
}

class TemplateScanPaths : public test::PathTest {};

TEST_P(TemplateScanPaths, AgreesWithItsPartsAndTheReference) {
  expect_agreement_of_sizes(*tested, *reference);
}

#ifdef EDGESCOUT_VULKAN
// In groups of 32 invocations; the path with staged copies has groups of 64.
TEST(TemplateScan, AgreesWithItsPartsAndTheReferenceInGroupsOf32) {
  if (vulkan_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  gpu::DeviceOptions options = test::device_options(test::Path::vulkan);
  options.as_hardware = 32;
  expect_agreement_of_sizes(*gpu::make_backend(options), *make_reference_backend());
  test::expect_no_validation_message();
}
#endif

TEST_P(TemplateScanPaths, TemplatesWithoutAHit) {
  std::mt19937 rng = test::test_rng();
  ScanWork work = random_scan(rng, {3, 2, 2, 1, 20, 8, 8, 2});
  work.anchors = {{10, 10, 4, 4}, {}};  // none for the second distance
  for (Pose& pose : work.turned) pose.m[11] = 0;
  work.turned[0].m[11] = -1;  // of the first turn: behind the camera
  work.refer();
  const std::vector<TemplateHit> hits = scan_by(*tested, work);
  for (std::size_t number = 0; number < hits.size(); ++number) {
    const bool is_far = number % 2 == 1, is_behind = number / 2 == 0,
               is_empty = number / 2 / 2 == 1;  // random_scan gives viewpoint 1 no points
    EXPECT_EQ(hits[number].sum == TEMPLATE_SCAN_NONE, is_far || is_behind || is_empty) << number;
  }
}

TEST_P(TemplateScanPaths, PlanesAreThoseOfTheView) {
  std::mt19937 rng = test::test_rng();
  ScanWork work = random_scan(rng, {5, 3, 2, 3, 60, 32, 16, 2});
  const ModelPointsHandle points = tested->make_model_points(work.points);
  const ViewHandle first = scanned_view_by(*tested),
                   second = tested->make_view({}, scan_width, scan_height, {}, {90, 80, 35, 25},
                                              first->options);
  std::vector<TemplateHit> hits(work.scan.hits()), of_empty(hits.size()), again(hits.size());
  tested->template_scan(*first, *points, work.scan, hits);
  tested->template_scan(*second, *points, work.scan, of_empty);
  tested->template_scan(*first, *points, work.scan, again);
  EXPECT_EQ(again, hits);
  EXPECT_NE(of_empty, hits);
  work.scan.anchor_step = 3;
  tested->template_scan(*first, *points, work.scan, hits);
  EXPECT_EQ(hits, parts_by(*tested, work));
}

TEST_P(TemplateScanPaths, NothingToScan) {
  std::mt19937 rng = test::test_rng();
  ScanWork work = random_scan(rng, {2, 1, 1, 1, 5, 4, 4, 2});
  work.numbers.clear();
  work.refer();
  EXPECT_TRUE(scan_by(*tested, work).empty());
  work.regions.clear(), work.anchors.clear(), work.turned.clear();
  work.refer();
  EXPECT_TRUE(scan_by(*tested, work).empty());
}

TEST_P(TemplateScanPaths, BrokenCallsAreOurBugs) {
  std::mt19937 rng = test::test_rng();
  const auto throws = [&](const auto& spoil) {
    ScanWork work = random_scan(rng, {2, 2, 2, 2, 5, 4, 4, 2});
    spoil(work);
    work.refer();
    EXPECT_THROW(scan_by(*tested, work), LogicError);
    EXPECT_THROW(scan_by(*reference, work), LogicError);
  };
  throws([](ScanWork& w) { w.turned.pop_back(); });
  throws([](ScanWork& w) { w.anchors.pop_back(); });
  throws([](ScanWork& w) { w.numbers.push_back(8); });
  throws([](ScanWork& w) { w.scan.same_numbers = false, w.numbers.pop_back(); });
  throws([](ScanWork& w) { w.viewpoints[0].first = 1000; });
  throws([](ScanWork& w) { w.anchors[0] = {0, 0, TEMPLATE_SCORE_MAX_ANCHORS, 2}; });
  throws([](ScanWork& w) { w.anchors[0] = {0, 0, 2, 0}; });
  throws([](ScanWork& w) { w.turned[0].m[3] = NAN; });
  throws([](ScanWork& w) { w.distances_m[1] = INFINITY; });
  throws([](ScanWork& w) { w.regions[0].ray_z = NAN; });
  throws([](ScanWork& w) { w.scan.anchor_step = 0; });
  throws([](ScanWork& w) { w.scan.in_plane_steps = 0; });
}

INSTANTIATE_TEST_SUITE_P(Paths, TemplateScanPaths, test::all_paths, test::param_name);

}  // namespace
}  // namespace edgescout
