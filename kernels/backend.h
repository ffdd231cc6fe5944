// The one run-time choice: where the kernels run. Host code talks to a Backend and never asks which
// one it is.
//
// Three kinds: the plain CPU reference (single-threaded, the judge of the others), the fast CPU
// path (SIMD and threads) and a Vulkan device. All answer alike, within the agreement each kernel's
// header promises. A backend may be used by one thread at a time. Tensors, views, depth
// images, points and cells outlive the call that made them and must be handed back to the same
// backend.
//
// Public header.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "kernels/candidate_map.h"
#include "kernels/combination_chamfer.h"
#include "kernels/dcd_tensor.h"
#include "kernels/depth_raster.h"
#include "kernels/device_work.h"
#include "kernels/edge_detect.h"
#include "kernels/edge_support.h"
#include "kernels/mutual_information.h"
#include "kernels/point_visibility.h"
#include "kernels/pose_depth.h"
#include "kernels/pose_normal_equations.h"
#include "kernels/pose_score.h"
#include "kernels/shading_sums.h"
#include "kernels/template_project.h"
#include "kernels/template_scan.h"
#include "kernels/template_score.h"
#include "kernels/unfilled.h"

namespace edgescout {

// A tensor and, where an image was given, the image, its gradient and its support map, in the
// backend's own memory.
class BackendView {
 public:
  virtual ~BackendView() = default;
  TensorShape shape;
  TensorOptions options;
  Intrinsics intrinsics{};
  // Copies the tensor to the host and returns it (for pictures and tests).
  virtual std::vector<std::uint16_t> tensor() const = 0;
};
using ViewHandle = std::shared_ptr<const BackendView>;

// Model points in the backend's own memory, so that those of a template set go there once.
class BackendModelPoints {
 public:
  virtual ~BackendModelPoints() = default;
  std::uint32_t count = 0;
};
using ModelPointsHandle = std::shared_ptr<const BackendModelPoints>;

// The points of many poses in the backend's own memory, so that the steps of a registration, which
// differ in their poses alone, need them there once.
class BackendPosePoints {
 public:
  virtual ~BackendPosePoints() = default;
};
using PosePointsHandle = std::shared_ptr<const BackendPosePoints>;

// A depth image in the backend's own memory.
class BackendDepth {
 public:
  virtual ~BackendDepth() = default;
  int width = 0, height = 0;
  Intrinsics intrinsics{};
};
using DepthHandle = std::shared_ptr<const BackendDepth>;

// One view of shading_sums.
struct ShadedView {
  ViewHandle view;
  DepthHandle known;  // depth map of known surfaces, DEPTH_EMPTY elsewhere; null: nothing is known
};

// Samples of surfaces in the backend's own memory, as BackendPosePoints holds edge points.
class BackendSurfacePoints {
 public:
  virtual ~BackendSurfacePoints() = default;
};
using SurfacePointsHandle = std::shared_ptr<const BackendSurfacePoints>;

// The cells of one view's combination_chamfer, in the backend's own memory: particles *
// combinations of them, too many to keep those of all views.
class BackendChamfer {
 public:
  virtual ~BackendChamfer() = default;
  std::uint32_t particles = 0, combinations = 0;
  ChamferOptions options;
  // Copies the cells to the host and returns them, [particle][combination].
  virtual std::vector<ChamferCell> cells() const = 0;
};
using ChamferHandle = std::shared_ptr<const BackendChamfer>;

// Name of what a device's host spent beside the device's own stages. Only where the device's
// kernels are timed.
inline constexpr char HOST_STAGE[] = "vulkan_host";

// Wall time of one kernel or batch since the last call of take_timings(), by name. A device whose
// kernels are not timed tells the times of its batches.
struct StageTime {
  std::string name;
  double seconds = 0;
  int calls = 0;
};

class Backend {
 public:
  virtual ~Backend() = default;
  virtual std::string name()
      const = 0;  // "cpu", "cpu-reference", "vulkan:0 llvmpipe (LLVM 15.0.6, 256 bits)"
  virtual bool is_gpu() const = 0;
  // Returns whether it computes beside the processor: neither a CPU path nor a software device.
  virtual bool is_hardware() const { return false; }

  virtual std::vector<EdgePoint> detect_edges(const ImageView& image,
                                              const EdgeOptions& options) = 0;
  // Makes the tensors of a view. `image` may be empty (width 0): then Psi, edge support and shading
  // are 0 in this view. InputError naming the size: a tensor or an image too large for the memory
  // or the device.
  virtual ViewHandle make_view(std::span<const EdgePoint> edges, int width, int height,
                               const ImageView& image, const Intrinsics& intrinsics,
                               const TensorOptions& options) = 0;
  virtual void template_score(const BackendView& view, std::span<const TemplatePoint> points,
                              std::span<const TemplateJob> jobs, int anchor_step,
                              std::span<TemplateHit> hits) = 0;
  // Copies model points and returns them. LogicError where check_template_points() throws. GpuError
  // where one binding does not take them.
  virtual ModelPointsHandle make_model_points(std::span<const ModelPoint> points) = 0;
  virtual void template_project(const BackendModelPoints& points,
                                std::span<const TemplateProjectJob> jobs,
                                const TemplateProjectOptions& options,
                                std::span<TemplatePoint> projected,
                                std::span<std::uint32_t> too_near) = 0;
  // Scans templates over regions of a view. `hits`: [region][place of the template].
  virtual void template_scan(const BackendView& view, const BackendModelPoints& points,
                             const TemplateScan& scan, std::span<TemplateHit> hits) = 0;
  virtual void pose_normal_equations(std::span<const ViewHandle> views,
                                     std::span<const ModelPoint> points,
                                     std::span<const PoseProblem> problems, const PoseLoss& loss,
                                     std::span<NormalEquations> out) = 0;
  virtual PosePointsHandle make_pose_points(Unfilled<ModelPoint> points) = 0;
  virtual void pose_normal_equations(std::span<const ViewHandle> views,
                                     const BackendPosePoints& points,
                                     std::span<const PoseProblem> problems, const PoseLoss& loss,
                                     std::span<NormalEquations> out) = 0;
  virtual void pose_score(std::span<const ViewHandle> views, std::span<const ModelPoint> points,
                          std::span<const PoseProblem> problems, const PoseScoreOptions& options,
                          std::span<PoseScore> out) = 0;
  // Copies a depth image and returns it. InputError naming the size: too large for the memory or
  // the device.
  virtual DepthHandle make_depth(const DepthView& depth) = 0;
  virtual SurfacePointsHandle make_surface_points(Unfilled<SurfacePoint> points) = 0;
  virtual void pose_depth(std::span<const DepthHandle> views, const BackendSurfacePoints& points,
                          std::span<const PoseProblem> problems, const PoseDepthOptions& options,
                          std::span<PoseDepth> out) = 0;
  virtual void edge_support(std::span<const ViewHandle> views, std::span<const SupportPoint> points,
                            std::span<const SupportProblem> problems,
                            std::span<EdgeSupport> out) = 0;
  virtual void depth_raster(const TriangleMesh& mesh, std::span<const DepthJob> jobs, int width,
                            int height, std::span<float> depth) = 0;
  virtual void point_visibility(const TriangleMesh& mesh, const VisibilityPoints& points,
                                std::span<const VisibilityJob> jobs, int size,
                                std::span<std::uint8_t> flags) = 0;
  virtual void shading_sums(std::span<const ShadedView> views, const TriangleMesh& mesh,
                            std::span<const ShadingJob> jobs, float tolerance_m,
                            std::span<ShadingSums> out) = 0;
  virtual void candidate_map(std::span<const MapEdge> edges, std::span<const CandidateMap> maps,
                             int width, int height, std::span<std::uint32_t> nearest) = 0;
  virtual ChamferHandle combination_chamfer(const ChamferView& view,
                                            const CombinationBits& combinations,
                                            const ChamferOptions& options) = 0;
  // Returns the mutual information of one view, nats.
  virtual double mutual_information(const BackendChamfer& chamfer,
                                    std::span<const ParticleBelief> beliefs,
                                    const InformationOptions& options) = 0;
  // Returns what combination_chamfer and mutual_information give of each view, nats: all views side
  // by side.
  virtual std::vector<double> view_information(std::span<const ChamferView> views,
                                               const CombinationBits& combinations,
                                               const ChamferOptions& chamfer,
                                               std::span<const ParticleBelief> beliefs,
                                               const InformationOptions& information) = 0;
  // Returns the threads that host code may use beside the kernels.
  virtual ThreadPool& threads() = 0;
  // Returns what the device did since the backend was made. All 0 on the CPU.
  virtual DeviceWork device_work() const { return {}; }

  std::vector<StageTime> take_timings();

 protected:
  void add_time(const std::string& name, double seconds);

 private:
  std::vector<StageTime> timings_;
};

struct DeviceInfo {
  int index = 0;  // as in "vulkan:INDEX"
  std::string name;
  std::string driver;  // name and version
  std::string api_version;
  bool hardware = false;  // false: a software rasteriser such as lavapipe
  bool discrete =
      false;  // a card with memory of its own, beside a processor's own graphics the faster one
  std::uint64_t memory_bytes = 0;
  std::uint64_t max_storage_buffer_bytes = 0;
};

// Lists the Vulkan devices. Empty where there is no Vulkan loader, no device, or the project was
// built without Vulkan.
std::vector<DeviceInfo> vulkan_devices();

struct BackendOptions {
  // Takes the time of every kernel on a device's clock. The device then works on one kernel after
  // the other, also where two could run side by side. A CPU path always takes times.
  bool time_kernels = false;
};

std::unique_ptr<Backend> make_cpu_backend(int threads = 0);
std::unique_ptr<Backend> make_reference_backend();
// Opens a Vulkan device. Throws GpuError where the device is missing or lacks a feature the kernels
// need, InputError where the project was built without Vulkan.
std::unique_ptr<Backend> make_vulkan_backend(int device_index, const BackendOptions& options = {});

// Returns the devices in the order in which they are tried: discrete cards, other hardware,
// software devices; of a kind in the order they came.
std::vector<DeviceInfo> in_order_of_use(std::vector<DeviceInfo> devices);
// Returns the index of the first in that order, 0 where there is none.
int usual_vulkan_device();

// Makes the backend of a word: "auto", "cpu", "cpu-reference", "vulkan" (the usual device) or
// "vulkan:INDEX"; auto takes the first hardware Vulkan device in the order of use that can be
// opened, else the fast CPU path. Throws InputError on another word and where the device asked for
// does not exist.
std::unique_ptr<Backend> make_backend(const std::string& choice,
                                      const BackendOptions& options = {});

}  // namespace edgescout
