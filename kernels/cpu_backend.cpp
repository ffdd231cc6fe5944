// The two CPU backends: the fast path people without a GPU use, and the plain reference.
#include <algorithm>
#include <chrono>
#include <new>
#include <string>

#include "kernels/backend.h"
#include "kernels/cpu_handles.h"
#include "kernels/error.h"
#include "kernels/pose_problems.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// As the GPU's tensor says it: this image, and not the program, is at its end.
[[noreturn]] void too_large(const TensorShape& shape) {
  throw InputError("dcd_tensor", "image size",
                   std::to_string(shape.width) + "x" + std::to_string(shape.height) + " with " +
                       std::to_string(shape.bins) + " bins: a tensor of " +
                       std::to_string(2 * shape.size()) + " bytes",
                   "one that memory has room for (a smaller image or fewer bins)");
}

class CpuBackend : public Backend {
 public:
  CpuBackend(bool fast, int threads) : fast_(fast), pool_(fast ? threads : 1) {}
  std::string name() const override { return fast_ ? "cpu" : "cpu-reference"; }
  bool is_gpu() const override { return false; }
  ThreadPool& threads() override { return pool_; }

  std::vector<EdgePoint> detect_edges(const ImageView& image, const EdgeOptions& options) override {
    const Timer timer(*this, "edge_detect");
    return fast_ ? detect_edges_fast(image, options, pool_)
                 : detect_edges_reference(image, options);
  }

  ViewHandle make_view(std::span<const EdgePoint> edges, int width, int height,
                       const ImageView& image, const Intrinsics& intrinsics,
                       const TensorOptions& options) override {
    options.validate();
    check(width > 0 && height > 0, "make_view: an image without pixels");
    check(image.width == 0 || (image.width == width && image.height == height),
          "make_view: image of another size");
    const TensorShape shape{width, height, options.bins};
    try {
      auto view = std::make_shared<CpuView>(memory_, shape.size());
      view->shape = shape;
      view->options = options;
      view->intrinsics = intrinsics;
      fill_tensor(*view, edges);
      if (image.width > 0) add_image(*view, image);
      return view;
    } catch (const std::bad_alloc&) {
      too_large(shape);
    }
  }

  void template_score(const BackendView& view, std::span<const TemplatePoint> points,
                      std::span<const TemplateJob> jobs, int anchor_step,
                      std::span<TemplateHit> hits) override {
    const Timer timer(*this, "template_score");
    const CpuView& mine = own(view);
    if (fast_)
      template_score_fast(mine.values, mine.shape, points, jobs, anchor_step, hits, pool_);
    else
      template_score_reference(mine.values, mine.shape, points, jobs, anchor_step, hits);
  }

  ModelPointsHandle make_model_points(std::span<const ModelPoint> points) override {
    check_template_points(points);
    return std::make_shared<CpuModelPoints>(points);
  }

  void template_project(const BackendModelPoints& points, std::span<const TemplateProjectJob> jobs,
                        const TemplateProjectOptions& options, std::span<TemplatePoint> projected,
                        std::span<std::uint32_t> too_near) override {
    const CpuModelPoints& mine = own(points);
    const Timer timer(*this, "template_project");
    if (fast_)
      template_project_fast(mine.planes, jobs, options, projected, too_near, pool_);
    else
      template_project_reference(mine.planes, jobs, options, projected, too_near);
  }

  void template_scan(const BackendView& view, const BackendModelPoints& points,
                     const TemplateScan& scan, std::span<TemplateHit> hits) override {
    const CpuModelPoints& mine = own(points);
    const Timer timer(*this, "template_scan");
    const CpuView& on = own(view);
    if (fast_)
      template_scan_fast(on.values, on.shape, mine.planes, scan, hits, pool_);
    else
      template_scan_reference(on.values, on.shape, mine.planes, scan, hits);
  }

  void pose_normal_equations(std::span<const ViewHandle> views, std::span<const ModelPoint> points,
                             std::span<const PoseProblem> problems, const PoseLoss& loss,
                             std::span<NormalEquations> out) override {
    check_pose_problems(problems, points.size(), views.size());
    const Timer timer(*this, "pose_normal_equations");
    std::vector<TensorView> tensors;
    for (const ViewHandle& view : views) tensors.push_back(own(*view).tensor_view());
    if (fast_)
      pose_normal_equations_fast(tensors, points, problems, loss, out, pool_);
    else
      pose_normal_equations_reference(tensors, points, problems, loss, out);
  }

  PosePointsHandle make_pose_points(Unfilled<ModelPoint> points) override {
    return std::make_shared<CpuPosePoints>(std::move(points));
  }

  void pose_normal_equations(std::span<const ViewHandle> views, const BackendPosePoints& points,
                             std::span<const PoseProblem> problems, const PoseLoss& loss,
                             std::span<NormalEquations> out) override {
    const auto& mine = own<CpuPosePoints>(points, "points of another backend");
    pose_normal_equations(views, mine.points, problems, loss, out);
  }

  void pose_score(std::span<const ViewHandle> views, std::span<const ModelPoint> points,
                  std::span<const PoseProblem> problems, const PoseScoreOptions& options,
                  std::span<PoseScore> out) override {
    check_pose_problems(problems, points.size(), views.size());
    const Timer timer(*this, "pose_score");
    std::vector<ScoreView> scored;
    for (const ViewHandle& view : views)
      scored.push_back({own(*view).tensor_view(), own(*view).gradient_x2});
    if (fast_)
      pose_score_fast(scored, points, problems, options, out, pool_);
    else
      pose_score_reference(scored, points, problems, options, out);
  }

  DepthHandle make_depth(const DepthView& depth) override {
    check_depth_view(depth);
    return std::make_shared<CpuDepth>(depth);
  }

  SurfacePointsHandle make_surface_points(Unfilled<SurfacePoint> points) override {
    return std::make_shared<CpuSurfacePoints>(std::move(points));
  }

  void pose_depth(std::span<const DepthHandle> views, const BackendSurfacePoints& points,
                  std::span<const PoseProblem> problems, const PoseDepthOptions& options,
                  std::span<PoseDepth> out) override {
    const auto& mine = own<CpuSurfacePoints>(points, "points of another backend");
    const Timer timer(*this, "pose_depth");
    std::vector<DepthView> images;
    for (const DepthHandle& view : views) images.push_back(own(*view).depth_view());
    if (fast_)
      pose_depth_fast(images, mine.points, problems, options, out, pool_);
    else
      pose_depth_reference(images, mine.points, problems, options, out);
  }

  void edge_support(std::span<const ViewHandle> views, std::span<const SupportPoint> points,
                    std::span<const SupportProblem> problems, std::span<EdgeSupport> out) override {
    const Timer timer(*this, "edge_support");
    std::vector<SupportView> maps;
    for (const ViewHandle& view : views) maps.push_back(own(*view).support_view());
    if (fast_)
      edge_support_fast(maps, points, problems, out, pool_);
    else
      edge_support_reference(maps, points, problems, out);
  }

  void depth_raster(const TriangleMesh& mesh, std::span<const DepthJob> jobs, int width, int height,
                    std::span<float> depth) override {
    const Timer timer(*this, "depth_raster");
    if (fast_)
      depth_raster_fast(mesh, jobs, width, height, depth, pool_);
    else
      depth_raster_reference(mesh, jobs, width, height, depth);
  }

  void point_visibility(const TriangleMesh& mesh, const VisibilityPoints& points,
                        std::span<const VisibilityJob> jobs, int size,
                        std::span<std::uint8_t> flags) override {
    const Timer timer(*this, "point_visibility");
    if (fast_)
      point_visibility_fast(mesh, points, jobs, size, flags, pool_);
    else
      point_visibility_reference(mesh, points, jobs, size, flags);
  }

  void shading_sums(std::span<const ShadedView> views, const TriangleMesh& mesh,
                    std::span<const ShadingJob> jobs, float tolerance_m,
                    std::span<ShadingSums> out) override {
    const Timer timer(*this, "shading_sums");
    std::vector<ShadingView> shaded;
    for (const auto& [view, known] : views)
      shaded.push_back(
          {own(*view).image(), view->intrinsics, known ? own(*known).depth_view() : DepthView{}});
    if (fast_)
      shading_sums_fast(shaded, mesh, jobs, tolerance_m, out, pool_);
    else
      shading_sums_reference(shaded, mesh, jobs, tolerance_m, out);
  }

  void candidate_map(std::span<const MapEdge> edges, std::span<const CandidateMap> maps, int width,
                     int height, std::span<std::uint32_t> nearest) override {
    const Timer timer(*this, "candidate_map");
    if (fast_)
      candidate_map_fast(edges, maps, width, height, nearest, pool_);
    else
      candidate_map_reference(edges, maps, width, height, nearest);
  }

  ChamferHandle combination_chamfer(const ChamferView& view, const CombinationBits& combinations,
                                    const ChamferOptions& options) override {
    const Timer timer(*this, "combination_chamfer");
    auto chamfer = std::make_shared<CpuChamfer>();
    chamfer->values = cells_of(view, combinations, options);
    chamfer->particles = static_cast<std::uint32_t>(view.particles());
    chamfer->combinations = combinations.count;
    chamfer->options = options;
    return chamfer;
  }

  double mutual_information(const BackendChamfer& chamfer, std::span<const ParticleBelief> beliefs,
                            const InformationOptions& options) override {
    const Timer timer(*this, "mutual_information");
    const auto& mine = own<CpuChamfer>(chamfer, "cells made by another backend");
    return information_of(
        {chamfer.particles, chamfer.combinations, chamfer.options.cap_px, mine.values}, beliefs,
        options);
  }

  std::vector<double> view_information(std::span<const ChamferView> views,
                                       const CombinationBits& combinations,
                                       const ChamferOptions& chamfer,
                                       std::span<const ParticleBelief> beliefs,
                                       const InformationOptions& information) override {
    const Timer timer(*this, "view_information");
    std::vector<double> nats(views.size());
    const auto of_view = [&](std::size_t v) {
      const std::vector<ChamferCell> cells = cells_of(views[v], combinations, chamfer);
      nats[v] = information_of({static_cast<std::uint32_t>(views[v].particles()),
                                combinations.count, chamfer.cap_px, cells},
                               beliefs, information);
    };
    // Each kernel alone has parts that run on one thread.
    if (views.size() >= std::size_t(pool_.threads()))
      pool_.for_each(views.size(), of_view);
    else
      for (std::size_t v = 0; v < views.size(); ++v) of_view(v);
    return nats;
  }

 private:
  struct Timer {
    Timer(CpuBackend& owner, const char* stage) : backend(owner), name(stage) {}
    ~Timer() {
      backend.add_time(
          name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    CpuBackend& backend;
    const char* name;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  };

  void fill_tensor(CpuView& view, std::span<const EdgePoint> edges) {
    const Timer timer(*this, "dcd_tensor");
    const int width = view.shape.width, height = view.shape.height;
    if (fast_)
      dcd_tensor_fast(edges, width, height, view.options, pool_, view.values);
    else
      std::ranges::copy(dcd_tensor_reference(edges, width, height, view.options),
                        view.values.begin());
  }

  void add_image(CpuView& view, const ImageView& image) {
    const Timer timer(*this, "support_map");
    view.pixels.assign(image.pixels,
                       image.pixels + std::size_t(image.width) * std::size_t(image.height));
    view.gradient_x2 = image_gradient_x2(image);
    view.support_map = fast_ ? support_map_fast(image, pool_) : support_map_reference(image);
  }

  std::vector<ChamferCell> cells_of(const ChamferView& view, const CombinationBits& combinations,
                                    const ChamferOptions& options) {
    return fast_ ? combination_chamfer_fast(view, combinations, options, pool_)
                 : combination_chamfer_reference(view, combinations, options);
  }

  double information_of(const ChamferTable& table, std::span<const ParticleBelief> beliefs,
                        const InformationOptions& options) {
    return fast_ ? mutual_information_fast(table, beliefs, options, pool_)
                 : mutual_information_reference(table, beliefs, options);
  }

  // LogicError with `message` where another backend made it.
  template <class Mine, class Handle>
  static const Mine& own(const Handle& handle, const char* message) {
    const auto* mine = dynamic_cast<const Mine*>(&handle);
    check(mine != nullptr, message);
    return *mine;
  }
  static const CpuView& own(const BackendView& view) {
    return own<CpuView>(view, "a view made by another backend");
  }
  static const CpuDepth& own(const BackendDepth& depth) {
    return own<CpuDepth>(depth, "a depth image of another backend");
  }
  static const CpuModelPoints& own(const BackendModelPoints& points) {
    return own<CpuModelPoints>(points, "model points of another backend");
  }

  bool fast_;
  ThreadPool pool_;
  std::shared_ptr<TensorMemory> memory_ = std::make_shared<TensorMemory>();
};

}  // namespace

std::unique_ptr<Backend> make_cpu_backend(int threads) {
  return std::make_unique<CpuBackend>(true, threads);
}
std::unique_ptr<Backend> make_reference_backend() { return std::make_unique<CpuBackend>(false, 1); }

}  // namespace edgescout
