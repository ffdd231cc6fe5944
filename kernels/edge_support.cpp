#include "kernels/edge_support.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/error.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr double UNITS_PER_NAT = 64;
constexpr int COPIES = static_cast<int>(SUPPORT_COPIES);
constexpr int LONGEST_DISPLACEMENT_PX = 14;

std::array<SupportDisplacement, SUPPORT_COPIES> make_displacements() {
  std::array<SupportDisplacement, SUPPORT_COPIES> displacements;
  for (int k = 0; k < COPIES; ++k) {
    const double angle = std::numbers::pi * (k % 8) / 4,
                 length = k < 8 ? LONGEST_DISPLACEMENT_PX / 2.0 : LONGEST_DISPLACEMENT_PX;
    displacements[std::size_t(k)] = {
        static_cast<std::int32_t>(std::lround(length * std::cos(angle))),
        static_cast<std::int32_t>(std::lround(length * std::sin(angle)))};
  }
  return displacements;
}

SupportLogRatios make_log_ratios() {
  SupportLogRatios ratios;
  for (int interior = 0; interior < 2; ++interior)
    for (int c = 0; c <= COPIES; ++c) {
      const double p1 = interior ? SUPPORT_INSIDE : SUPPORT_ON_SILHOUETTE;
      const double p0 = std::clamp(double(c) / COPIES, SUPPORT_MIN_CHANCE, p1);
      const auto units = [](double nats) {
        return static_cast<std::int32_t>(std::lround(UNITS_PER_NAT * nats));
      };
      ratios[interior][1][c] = units(std::log(p1 / p0));
      ratios[interior][0][c] = units(std::log((1 - p1) / (1 - p0)));
    }
  return ratios;
}

// Of a sector with this log-likelihood ratio, which may be hidden.
double maybe_hidden(double log_ratio) {
  return log_ratio > 0
             ? log_ratio + std::log(SUPPORT_VISIBLE + (1 - SUPPORT_VISIBLE) * std::exp(-log_ratio))
             : std::log(SUPPORT_VISIBLE * std::exp(log_ratio) + 1 - SUPPORT_VISIBLE);
}

bool is_supported(const SupportView& view, int x, int y, int bin) {
  return x >= 0 && y >= 0 && x < view.width && y < view.height &&
         (view.map[std::size_t(y) * view.width + x] >> bin & 1u);
}

SupportSums sum_reference(const SupportView& view, std::span<const SupportPoint> points) {
  SupportSums sums;
  for (const SupportPoint& p : points) {
    const bool supported = is_supported(view, p.x_px, p.y_px, p.bin);
    int chance = 0;
    for (int k = 0; k < COPIES; ++k) {
      const SupportDisplacement& d = support_displacements()[k];
      const bool of_copy = is_supported(view, p.x_px + d.x_px, p.y_px + d.y_px, p.bin);
      chance += of_copy;
      sums.supported[k + 1] += of_copy ? p.weight : 0;
    }
    sums.supported[0] += supported ? p.weight : 0;
    sums.weight += p.weight;
    const bool interior = p.part >= SUPPORT_SECTORS;
    sums.log_ratios[p.part] += p.weight * support_log_ratios()[interior][supported][chance];
  }
  return sums;
}

// Offsets in the map of the displaced copies of a point away from the border.
using Offsets = std::array<std::int32_t, SUPPORT_COPIES>;

Offsets offsets_of(const SupportView& view) {
  Offsets offsets;
  for (int k = 0; k < COPIES; ++k)
    offsets[k] = support_displacements()[k].y_px * view.width + support_displacements()[k].x_px;
  return offsets;
}

bool has_margin(const SupportView& view, const SupportPoint& p) {
  constexpr int margin = LONGEST_DISPLACEMENT_PX;
  return p.x_px >= margin && p.y_px >= margin && p.x_px < view.width - margin &&
         p.y_px < view.height - margin;
}

EDGESCOUT_SIMD_CLONES
void add_inner_points(const SupportView& view, const Offsets& offsets,
                      std::span<const SupportPoint> points, SupportSums& sums) {
  std::uint32_t copies[SUPPORT_COPIES] = {};
  for (const SupportPoint& p : points) {
    const std::uint32_t* at = view.map.data() + std::size_t(p.y_px) * view.width + p.x_px;
    const std::uint32_t weight = p.weight, supported = *at >> p.bin & 1u;
    std::uint32_t chance = 0;
    for (int k = 0; k < COPIES; ++k) {
      const std::uint32_t of_copy = at[offsets[k]] >> p.bin & 1u;
      chance += of_copy;
      copies[k] += of_copy * weight;
    }
    sums.supported[0] += supported * weight;
    sums.weight += weight;
    sums.log_ratios[p.part] += static_cast<std::int32_t>(weight) *
                               support_log_ratios()[p.part >= SUPPORT_SECTORS][supported][chance];
  }
  for (int k = 0; k < COPIES; ++k) sums.supported[k + 1] += copies[k];
}

void add(SupportSums& sums, const SupportSums& other) {
  for (std::size_t j = 0; j < SUPPORT_PARTS; ++j) sums.log_ratios[j] += other.log_ratios[j];
  for (std::size_t k = 0; k <= SUPPORT_COPIES; ++k) sums.supported[k] += other.supported[k];
  sums.weight += other.weight;
}

SupportSums sum_fast(const SupportView& view, const Offsets& offsets,
                     std::span<const SupportPoint> points) {
  SupportSums sums;
  const auto is_inner = [&](const SupportPoint& p) { return has_margin(view, p); };
  while (!points.empty()) {
    const auto border = std::ranges::find_if_not(points, is_inner);
    add_inner_points(view, offsets, std::span(points.begin(), border), sums);
    const auto inner = std::find_if(border, points.end(), is_inner);
    add(sums, sum_reference(view, std::span(border, inner)));
    points = std::span(inner, points.end());
  }
  return sums;
}

void check_point(const SupportView& view, const SupportPoint& p) {
  check(p.x_px < view.width && p.y_px < view.height, "edge_support: a point outside the image");
  check(p.bin < SUPPORT_BINS && p.part < SUPPORT_PARTS, "edge_support: no such bin or part");
}

}  // namespace

const std::array<SupportDisplacement, SUPPORT_COPIES>& support_displacements() {
  static const auto displacements = make_displacements();
  return displacements;
}

const SupportLogRatios& support_log_ratios() {
  static const SupportLogRatios ratios = make_log_ratios();
  return ratios;
}

EdgeSupport to_edge_support(const SupportSums& sums) {
  if (sums.weight == 0) return {};
  const auto nats = [](std::int32_t units) { return units / (UNITS_PER_NAT * SUPPORT_WEIGHT_ONE); };
  double log_ratio = 0, interior = 0;
  for (std::size_t s = 0; s < SUPPORT_SECTORS; ++s) {
    const double inside = nats(sums.log_ratios[s + SUPPORT_SECTORS]);
    log_ratio += maybe_hidden(nats(sums.log_ratios[s]) + inside);
    interior += maybe_hidden(inside);
  }
  const std::uint32_t best = std::ranges::max(std::span(sums.supported).subspan(1));
  return {float(log_ratio), float(interior), float(sums.supported[0]) / float(sums.weight),
          float(best) / float(sums.weight)};
}

void check_edge_support(std::span<const SupportView> views, std::span<const SupportPoint> points,
                        std::span<const SupportProblem> problems, std::size_t results) {
  check(results == problems.size(), "edge_support: as many results as problems");
  for (const SupportProblem& problem : problems) {
    check(std::size_t(problem.first_point) + problem.point_count <= points.size(),
          "edge_support: points beyond the list");
    check(problem.view < views.size(), "edge_support: no such view");
    std::uint64_t weight = 0;
    for (const SupportPoint& p : points.subspan(problem.first_point, problem.point_count)) {
      check_point(views[problem.view], p);
      weight += p.weight;
    }
    check(weight <= SUPPORT_MAX_WEIGHT, "edge_support: weights too large");
  }
}

void edge_support_reference(std::span<const SupportView> views,
                            std::span<const SupportPoint> points,
                            std::span<const SupportProblem> problems, std::span<EdgeSupport> out) {
  check_edge_support(views, points, problems, out.size());
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const SupportView& view = views[problems[i].view];
    out[i] = view.map.empty()
                 ? EdgeSupport{}
                 : to_edge_support(sum_reference(
                       view, points.subspan(problems[i].first_point, problems[i].point_count)));
  }
}

void edge_support_fast(std::span<const SupportView> views, std::span<const SupportPoint> points,
                       std::span<const SupportProblem> problems, std::span<EdgeSupport> out,
                       ThreadPool& pool) {
  check_edge_support(views, points, problems, out.size());
  std::vector<Offsets> offsets;
  for (const SupportView& view : views) offsets.push_back(offsets_of(view));
  for_each_in_chunks(pool, problems.size(), 16, [&](std::size_t i) {
    const SupportView& view = views[problems[i].view];
    out[i] = view.map.empty() ? EdgeSupport{}
                              : to_edge_support(sum_fast(view, offsets[problems[i].view],
                                                         points.subspan(problems[i].first_point,
                                                                        problems[i].point_count)));
  });
}

}  // namespace edgescout
