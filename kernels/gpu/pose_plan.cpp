#include "kernels/gpu/pose_plan.h"

#include <algorithm>
#include <numeric>

#include "kernels/error.h"
#include "kernels/gpu/point_range.h"
#include "kernels/pose_depth.h"
#include "kernels/pose_problems.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(ModelPoint) == PosePoints::point_bytes);
static_assert(sizeof(SurfacePoint) == PosePoints::point_bytes);
static_assert(sizeof(PoseProblem) == 4 * POSE_PROBLEM_WORDS);

constexpr std::uint32_t max_run = 1u << 15;  // any device takes so many workgroups in y

}  // namespace

std::uint32_t groups_to_fill(const Device& device) {
  return device.info().hardware || !device.unified_memory() ? 1024 : 1;
}

std::size_t poses_that_fit(const Device& device, std::span<const PoseProblem> problems,
                           std::uint32_t sums) {
  const std::size_t most = device.max_band_bytes();
  PointRange range;
  std::size_t count = 0;
  while (count < problems.size()) {
    range.include(problems[count].first_point, problems[count].point_count);
    const std::size_t results = (count + 1) * std::max(sizeof(PoseProblem), sums * sizeof(float));
    if (count > 0 && std::max(results, range.size() * PosePoints::point_bytes) > most) break;
    ++count;
  }
  return count;
}

PosePlan plan_poses(std::span<const PoseProblem> problems, std::size_t points, std::size_t views,
                    std::uint32_t min_groups) {
  check_pose_problems(problems, points, views);
  std::uint32_t longest = 1;
  PointRange range;
  for (const PoseProblem& problem : problems) {
    longest = std::max(longest, problem.point_count);
    range.include(problem.first_point, problem.point_count);
  }
  PosePlan plan;
  plan.first_point = range.begin;
  plan.point_count = range.size();
  plan.order.resize(problems.size());
  std::iota(plan.order.begin(), plan.order.end(), 0u);
  std::ranges::stable_sort(plan.order, {}, [&](std::uint32_t i) { return problems[i].view; });
  for (std::uint32_t n = 0; n < plan.order.size(); ++n) {
    const std::uint32_t view = problems[plan.order[n]].view;
    if (plan.runs.empty() || plan.runs.back().view != view || plan.runs.back().count == max_run)
      plan.runs.push_back({view, n, 0});
    ++plan.runs.back().count;
  }
  const std::uint32_t wanted = groups_for(
      min_groups, std::max<std::uint32_t>(1, static_cast<std::uint32_t>(problems.size())));
  plan.parts = std::clamp(wanted, 1u, groups_for(longest, POSE_GROUP));
  return plan;
}

PoseCamera pose_camera(const Intrinsics& k) { return {k.fx, k.fy, k.cx, k.cy, POSE_MIN_DEPTH_M}; }

void PoseBuffers::upload(Batch& batch, const PosePlan& plan, const PosePoints& points,
                         std::span<const PoseProblem> problems, std::uint32_t sums) {
  std::vector<PoseProblem> sorted;
  sorted.reserve(problems.size());
  for (std::uint32_t i : plan.order) {
    sorted.push_back(problems[i]);
    if (!points.on_device) sorted.back().first_point -= plan.first_point;
  }
  host_results_.assign(problems.size() * plan.parts * sums, 0.0f);
  if (!points.on_device) {
    points_.reserve(device_, plan.point_count * PosePoints::point_bytes, "points of poses");
    batch.upload(points_, points.part(plan.first_point, plan.point_count));
  }
  bound_points_ = points.on_device ? points.on_device : &points_;
  problems_.reserve(device_, sorted.size(), "pose problems");
  results_.reserve(device_, host_results_.size(), "pose sums");
  batch.upload<PoseProblem>(problems_, sorted);
  batch.barrier();
}

void PoseBuffers::total(const PosePlan& plan, std::size_t n, std::span<double> totals) const {
  std::ranges::fill(totals, 0.0);
  for (std::uint32_t part = 0; part < plan.parts; ++part)
    for (std::size_t s = 0; s < totals.size(); ++s)
      totals[s] += double(host_results_[(n * plan.parts + part) * totals.size() + s]);
}

}  // namespace edgescout::gpu
