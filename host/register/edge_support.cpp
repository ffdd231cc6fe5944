#include "host/register/edge_support.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/pose_geometry.h"
#include "kernels/thread_pool.h"
#include "kernels/undirected_angle.h"

namespace edgescout {

namespace {

constexpr std::uint32_t CELL_PX = 3;
constexpr std::uint32_t BINS_PER_CELL = 4;  // 22.5 degrees
constexpr float OBSERVATION_PX = 8;         // neighbouring points are found or missed together
constexpr std::size_t MOST_POINTS = 1000;   // of a pose; more add time only
constexpr float PI = std::numbers::pi_v<float>;

// A visible point in the image.
struct Landing {
  SupportPoint point;  // without a weight
  std::uint32_t cell;  // place and orientation; equal for points that count once
  float step_px;       // to the next point of its edge
};

// Evenly thinned. A landing stands for `steps` steps of edge.
struct Landings {
  std::vector<Landing> list;
  float steps = 1;
};

struct Center {
  float u, v;
};

std::uint8_t normal_bin(const ProjectedEdge<float>& edge) {
  const float angle = undirected_angle(-edge.dy, edge.dx);
  return std::uint8_t(std::uint32_t(std::floor(angle * float(SUPPORT_BINS) / PI + 0.5f)) %
                      SUPPORT_BINS);
}

std::uint8_t sector_about(const Center& center, const ProjectedEdge<float>& edge) {
  const float dx = edge.u - center.u, dy = edge.v - center.v;
  const bool is_upper = dy < 0 || (dy == 0 && dx < 0);
  const float angle = undirected_angle(dx, dy) + (is_upper ? PI : 0);
  return std::uint8_t(std::uint32_t(angle * float(SUPPORT_SECTORS) / (2 * PI)) % SUPPORT_SECTORS);
}

// Without weight and part.
SupportPoint to_support_point(const ProjectedEdge<float>& edge, const TensorShape& image) {
  // In float the sum may round up to the image's size.
  const auto pixel = [](float at, int size) {
    return std::uint16_t(std::min(int(std::floor(at + 0.5f)), size - 1));
  };
  return {pixel(edge.u, image.width), pixel(edge.v, image.height), 0, normal_bin(edge), 0};
}

std::uint32_t cell_of(const SupportPoint& p) {
  constexpr std::uint32_t most = 1u << 15;  // cells along an axis
  return (p.y_px / CELL_PX * most + p.x_px / CELL_PX) * (SUPPORT_BINS / BINS_PER_CELL) +
         p.bin / BINS_PER_CELL;
}

struct SeenPose {
  const EdgeModel& model;
  Se3 camera_from_object;
  const BackendView& tensor;
  const ShownEdges& shown;
};

Landings land(const SeenPose& p) {
  const Pose pose = to_pose(p.camera_from_object);
  const Intrinsics& k = p.tensor.intrinsics;
  const Eigen::Vector3d middle = p.camera_from_object * p.model.center_m;
  const Center center{float(k.fx * middle.x() / middle.z() + k.cx),
                      float(k.fy * middle.y() / middle.z() + k.cy)};
  const std::size_t all = p.shown.points.size(), kept = std::min(all, MOST_POINTS);
  Landings landings;
  if (all > kept) landings.steps = float(all) / float(kept);
  landings.list.reserve(kept);
  for (std::size_t n = 0; n < kept; ++n) {
    const std::size_t i = n * all / kept;
    const PosedPoint<float> posed = pose_point<float>(pose, p.shown.points[i]);
    if (!can_be_seen(posed.point)) continue;
    const ProjectedEdge<float> edge = project_edge(posed, k);
    if (!on_image(edge, p.tensor.shape.width, p.tensor.shape.height)) continue;
    SupportPoint point = to_support_point(edge, p.tensor.shape);
    const bool is_marked = !p.shown.on_silhouette.empty() && p.shown.on_silhouette[i];
    point.part = std::uint8_t(sector_about(center, edge) + (is_marked ? 0 : SUPPORT_SECTORS));
    const float step_px = float(p.model.raster_step_m) * std::hypot(edge.dx, edge.dy) /
                          (posed.point.z * posed.point.z);
    landings.list.push_back({point, cell_of(point), step_px});
  }
  return landings;
}

// By landing. A cell counts no more edge than crosses it, or than one of its points stands for.
std::vector<float> lengths_that_count_px(const Landings& landings) {
  std::vector<std::uint64_t> by_cell(landings.list.size());  // cell and, below it, landing
  for (std::uint32_t i = 0; i < by_cell.size(); ++i)
    by_cell[i] = std::uint64_t(landings.list[i].cell) << 32 | i;
  std::ranges::sort(by_cell);
  const auto landing_of = [&](std::size_t n) { return std::uint32_t(by_cell[n]); };
  std::vector<float> lengths(landings.list.size());
  for (std::size_t first = 0, last = 0; first < by_cell.size(); first = last) {
    float total = 0, most = float(CELL_PX);
    for (; last < by_cell.size() && by_cell[last] >> 32 == by_cell[first] >> 32; ++last) {
      const float step_px = landings.list[landing_of(last)].step_px;
      total += step_px * landings.steps;
      most = std::max(most, step_px);
    }
    const float share = std::min(1.0f, most / total) * landings.steps;
    for (std::size_t n = first; n < last; ++n)
      lengths[landing_of(n)] = share * landings.list[landing_of(n)].step_px;
  }
  return lengths;
}

std::vector<SupportPoint> support_points(const SeenPose& pose) {
  const Landings landings = land(pose);
  const std::vector<float> lengths = lengths_that_count_px(landings);
  std::vector<SupportPoint> points;
  points.reserve(lengths.size());
  constexpr std::size_t largest = SUPPORT_MAX_WEIGHT / MOST_POINTS;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const float weight = std::round(lengths[i] / OBSERVATION_PX * SUPPORT_WEIGHT_ONE);
    points.push_back(landings.list[i].point);
    points.back().weight = std::uint16_t(std::min(weight, float(largest)));
  }
  return points;
}

}  // namespace

Grid<EdgeSupport> edge_support(const Scene& scene, std::span<const ObjectPose> poses,
                               const Grid<ShownEdges>& shown) {
  const std::size_t views = scene.views.size(), pairs = poses.size() * views;
  ThreadPool& threads = scene.backend.threads();
  std::vector<std::vector<SupportPoint>> by_pair(pairs);
  for_each_in_chunks(threads, pairs, 16, [&](std::size_t i) {
    const ObjectPose& pose = poses[i / views];
    const ObjectView& view = scene.views[i % views];
    by_pair[i] = support_points({scene.models[std::size_t(pose.object)],
                                 view.camera_from_world * pose.world_from_object, *view.tensor,
                                 shown.values()[i]});
  });
  const JoinedLists<SupportPoint> joined = join_lists(
      pairs, [&](std::size_t i) -> const auto& { return by_pair[i]; }, 0, threads);
  std::vector<SupportProblem> problems;
  for (std::size_t i = 0; i < pairs; ++i)
    problems.push_back({joined.ranges[i].first, joined.ranges[i].count, std::uint32_t(i % views)});
  std::vector<ViewHandle> tensors;
  for (const ObjectView& view : scene.views) tensors.push_back(view.tensor);
  Grid<EdgeSupport> support(poses.size(), views);
  scene.backend.edge_support(tensors, joined.values, problems, support.values());
  return support;
}

Grid<EdgeSupport> edge_support(const Scene& scene, std::span<const ObjectPose> poses,
                               const Grid<VisibleInView>& visible) {
  Grid<ShownEdges> shown(visible.rows(), visible.columns());
  std::ranges::transform(visible.values(), shown.values().begin(), [](const VisibleInView& cell) {
    return ShownEdges{cell.points, cell.on_silhouette};
  });
  return edge_support(scene, poses, shown);
}

}  // namespace edgescout
