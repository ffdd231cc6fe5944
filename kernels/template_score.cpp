#include "kernels/template_score.h"

#include <algorithm>
#include <cstring>

#include "kernels/error.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr std::uint32_t outside = 255;

std::uint32_t eight_bit(std::uint16_t value) {
  return std::min(outside, (std::uint32_t(value) + (1u << (TEMPLATE_SCORE_SHIFT - 1))) >> TEMPLATE_SCORE_SHIFT);
}

// The tensor as 8-bit planes [bin][y][x] with a margin of `outside` values, so that a template may hang over the border.
struct Planes {
  int left, top, stride, rows;
  std::vector<std::uint8_t> values;
  const std::uint8_t* at(int x, int y, int bin) const {
    return values.data() + (std::size_t(bin) * rows + (y + top)) * stride + (x + left);
  }
};

constexpr int block_columns = 32, block_rows = 4;

struct Bounds {
  int x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};

Bounds touched(const TensorShape& shape, std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs) {
  Bounds b{0, shape.width - 1, 0, shape.height - 1};
  for (const TemplateJob& job : jobs)
    for (std::uint32_t p = 0; p < job.point_count; ++p) {
      const TemplatePoint& point = points[job.first_point + p];
      b.x_min = std::min(b.x_min, job.x0 + point.dx_px);
      b.y_min = std::min(b.y_min, job.y0 + point.dy_px);
      b.x_max = std::max(b.x_max, job.x0 + point.dx_px + int(job.columns) + block_columns);
      b.y_max = std::max(b.y_max, job.y0 + point.dy_px + int(job.rows) + block_rows);
    }
  return b;
}

Planes make_planes(std::span<const std::uint16_t> tensor, const TensorShape& shape, const Bounds& b, ThreadPool& pool) {
  Planes planes;
  planes.left = -b.x_min;
  planes.top = -b.y_min;
  planes.stride = b.x_max - b.x_min + 1;
  planes.rows = b.y_max - b.y_min + 1;
  planes.values.assign(std::size_t(shape.bins) * planes.rows * planes.stride, outside);
  pool.for_each(shape.bins, [&](std::size_t bin) {
    for (int y = 0; y < shape.height; ++y) {
      auto* row = const_cast<std::uint8_t*>(planes.at(0, y, static_cast<int>(bin)));
      for (int x = 0; x < shape.width; ++x)
        row[x] = static_cast<std::uint8_t>(eight_bit(tensor[shape.index(x, y, static_cast<int>(bin))]));
    }
  });
  return planes;
}

using Sums = std::uint16_t __attribute__((vector_size(64)));
using Values = std::uint8_t __attribute__((vector_size(32)));

// Sums of a template at block_rows x block_columns anchors: the block stays in registers while the points go by.
EDGESCOUT_SIMD_CLONES
void sum_block(const std::uint8_t* const* sources, std::uint32_t count, std::size_t offset, std::size_t stride,
               std::uint16_t* sums) {
  Sums total[block_rows] = {};
  for (std::uint32_t p = 0; p < count; ++p) {
    const std::uint8_t* source = sources[p] + offset;
    for (int r = 0; r < block_rows; ++r) {
      Values values;
      std::memcpy(&values, source + r * stride, sizeof values);
      total[r] += __builtin_convertvector(values, Sums);
    }
  }
  std::memcpy(sums, total, sizeof total);
}

TemplateHit best_of_job(const Planes& planes, std::span<const TemplatePoint> points, const TemplateJob& job) {
  const std::uint8_t* sources[TEMPLATE_SCORE_MAX_POINTS];
  for (std::uint32_t p = 0; p < job.point_count; ++p) {
    const TemplatePoint& point = points[job.first_point + p];
    sources[p] = planes.at(job.x0 + point.dx_px, job.y0 + point.dy_px, point.bin);
  }
  TemplateHit hit{~0u, job.x0, job.y0};
  std::uint16_t sums[block_rows * block_columns];
  for (std::uint32_t y = 0; y < job.rows; y += block_rows)
    for (std::uint32_t x = 0; x < job.columns; x += block_columns) {
      sum_block(sources, job.point_count, std::size_t(y) * planes.stride + x, planes.stride, sums);
      for (std::uint32_t r = 0; r < std::min<std::uint32_t>(block_rows, job.rows - y); ++r)
        for (std::uint32_t c = 0; c < std::min<std::uint32_t>(block_columns, job.columns - x); ++c) {
          const TemplateHit here{sums[r * block_columns + c], job.x0 + int(x + c), job.y0 + int(y + r)};
          // Blocks are visited column by column, so equal sums are decided by position, not by order.
          if (here.sum < hit.sum || (here.sum == hit.sum && (here.y < hit.y || (here.y == hit.y && here.x < hit.x)))) hit = here;
        }
    }
  return hit;
}

void check_jobs(const TensorShape& shape, std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs,
                std::size_t hits) {
  check(hits == jobs.size(), "template_score: as many hits as jobs");
  for (const TemplatePoint& point : points) check(point.bin < shape.bins, "template_score: bin out of range");
  for (const TemplateJob& job : jobs) {
    check(job.point_count >= 1 && job.point_count <= TEMPLATE_SCORE_MAX_POINTS, "template_score: points of a template");
    check(std::size_t(job.first_point) + job.point_count <= points.size(), "template_score: points beyond the list");
    check(job.columns >= 1 && job.rows >= 1, "template_score: a job without anchors");
  }
}

}  // namespace

void template_score_reference(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                              std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs,
                              std::span<TemplateHit> hits) {
  check_jobs(shape, points, jobs, hits.size());
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    const TemplateJob& job = jobs[j];
    hits[j] = {~0u, job.x0, job.y0};
    for (int y = job.y0; y < job.y0 + int(job.rows); ++y)
      for (int x = job.x0; x < job.x0 + int(job.columns); ++x) {
        std::uint32_t sum = 0;
        for (const TemplatePoint& point : points.subspan(job.first_point, job.point_count)) {
          const int px = x + point.dx_px, py = y + point.dy_px;
          const bool inside = px >= 0 && px < shape.width && py >= 0 && py < shape.height;
          sum += inside ? eight_bit(tensor[shape.index(px, py, point.bin)]) : outside;
        }
        if (sum < hits[j].sum) hits[j] = {sum, x, y};
      }
  }
}

void template_score_fast(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                         std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs,
                         std::span<TemplateHit> hits, ThreadPool& pool) {
  check_jobs(shape, points, jobs, hits.size());
  if (jobs.empty()) return;
  const Planes planes = make_planes(tensor, shape, touched(shape, points, jobs), pool);
  constexpr std::size_t chunk = 64;
  pool.for_each((jobs.size() + chunk - 1) / chunk, [&](std::size_t c) {
    for (std::size_t j = c * chunk; j < std::min(jobs.size(), (c + 1) * chunk); ++j)
      hits[j] = best_of_job(planes, points, jobs[j]);
  });
}

}  // namespace edgescout
