// The Vulkan backend: every step a batch, timed by its kernels.
#include "kernels/gpu/vulkan_backend.h"

#include <algorithm>
#include <chrono>

#include "kernels/error.h"
#include "kernels/gpu/backend_handles.h"
#include "kernels/gpu/candidate_map.h"
#include "kernels/gpu/combination_chamfer.h"
#include "kernels/gpu/dcd_tensor.h"
#include "kernels/gpu/depth_raster.h"
#include "kernels/gpu/edge_detect.h"
#include "kernels/gpu/edge_support.h"
#include "kernels/gpu/mutual_information.h"
#include "kernels/gpu/point_visibility.h"
#include "kernels/gpu/pose_depth.h"
#include "kernels/gpu/pose_normal_equations.h"
#include "kernels/gpu/pose_score.h"
#include "kernels/gpu/shading_sums.h"
#include "kernels/gpu/support_map.h"
#include "kernels/gpu/template_project.h"
#include "kernels/gpu/template_scan.h"
#include "kernels/gpu/template_score.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

using namespace gpu;

class VulkanBackend : public Backend {
 public:
  explicit VulkanBackend(const DeviceOptions& options)
      : device_(std::make_shared<Device>(options)),
        builder_(*device_),
        edges_(*device_),
        templates_(*device_),
        projector_(*device_),
        scanner_(*device_),
        systems_(*device_),
        scorer_(*device_),
        depths_(*device_),
        mapper_(*device_),
        supporter_(*device_),
        raster_(*device_),
        visibility_(*device_),
        shading_(*device_),
        candidates_(*device_),
        chamfer_(*device_),
        information_(*device_) {}

  std::string name() const override {
    return "vulkan:" + std::to_string(device_->info().index) + " " + device_->info().name;
  }
  bool is_gpu() const override { return true; }
  bool is_hardware() const override { return device_->info().hardware; }
  ThreadPool& threads() override { return pool_; }
  DeviceWork device_work() const override { return device_->work(); }

  std::vector<EdgePoint> detect_edges(const ImageView& image, const EdgeOptions& options) override {
    Batch first(*device_, "edge pixels");
    edges_.record_pixels(first, image, options);
    run(first);
    if (!edges_.lists_all()) {
      Batch rest(*device_, "more edge pixels");
      edges_.record_rest(rest);
      run(rest);
    }
    const std::vector<std::uint32_t> pixels = edges_.pixels();
    std::vector<EdgePoint> points(pixels.size());
    Batch second(*device_, "edge points");
    edges_.record_points(second, pixels, points);
    run(second);
    return points;
  }

  ViewHandle make_view(std::span<const EdgePoint> edges, int width, int height,
                       const ImageView& image, const Intrinsics& intrinsics,
                       const TensorOptions& options) override {
    options.validate();
    check(width > 0 && height > 0, "make_view: an image without pixels");
    check(image.width == 0 || (image.width == width && image.height == height),
          "make_view: image of another size");
    auto view = std::make_shared<VulkanView>(device_, TensorShape{width, height, options.bins},
                                             ++views_made_);
    view->options = options;
    view->intrinsics = intrinsics;
    Batch batch(*device_, "dcd_tensor");
    builder_.record(batch, edges, options, view->values);
    if (image.width > 0) {
      const std::vector<std::int16_t> gradient = image_gradient_x2(image);
      view->gradient_x2.reserve(*device_, gradient.size(), "image gradient");
      batch.upload<std::int16_t>(view->gradient_x2, gradient);
      mapper_.record(batch, image, view->support_map, view->pixels);
    }
    run(batch);
    return view;
  }

  void template_score(const BackendView& view, std::span<const TemplatePoint> points,
                      std::span<const TemplateJob> jobs, int anchor_step,
                      std::span<TemplateHit> hits) override {
    const DeviceTensor& tensor = own(view).values;
    check_template_jobs(tensor.shape(), points, jobs, anchor_step, hits.size());
    for (std::size_t first = 0, count = 0; first < jobs.size(); first += count) {
      count = templates_.that_fit(jobs.subspan(first));
      Batch batch(*device_, "template_score");
      templates_.record(batch, tensor, points, jobs.subspan(first, count), anchor_step,
                        hits.subspan(first, count));
      run(batch);
    }
  }

  ModelPointsHandle make_model_points(std::span<const ModelPoint> points) override {
    check_template_points(points);
    const ModelPointPlanes planes(points);
    auto made = std::make_shared<VulkanModelPoints>(device_);
    made->count = planes.count();
    made->planes.reserve(*device_, planes.values().size(), "templates' model points");
    Batch batch(*device_, "model points upload");
    batch.upload(made->planes, planes.values());
    run(batch);
    return made;
  }

  void template_project(const BackendModelPoints& points, std::span<const TemplateProjectJob> jobs,
                        const TemplateProjectOptions& options, std::span<TemplatePoint> projected,
                        std::span<std::uint32_t> too_near) override {
    const VulkanModelPoints& mine = own(points);
    check_template_project(mine.count, jobs, options, projected.size(), too_near.size());
    for (std::size_t first = 0, count = 0; first < jobs.size(); first += count) {
      count = projector_.that_fit(jobs.subspan(first));
      const auto some = jobs.subspan(first, count);
      Batch batch(*device_, "template_project");
      projector_.record(batch, mine.planes, some, options);
      projector_.download(batch);
      run(batch);
      projector_.collect(some, projected, too_near.subspan(first, count));
    }
  }

  void template_scan(const BackendView& view, const BackendModelPoints& points,
                     const TemplateScan& scan, std::span<TemplateHit> hits) override {
    const VulkanView& on = own(view);
    const VulkanModelPoints& mine = own(points);
    check_template_scan(mine.count, scan, hits.size());
    if (!scanner_.holds_planes(on.shape, scan.anchor_step)) {
      scan_by_parts(
          scan, hits,
          [&](const RegionJobs& jobs, auto projected, auto too_near) {
            template_project(points, jobs.projections, scan.project, projected, too_near);
          },
          [&](const RegionJobs& jobs, auto projected, auto of_jobs) {
            template_score(view, projected, jobs.jobs, scan.anchor_step, of_jobs);
          });
      return;
    }
    for (std::size_t first = 0, count = 0; first < scan.regions.size(); first += count) {
      count = scanner_.regions_that_fit(scan, first);
      Batch batch(*device_, "template_scan");
      scanner_.record_planes(batch, on.values, on.id, scan.anchor_step);
      scanner_.record(batch, mine.planes, scan, first, count);
      run(batch);
      scanner_.collect(scan, first, hits);
    }
  }

  void pose_normal_equations(std::span<const ViewHandle> views, std::span<const ModelPoint> points,
                             std::span<const PoseProblem> problems, const PoseLoss& loss,
                             std::span<NormalEquations> out) override {
    run_poses("pose_normal_equations", systems_, pose_views(views), {std::as_bytes(points)},
              problems, loss, out);
  }

  PosePointsHandle make_pose_points(Unfilled<ModelPoint> points) override {
    return keep_points<VulkanPosePoints>(std::move(points));
  }

  void pose_normal_equations(std::span<const ViewHandle> views, const BackendPosePoints& points,
                             std::span<const PoseProblem> problems, const PoseLoss& loss,
                             std::span<NormalEquations> out) override {
    const auto& mine = own<VulkanPosePoints>(points, "points of another backend");
    run_poses("pose_normal_equations", systems_, pose_views(views), mine.points(), problems, loss,
              out);
  }

  void pose_score(std::span<const ViewHandle> views, std::span<const ModelPoint> points,
                  std::span<const PoseProblem> problems, const PoseScoreOptions& options,
                  std::span<PoseScore> out) override {
    run_poses("pose_score", scorer_, pose_views(views), {std::as_bytes(points)}, problems, options,
              out);
  }

  DepthHandle make_depth(const DepthView& depth) override {
    check_depth_view(depth);
    auto made = std::make_shared<VulkanDepth>(device_, depth);
    Batch batch(*device_, "depth upload");
    batch.upload(made->values, depth.z_m);
    run(batch);
    return made;
  }

  SurfacePointsHandle make_surface_points(Unfilled<SurfacePoint> points) override {
    return keep_points<VulkanSurfacePoints>(std::move(points));
  }

  void pose_depth(std::span<const DepthHandle> views, const BackendSurfacePoints& points,
                  std::span<const PoseProblem> problems, const PoseDepthOptions& options,
                  std::span<PoseDepth> out) override {
    const auto& mine = own<VulkanSurfacePoints>(points, "points of another backend");
    check_pose_depth(views.size(), mine.host.size(), problems, options, out.size());
    std::vector<DepthImageView> images;
    for (const DepthHandle& view : views)
      images.push_back(own<VulkanDepth>(*view, "a depth image of another backend").view());
    run_poses("pose_depth", depths_, images, mine.points(), problems, options, out);
  }

  void edge_support(std::span<const ViewHandle> views, std::span<const SupportPoint> points,
                    std::span<const SupportProblem> problems, std::span<EdgeSupport> out) override {
    std::vector<SupportMapView> maps;
    std::vector<SupportView> shapes;
    for (const ViewHandle& view : views) {
      maps.push_back(own(*view).support_view());
      shapes.push_back({{}, view->shape.width, view->shape.height});
    }
    check_edge_support(shapes, points, problems, out.size());
    for (std::size_t first = 0, count = 0; first < problems.size(); first += count) {
      count = supporter_.that_fit(problems.subspan(first));
      Batch batch(*device_, "edge_support");
      supporter_.record(batch, maps, points, problems.subspan(first, count));
      run(batch);
      supporter_.collect(out.subspan(first, count));
    }
  }

  void depth_raster(const TriangleMesh& mesh, std::span<const DepthJob> jobs, int width, int height,
                    std::span<float> depth) override {
    check_depth_raster(mesh, jobs.size(), width, height, depth.size());
    const std::size_t map = std::size_t(width) * height;
    const std::size_t most = raster_.max_jobs(mesh.triangles.size() / 3, width, height);
    for (std::size_t first = 0; first < jobs.size(); first += most) {
      const std::size_t count = std::min(most, jobs.size() - first);
      Batch batch(*device_, "depth_raster");
      raster_.record(batch, mesh, jobs.subspan(first, count), width, height);
      raster_.download(batch, depth.subspan(first * map, count * map));
      run(batch);
    }
  }

  void point_visibility(const TriangleMesh& mesh, const VisibilityPoints& points,
                        std::span<const VisibilityJob> jobs, int size,
                        std::span<std::uint8_t> flags) override {
    check_point_visibility(mesh, points, jobs, size, flags.size());
    for (std::size_t first = 0, count = 0; first < jobs.size(); first += count) {
      const auto rest = jobs.subspan(first);
      count = visibility_.that_fit(raster_, mesh.triangles.size() / 3, points, rest, size);
      const auto some = rest.first(count);
      Batch batch(*device_, "point_visibility");
      visibility_.record(batch, raster_, mesh, points, some, size);
      run(batch);
      const std::size_t found = flag_count(points, some);
      visibility_.collect(flags.first(found));
      flags = flags.subspan(found);
    }
  }

  void shading_sums(std::span<const ShadedView> views, const TriangleMesh& mesh,
                    std::span<const ShadingJob> jobs, float tolerance_m,
                    std::span<ShadingSums> out) override {
    check_shading_sums(views.size(), mesh, jobs, tolerance_m, out.size());
    std::vector<ShadingImageView> images;
    for (const auto& [view, known] : views) {
      images.push_back(own(*view).shading_view());
      if (known)
        images.back().known = own<VulkanDepth>(*known, "a depth map of another backend").view();
    }
    const std::size_t most = shading_.that_fit(raster_, mesh.triangles.size() / 3);
    for (std::size_t first = 0; first < jobs.size(); first += most) {
      const std::size_t count = std::min(most, jobs.size() - first);
      Batch batch(*device_, "shading_sums");
      shading_.record(batch, raster_, images, mesh, jobs.subspan(first, count), tolerance_m);
      run(batch);
      shading_.collect(out.subspan(first, count));
    }
  }

  void candidate_map(std::span<const MapEdge> edges, std::span<const CandidateMap> maps, int width,
                     int height, std::span<std::uint32_t> nearest) override {
    check_candidate_maps(edges.size(), maps, width, height, nearest.size());
    for (std::size_t first = 0, count = 0; first < maps.size(); first += count) {
      count = candidates_.take(maps.subspan(first));
      Batch batch(*device_, "candidate_map");
      candidates_.record(batch, edges, maps.subspan(first, count), width, height);
      run(batch);
      candidates_.collect(maps.subspan(first, count), nearest);
    }
  }

  ChamferHandle combination_chamfer(const ChamferView& view, const CombinationBits& combinations,
                                    const ChamferOptions& options) override {
    auto chamfer = std::make_shared<VulkanChamfer>(device_, view.particles(), combinations.count);
    chamfer->options = options;
    const std::vector<ChamferPlan> plan = plans_of({&view, 1}, combinations, options);
    Batch batch(*device_, "combination_chamfer");
    chamfer_.record(batch, plan, combinations, {&chamfer->values, 1});
    run(batch);
    return chamfer;
  }

  double mutual_information(const BackendChamfer& chamfer, std::span<const ParticleBelief> beliefs,
                            const InformationOptions& options) override {
    const auto& mine = own<VulkanChamfer>(chamfer, "cells made by another backend");
    Batch batch(*device_, "mutual_information");
    information_.record(batch, {&mine.values, 1}, chamfer.options.cap_px, beliefs, options);
    run(batch);
    return information_.information()[0];
  }

  std::vector<double> view_information(std::span<const ChamferView> views,
                                       const CombinationBits& combinations,
                                       const ChamferOptions& chamfer,
                                       std::span<const ParticleBelief> beliefs,
                                       const InformationOptions& information) override {
    std::vector<double> nats;
    for (std::size_t first = 0, count = 0; first < views.size(); first += count) {
      count = views_at_once(views.subspan(first), combinations);
      const std::vector<double> found = information_of_some(
          views.subspan(first, count), combinations, chamfer, beliefs, information);
      nats.insert(nats.end(), found.begin(), found.end());
    }
    return nats;
  }

 private:
  std::vector<ChamferPlan> plans_of(std::span<const ChamferView> views,
                                    const CombinationBits& combinations,
                                    const ChamferOptions& options) {
    for (const ChamferView& view : views) check_chamfer(view, combinations, options);
    const auto start = std::chrono::steady_clock::now();
    std::vector<ChamferPlan> plans(views.size());
    pool_.for_each(views.size(),
                   [&](std::size_t v) { plans[v] = plan_chamfer(views[v], options, pool_); });
    add_time("chamfer_plan",
             std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    return plans;
  }

  // So many that their cells do not fill the device's memory; at least one.
  static std::size_t views_at_once(std::span<const ChamferView> views,
                                   const CombinationBits& combinations) {
    constexpr std::size_t most_cells = std::size_t{32} << 20;
    std::size_t cells = 0, count = 0;
    for (; count < views.size(); ++count) {
      cells += views[count].particles() * combinations.count;
      if (cells > most_cells) break;
    }
    return std::max<std::size_t>(count, 1);
  }

  std::vector<double> information_of_some(std::span<const ChamferView> views,
                                          const CombinationBits& combinations,
                                          const ChamferOptions& chamfer,
                                          std::span<const ParticleBelief> beliefs,
                                          const InformationOptions& information) {
    const std::vector<ChamferPlan> plans = plans_of(views, combinations, chamfer);
    std::vector<DeviceCells> cells;
    for (const ChamferView& view : views)
      cells.emplace_back(*device_, view.particles(), combinations.count);
    Batch batch(*device_, "view_information");
    chamfer_.record(batch, plans, combinations, cells);
    information_.record(batch, cells, chamfer.cap_px, beliefs, information);
    run(batch);
    return information_.information();
  }

  // LogicError with `message` where another backend made it.
  template <class Mine, class Handle>
  const Mine& own(const Handle& handle, const char* message) const {
    const auto* mine = dynamic_cast<const Mine*>(&handle);
    check(mine != nullptr && &mine->device() == device_.get(), message);
    return *mine;
  }
  const VulkanView& own(const BackendView& view) const {
    return own<VulkanView>(view, "a view made by another backend");
  }
  const VulkanModelPoints& own(const BackendModelPoints& points) const {
    return own<VulkanModelPoints>(points, "model points of another backend");
  }

  template <class Kept, class Point>
  std::shared_ptr<const Kept> keep_points(Unfilled<Point> points) {
    auto made = std::make_shared<Kept>(device_, std::move(points));
    const std::size_t bytes = made->host.size() * sizeof(Point);
    if (bytes == 0 || bytes > device_->max_band_bytes()) return made;
    made->values.reserve(*device_, made->host.size(), "points of poses");
    Batch batch(*device_, "points upload");
    batch.upload<Point>(made->values, made->host);
    run(batch);
    return made;
  }

  std::vector<PoseView> pose_views(std::span<const ViewHandle> views) const {
    std::vector<PoseView> list;
    for (const ViewHandle& view : views) list.push_back(own(*view).pose_view());
    return list;
  }

  // As many batches as the points of all problems take.
  template <class Kernel, class View, class Options, class Out>
  void run_poses(const char* name, Kernel& kernel, const std::vector<View>& views,
                 const PosePoints& points, std::span<const PoseProblem> problems,
                 const Options& options, std::span<Out> out) {
    check(out.size() == problems.size(), "poses: as many results as problems");
    for (std::size_t first = 0, count = 0; first < problems.size(); first += count) {
      count = kernel.that_fit(problems.subspan(first));
      Batch batch(*device_, name);
      kernel.record(batch, views, points, problems.subspan(first, count), options);
      run(batch);
      kernel.collect(out.subspan(first, count));
    }
  }

  // Kernels by their names on the device's clock; what the call took beyond them (copies, waiting,
  // the driver's compiler) as "vulkan_host". The whole call by the batch's name where kernels are
  // not timed.
  void run(Batch& batch) {
    const auto start = std::chrono::steady_clock::now();
    double in_kernels = 0;
    for (const StageTime& time : batch.run()) {
      add_time(time.name, time.seconds);
      in_kernels += time.seconds;
      device_->work().timed += static_cast<std::uint64_t>(time.calls);
      device_->work().timed_seconds += time.seconds;
    }
    const double all =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (device_->times_kernels())
      add_time(HOST_STAGE, std::max(0.0, all - in_kernels));
    else
      add_time(batch.name(), all);
  }

  std::shared_ptr<const Device> device_;
  ThreadPool pool_;
  DcdTensorBuilder builder_;
  EdgeDetect edges_;
  TemplateScore templates_;
  TemplateProject projector_;
  TemplateScanner scanner_;
  std::uint64_t views_made_ = 0;
  PoseNormalEquations systems_;
  PoseScorer scorer_;
  PoseDepths depths_;
  SupportMapper mapper_;
  SupportScorer supporter_;
  DepthRaster raster_;
  PointVisibility visibility_;
  ShadingSummer shading_;
  CandidateMaps candidates_;
  CombinationChamfer chamfer_;
  MutualInformation information_;
};

}  // namespace

std::unique_ptr<Backend> gpu::make_backend(const DeviceOptions& options) {
  return std::make_unique<VulkanBackend>(options);
}

std::unique_ptr<Backend> make_vulkan_backend(int device_index, const BackendOptions& options) {
  DeviceOptions device;
  device.index = device_index;
  device.time_kernels = options.time_kernels;
  return gpu::make_backend(device);
}

}  // namespace edgescout
