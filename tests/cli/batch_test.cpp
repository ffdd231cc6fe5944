// A batch whose device fails on the way.
#include "host/cli/batch.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/core/se3.h"
#include "host/io/results.h"
#include "kernels/error.h"
#include "tests/cli/small_scene.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

// The fast CPU path, until a given view is made.
class FailingBackend : public Backend {
 public:
  FailingBackend(int good_views, std::function<void()> failure)
      : good_views_(good_views), failure_(std::move(failure)) {}
  std::string name() const override { return "failing"; }
  bool is_gpu() const override { return true; }
  int refused_edges = -1;  // which call, of two an image
  std::vector<EdgePoint> detect_edges(const ImageView& image, const EdgeOptions& options) override {
    if (edges_++ == refused_edges) throw InputError("image", "size", "320x240", "less");
    return cpu_->detect_edges(image, options);
  }
  ViewHandle make_view(std::span<const EdgePoint> edges, int width, int height,
                       const ImageView& image, const Intrinsics& intrinsics,
                       const TensorOptions& options) override {
    if (made_++ == good_views_) failure_();
    return cpu_->make_view(edges, width, height, image, intrinsics, options);
  }
  void template_score(const BackendView& view, std::span<const TemplatePoint> points,
                      std::span<const TemplateJob> jobs, int anchor_step,
                      std::span<TemplateHit> hits) override {
    cpu_->template_score(view, points, jobs, anchor_step, hits);
  }
  ModelPointsHandle make_model_points(std::span<const ModelPoint> points) override {
    return cpu_->make_model_points(points);
  }
  void template_project(const BackendModelPoints& points, std::span<const TemplateProjectJob> jobs,
                        const TemplateProjectOptions& options, std::span<TemplatePoint> projected,
                        std::span<std::uint32_t> too_near) override {
    cpu_->template_project(points, jobs, options, projected, too_near);
  }
  void template_scan(const BackendView& view, const BackendModelPoints& points,
                     const TemplateScan& scan, std::span<TemplateHit> hits) override {
    cpu_->template_scan(view, points, scan, hits);
  }
  void pose_normal_equations(std::span<const ViewHandle> views, std::span<const ModelPoint> points,
                             std::span<const PoseProblem> problems, const PoseLoss& loss,
                             std::span<NormalEquations> out) override {
    cpu_->pose_normal_equations(views, points, problems, loss, out);
  }
  PosePointsHandle make_pose_points(Unfilled<ModelPoint> points) override {
    return cpu_->make_pose_points(std::move(points));
  }
  void pose_normal_equations(std::span<const ViewHandle> views, const BackendPosePoints& points,
                             std::span<const PoseProblem> problems, const PoseLoss& loss,
                             std::span<NormalEquations> out) override {
    cpu_->pose_normal_equations(views, points, problems, loss, out);
  }
  void pose_score(std::span<const ViewHandle> views, std::span<const ModelPoint> points,
                  std::span<const PoseProblem> problems, const PoseScoreOptions& options,
                  std::span<PoseScore> out) override {
    cpu_->pose_score(views, points, problems, options, out);
  }
  DepthHandle make_depth(const DepthView& depth) override { return cpu_->make_depth(depth); }
  SurfacePointsHandle make_surface_points(Unfilled<SurfacePoint> points) override {
    return cpu_->make_surface_points(std::move(points));
  }
  void pose_depth(std::span<const DepthHandle> views, const BackendSurfacePoints& points,
                  std::span<const PoseProblem> problems, const PoseDepthOptions& options,
                  std::span<PoseDepth> out) override {
    cpu_->pose_depth(views, points, problems, options, out);
  }
  void edge_support(std::span<const ViewHandle> views, std::span<const SupportPoint> points,
                    std::span<const SupportProblem> problems, std::span<EdgeSupport> out) override {
    cpu_->edge_support(views, points, problems, out);
  }
  void depth_raster(const TriangleMesh& mesh, std::span<const DepthJob> jobs, int width, int height,
                    std::span<float> depth) override {
    cpu_->depth_raster(mesh, jobs, width, height, depth);
  }
  void point_visibility(const TriangleMesh& mesh, const VisibilityPoints& points,
                        std::span<const VisibilityJob> jobs, int size,
                        std::span<std::uint8_t> flags) override {
    cpu_->point_visibility(mesh, points, jobs, size, flags);
  }
  void shading_sums(std::span<const ShadedView> views, const TriangleMesh& mesh,
                    std::span<const ShadingJob> jobs, float tolerance_m,
                    std::span<ShadingSums> out) override {
    cpu_->shading_sums(views, mesh, jobs, tolerance_m, out);
  }
  void candidate_map(std::span<const MapEdge> edges, std::span<const CandidateMap> maps, int width,
                     int height, std::span<std::uint32_t> nearest) override {
    cpu_->candidate_map(edges, maps, width, height, nearest);
  }
  ChamferHandle combination_chamfer(const ChamferView& view, const CombinationBits& combinations,
                                    const ChamferOptions& options) override {
    return cpu_->combination_chamfer(view, combinations, options);
  }
  double mutual_information(const BackendChamfer& chamfer, std::span<const ParticleBelief> beliefs,
                            const InformationOptions& options) override {
    return cpu_->mutual_information(chamfer, beliefs, options);
  }
  std::vector<double> view_information(std::span<const ChamferView> views,
                                       const CombinationBits& combinations,
                                       const ChamferOptions& chamfer,
                                       std::span<const ParticleBelief> beliefs,
                                       const InformationOptions& information) override {
    return cpu_->view_information(views, combinations, chamfer, beliefs, information);
  }
  ThreadPool& threads() override { return cpu_->threads(); }

 private:
  std::unique_ptr<Backend> cpu_ = make_cpu_backend(2);
  int made_ = 0, edges_ = 0, good_views_;
  std::function<void()> failure_;
};

constexpr int views_per_image = 3;  // the full tensor, the coarse one and that of the salient edges

struct Batch : SmallScene {
  std::vector<InputImage> images;
  std::vector<TemplateSet> sets;
  BatchOptions options;

  Batch() : SmallScene(3) {
    images = list_images({scene});
    static const TemplateSet built = fewest_templates();
    sets.push_back(built);
    options.out = out;
    options.pipeline.detect.min_probability = 0.1;
    options.pipeline.detect.coarse_poses = 200;
    options.pipeline.detect.candidates = 10;
  }
  static TemplateSet fewest_templates() {
    TemplateOptions templates;
    templates.frequency = 2;
    templates.in_plane_steps = 8;
    templates.distance_min_m = templates.distance_max_m = 0.3;
    return build_templates(make_part("l_bracket"), templates, *make_cpu_backend(2));
  }
  fs::path json(int i) const { return out / ("000003_00000" + std::to_string(i) + ".json"); }
  nlohmann::json summary() const { return nlohmann::json::parse(content_of(out / "summary.json")); }
  std::set<int> listed() const {
    std::set<int> ids;
    for (const BopResult& row : load_bop_results(out / "results.csv")) ids.insert(row.image_id);
    return ids;
  }
};

TEST(RunBatch, KeepsWhatWasFinishedWhenTheDeviceIsLost) {
  const Batch t;
  FailingBackend backend(views_per_image,
                         [] { throw GpuError("make_view: VK_ERROR_DEVICE_LOST"); });
  EXPECT_THROW(run_batch(t.images, t.sets, backend, t.options), GpuError);
  EXPECT_EQ(load_image_result(t.json(0)).device, "failing");
  EXPECT_FALSE(fs::exists(t.json(1)) || fs::exists(t.json(2)));
  EXPECT_EQ(t.listed(), std::set<int>{0});
  BatchOptions again = t.options;
  again.resume = true;
  const BatchSummary summary = run_batch(t.images, t.sets, *make_cpu_backend(2), again);
  EXPECT_EQ(summary.skipped, 1);
  EXPECT_EQ(summary.done, 2);
  EXPECT_EQ(t.listed(), (std::set<int>{0, 1, 2}));
}

TEST(RunBatch, WritesWhatWasFoundWithinItsTime) {
  Batch t;
  t.options.max_seconds = 1e-3;
  run_batch(std::span(t.images).first(1), t.sets, *make_cpu_backend(2), t.options);
  EXPECT_EQ(load_image_result(t.json(0)).incomplete, "deadline passed");
  EXPECT_EQ(t.summary().at("incomplete"), 1);
  t.options.max_seconds = 1000;
  run_batch(std::span(t.images).first(1), t.sets, *make_cpu_backend(2), t.options);
  EXPECT_EQ(load_image_result(t.json(0)).incomplete, "");
  EXPECT_EQ(t.summary().at("incomplete"), 0);
}

TEST(RunBatch, ListsNoOlderResultWhenTheDeviceIsLost) {
  const Batch t;
  run_batch(t.images, t.sets, *make_cpu_backend(2), t.options);
  ASSERT_EQ(t.listed(), (std::set<int>{0, 1, 2}));
  t.folder.write("out/000003_000002.json", "no result");
  FailingBackend backend(views_per_image,
                         [] { throw GpuError("make_view: VK_ERROR_DEVICE_LOST"); });
  EXPECT_THROW(run_batch(t.images, t.sets, backend, t.options), GpuError);
  EXPECT_EQ(t.listed(), std::set<int>{0});
}

TEST(RunBatch, SumsUpWhatEndedItInPlaceOfAnEarlierRun) {
  const Batch t;
  run_batch(t.images, t.sets, *make_cpu_backend(2), t.options);
  ASSERT_EQ(t.summary().at("done"), 3);
  EXPECT_FALSE(t.summary().contains("error"));
  FailingBackend backend(views_per_image,
                         [] { throw GpuError("make_view: VK_ERROR_DEVICE_LOST"); });
  EXPECT_THROW(run_batch(t.images, t.sets, backend, t.options), GpuError);
  EXPECT_EQ(t.summary().at("done"), 1);
  EXPECT_EQ(t.summary().at("device"), "failing");
  EXPECT_EQ(t.summary().at("error"), "make_view: VK_ERROR_DEVICE_LOST");
}

// What cannot work costs nothing that was there.
TEST(RunBatch, KeepsAnEarlierRunsResultsUntilItHasItsFirst) {
  const Batch t;
  run_batch(t.images, t.sets, *make_cpu_backend(2), t.options);
  FailingBackend backend(0, [] { throw InputError("image", "size", "320x240", "less"); });
  const std::vector<InputImage> one(t.images.begin(), t.images.begin() + 1);
  EXPECT_THROW(run_batch(one, t.sets, backend, t.options), InputError);
  EXPECT_EQ(t.listed(), (std::set<int>{0, 1, 2}));
  for (int i = 0; i < 3; ++i) EXPECT_NO_THROW(load_image_result(t.json(i)));
  EXPECT_EQ(t.summary().at("done"), 3);
}

TEST(RunBatch, ReportsTheLostDeviceIfTheListCannotBeWritten) {
  const Batch t;
  fs::create_directories(t.out / "results.csv/in the way");
  FailingBackend backend(views_per_image,
                         [] { throw GpuError("make_view: VK_ERROR_DEVICE_LOST"); });
  const CollectedLog log;
  EXPECT_THROW(run_batch(t.images, t.sets, backend, t.options), GpuError);
  ASSERT_EQ(log.messages.size(), 1u);
  EXPECT_NE(log.messages[0].second.find("results.csv"), std::string::npos)
      << log.messages[0].second;
}

// Of three images, for its size; the others are done and listed.
void expect_only_the_second_refused(const Batch& t, Backend& backend) {
  const BatchSummary summary = run_batch(t.images, t.sets, backend, t.options);
  EXPECT_EQ(summary.done, 2);
  ASSERT_EQ(summary.failures.size(), 1u);
  EXPECT_EQ(summary.failures.begin()->first, t.image(1).string());
  EXPECT_NE(summary.failures.begin()->second.find("000001.png: image: size"), std::string::npos);
  EXPECT_EQ(t.listed(), (std::set<int>{0, 2}));
}

TEST(RunBatch, GoesOnPastAnImageTheDeviceRefuses) {
  const Batch t;
  FailingBackend backend(views_per_image,
                         [] { throw InputError("image", "size", "320x240", "less"); });
  expect_only_the_second_refused(t, backend);
}

// What a batch found in its images, with the edges of the backend or of a thread beside it.
std::vector<std::vector<Detection>> found_in(Batch& t, Backend& backend, bool edges_on_backend) {
  t.options.edges_on_backend = edges_on_backend;
  const BatchSummary summary = run_batch(t.images, t.sets, backend, t.options);
  EXPECT_EQ(summary.done, static_cast<int>(t.images.size()));
  std::vector<std::vector<Detection>> found;
  for (int i = 0; i < summary.done; ++i) {
    const ImageResult result = load_image_result(t.json(i));
    EXPECT_EQ(std::ranges::count(result.stages, "undistort", &StageSeconds::name), 1);
    EXPECT_EQ(std::ranges::count(result.stages, "edges", &StageSeconds::name), 1);
    found.push_back(result.detections);
  }
  return found;
}

TEST(RunBatch, FindsTheSameWithEdgesOfTheBackend) {
  Batch t;
  const auto cpu = make_cpu_backend(2);
  const auto beside = found_in(t, *cpu, false), on_backend = found_in(t, *cpu, true);
  for (std::size_t i = 0; i < beside.size(); ++i) {
    ASSERT_EQ(beside[i].size(), on_backend[i].size());
    for (std::size_t d = 0; d < beside[i].size(); ++d) {
      const Detection &a = beside[i][d], &b = on_backend[i][d];
      EXPECT_EQ(a.world_from_object.translation_m, b.world_from_object.translation_m);
      EXPECT_EQ(a.probability, b.probability);
    }
  }
}

// Positions of edges differ by what detect_edges allows, so poses may differ a little.
TEST(RunBatch, FindsTheSameWithEdgesOfADevice) {
  if (vulkan_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  Batch t;
  t.images.resize(1);
  const auto device = make_vulkan_backend(usual_vulkan_device());
  const auto beside = found_in(t, *device, false), on_device = found_in(t, *device, true);
  ASSERT_EQ(beside[0].size(), on_device[0].size());
  ASSERT_FALSE(beside[0].empty());
  const Detection &a = beside[0][0], &b = on_device[0][0];
  EXPECT_LT(distance_between_m(a.world_from_object, b.world_from_object), 0.0002);
  EXPECT_LT(angle_between_rad(a.world_from_object, b.world_from_object), 0.002);
  EXPECT_NEAR(a.probability, b.probability, 0.01);
}

// An image of which the backend finds no edges is listed; the batch goes on.
TEST(RunBatch, GoesOnPastAnImageWithoutEdgesOfTheBackend) {
  Batch t;
  t.options.edges_on_backend = true;
  FailingBackend backend(100, {});
  backend.refused_edges = 2;
  expect_only_the_second_refused(t, backend);
}

TEST(RunBatch, MixesNoJointResultsWithThoseOfOneView) {
  const Batch t;
  run_batch(t.images, t.sets, *make_cpu_backend(2), t.options);
  BatchOptions jointly = t.options;
  jointly.joint = jointly.resume = true;
  expect_input_error([&] { run_batch(t.images, t.sets, *make_cpu_backend(1), jointly); },
                     {"000003_000000.json", "views: found alone", "expected 3 jointly"});
  fs::remove(t.json(0));  // to be done; the others would still be mixed with it
  expect_input_error([&] { run_batch(t.images, t.sets, *make_cpu_backend(1), jointly); },
                     {"views"});
}

// If the scene now has another camera pose, poses in the world change.
TEST(RunBatch, MixesNoResultsOfCamerasThatMoved) {
  Batch t;
  run_batch(t.images, t.sets, *make_cpu_backend(2), t.options);
  t.options.resume = true;
  t.images[1].camera_from_world->translation_m.x() += 0.1;
  expect_input_error([&] { run_batch(t.images, t.sets, *make_cpu_backend(1), t.options); },
                     {"000003_000001.json", "camera in the world"});
}

TEST(RunBatch, OurOwnBugsEndItAndWhatWasFinishedIsListed) {
  const Batch t;
  FailingBackend backend(views_per_image, [] { throw LogicError("bug"); });
  EXPECT_THROW(run_batch(t.images, t.sets, backend, t.options), LogicError);
  EXPECT_EQ(t.listed(), std::set<int>{0});
}

TEST(RunBatch, NamesTheImageThatIsTooLarge) {
  Batch t;
  const fs::path wide = t.folder.path() / "wide.png";
  save_png(Image{32767, 120, std::vector<std::uint8_t>(32767 * 120, 128)}, wide);
  t.options.camera.file = t.folder.write(
      "lens.yaml", "K: [400, 0, 159.5, 0, 400, 119.5, 0, 0, 1]\nD: [0.1, 0, 0, 0, 0]\n");
  expect_input_error(
      [&] { run_batch(list_images({wide.string()}), t.sets, *make_cpu_backend(1), t.options); },
      {"wide.png: image: size: found 32767x120"});
  EXPECT_FALSE(fs::exists(t.out)) << "something was written";
}

TEST(RunBatch, RefusesWhereTheDeviceCanWorkOnNoImage) {
  const Batch t;
  FailingBackend backend(0, [] { throw InputError("image", "size", "320x240", "less"); });
  const std::vector<InputImage> one(t.images.begin(), t.images.begin() + 1);
  const CollectedLog log;
  expect_input_error([&] { run_batch(one, t.sets, backend, t.options); },
                     {"000000.png: image: size: found 320x240, expected less"});
  EXPECT_TRUE(log.messages.empty()) << "logged twice";
  EXPECT_FALSE(fs::exists(t.out)) << "something was written";
}

// A Latin-1 name, as file systems hold them.
TEST(RunBatch, TakesFileNamesThatAreNoUtf8) {
  Batch t;
  const fs::path folder = t.folder.path() / "images";
  t.folder.write("images/bad\xe9.png", "no image");
  fs::copy_file(t.image(), folder / "caf\xe9.png");
  t.options.camera.file = t.camera();
  const std::vector<InputImage> images = list_images({folder});
  EXPECT_EQ(run_batch(images, t.sets, *make_cpu_backend(2), t.options).done, 1);
  const std::string bad = t.summary().at("failures").at(0).at("file");
  EXPECT_TRUE(bad.ends_with("bad\xef\xbf\xbd.png")) << bad;
  t.options.resume = true;
  EXPECT_EQ(run_batch(images, t.sets, *make_cpu_backend(2), t.options).skipped, 1);
}

TEST(RunBatch, JoinsOnlyViewsOfKnownPlace) {
  Batch t;
  t.images[1].camera_from_world.reset();
  t.options.joint = true;
  expect_input_error([&] { run_batch(t.images, t.sets, *make_cpu_backend(1), t.options); },
                     {"000001.png", "world pose", "--joint"});
  EXPECT_FALSE(fs::exists(t.out));
}

// A repeated view gives no new information.
TEST(RunBatch, JoinsEveryViewOnce) {
  Batch t;
  t.options.joint = true;
  expect_input_error(
      [&] {
        run_batch(list_images({t.scene, t.scene}), t.sets, *make_cpu_backend(1), t.options);
      },
      {"000000.png", "view: found it twice", "--joint"});
  EXPECT_FALSE(fs::exists(t.out));
}

}  // namespace
}  // namespace edgescout::test
