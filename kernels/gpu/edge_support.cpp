#include "kernels/gpu/edge_support.h"

#include <algorithm>

#include "edge_support.spv.h"
#include "kernels/edge_support_push.h"
#include "kernels/gpu/point_range.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(SupportPoint) == 4 * SUPPORT_POINT_WORDS);
static_assert(sizeof(SupportProblem) == 4 * SUPPORT_PROBLEM_WORDS);
static_assert(sizeof(SupportSums) == 4 * SUPPORT_SUM_WORDS);

// Displacements and log ratios, word by word.
std::vector<std::int32_t> tables() {
  std::vector<std::int32_t> words;
  for (const SupportDisplacement& d : support_displacements()) {
    words.push_back(d.x_px);
    words.push_back(d.y_px);
  }
  for (const auto& of_kind : support_log_ratios())
    for (const auto& by_chance : of_kind)
      words.insert(words.end(), by_chance.begin(), by_chance.end());
  return words;
}

PointRange range_of(std::span<const SupportProblem> problems) {
  PointRange range;
  for (const SupportProblem& problem : problems)
    range.include(problem.first_point, problem.point_count);
  return range;
}

}  // namespace

SupportScorer::SupportScorer(const Device& device)
    : device_(device),
      kernel_(device, {"edge_support", edge_support_spv, 5, sizeof(EdgeSupportPush), {}}) {}

std::size_t SupportScorer::that_fit(std::span<const SupportProblem> problems) const {
  const std::size_t most = device_.max_band_bytes();
  PointRange range;
  std::size_t count = 0;
  while (count < problems.size()) {
    range.include(problems[count].first_point, problems[count].point_count);
    const std::size_t bytes =
        std::max((count + 1) * sizeof(SupportSums), range.size() * sizeof(SupportPoint));
    if (count > 0 && bytes > most) break;
    ++count;
  }
  return count;
}

void SupportScorer::upload(Batch& batch, std::span<const SupportPoint> points,
                           std::span<const SupportProblem> problems) {
  const PointRange range = range_of(problems);
  std::vector<SupportProblem> sorted;
  for (const std::uint32_t i : order_) {
    sorted.push_back(problems[i]);
    sorted.back().first_point -= range.begin;
  }
  const std::vector<std::int32_t> words = tables();
  points_.reserve(device_, range.size(), "support points");
  problems_.reserve(device_, sorted.size(), "support problems");
  tables_.reserve(device_, words.size(), "support tables");
  sums_.reserve(device_, sorted.size() * SUPPORT_SUM_WORDS, "support sums");
  batch.upload(points_, points.subspan(range.begin, range.size()));
  batch.upload<SupportProblem>(problems_, sorted);
  batch.upload<std::int32_t>(tables_, words);
  batch.barrier();
}

void SupportScorer::record(Batch& batch, std::span<const SupportMapView> views,
                           std::span<const SupportPoint> points,
                           std::span<const SupportProblem> problems) {
  const auto view_of = [&](std::uint32_t i) { return problems[i].view; };
  order_.clear();
  for (std::uint32_t i = 0; i < problems.size(); ++i)
    if (views[view_of(i)].map) order_.push_back(i);
  std::ranges::stable_sort(order_, {}, view_of);
  host_sums_.resize(order_.size());
  if (order_.empty()) return;
  upload(batch, points, problems);
  // A run of problems in one view is a dispatch.
  for (std::size_t first = 0, last = 0; first < order_.size(); first = last) {
    const SupportMapView& view = views[view_of(order_[first])];
    while (last < order_.size() && view_of(order_[last]) == view_of(order_[first])) ++last;
    const EdgeSupportPush push{
        static_cast<std::uint32_t>(view.width), static_cast<std::uint32_t>(view.height),
        static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first)};
    batch.dispatch(kernel_, spread(push.problem_count),
                   {*view.map, points_, problems_, tables_, sums_}, push);
  }
  batch.download<SupportSums>(sums_, host_sums_);
}

void SupportScorer::collect(std::span<EdgeSupport> out) const {
  std::ranges::fill(out, EdgeSupport{});
  for (std::size_t n = 0; n < order_.size(); ++n) out[order_[n]] = to_edge_support(host_sums_[n]);
}

}  // namespace edgescout::gpu
