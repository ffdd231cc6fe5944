#include "kernels/template_score.h"

#include <algorithm>
#include <cstring>

#include "kernels/error.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr std::uint32_t outside = TEMPLATE_SCORE_OUTSIDE;

std::uint32_t six_bit(std::uint16_t value) {
  return std::min(outside,
                  (std::uint32_t(value) + (1u << (TEMPLATE_SCORE_SHIFT - 1))) >> TEMPLATE_SCORE_SHIFT);
}

// The tensor as planes with a margin of `outside` values, so that a template may hang over the border.
// Columns are sorted by their remainder, [bin][y][x % step][x / step]: anchors `step` apart lie side by side.
struct Planes {
  int left, top, step, stride, rows, bins;
  std::vector<std::uint8_t> values;  // after the bins' planes, one of zeros
  const std::uint8_t* at(int x, int y, int bin) const {
    const int column = x + left;
    return values.data() + ((std::size_t(bin) * rows + (y + top)) * step + column % step) * stride +
           column / step;
  }
  std::size_t next_row() const { return std::size_t(step) * step * stride; }  // of anchors
};

constexpr int block_columns = 32, block_rows = 8;

struct Bounds {
  int x_min = 0, x_max = 0, y_min = 0, y_max = 0;
};

Bounds touched(const TensorShape& shape, std::span<const TemplatePoint> points,
               std::span<const TemplateJob> jobs, int step) {
  Bounds b{0, shape.width - 1, 0, shape.height - 1};
  for (const TemplateJob& job : jobs)
    for (std::uint32_t p = 0; p < job.point_count; ++p) {
      const TemplatePoint& point = points[job.first_point + p];
      b.x_min = std::min(b.x_min, job.x0 + point.dx_px);
      b.y_min = std::min(b.y_min, job.y0 + point.dy_px);
      b.x_max = std::max(b.x_max, job.x0 + point.dx_px + step * (int(job.columns) + block_columns));
      b.y_max = std::max(b.y_max, job.y0 + point.dy_px + step * (int(job.rows) + block_rows));
    }
  return b;
}

Planes make_planes(std::span<const std::uint16_t> tensor, const TensorShape& shape, const Bounds& b, int step,
                   ThreadPool& pool) {
  Planes planes;
  planes.step = step;
  planes.bins = shape.bins;
  planes.left = -b.x_min;
  planes.top = -b.y_min;
  planes.stride = (b.x_max - b.x_min) / step + 1;
  planes.rows = b.y_max - b.y_min + 1;
  const std::size_t plane = std::size_t(planes.rows) * step * planes.stride;
  planes.values.assign((shape.bins + 1) * plane, outside);
  std::fill(planes.values.end() - plane, planes.values.end(), std::uint8_t{0});
  pool.for_each(shape.bins, [&](std::size_t bin) {
    for (int y = 0; y < shape.height; ++y)
      for (int x = 0; x < shape.width; ++x)
        planes.values[planes.at(x, y, int(bin)) - planes.values.data()] =
            static_cast<std::uint8_t>(six_bit(tensor[shape.index(x, y, int(bin))]));
  });
  return planes;
}

using Values = std::uint8_t __attribute__((vector_size(block_columns)));
using Sums = std::uint16_t __attribute__((vector_size(block_columns)));

// Sums of a template at block_rows x block_columns anchors. The block stays in registers while the points go
// by; four values add up in a byte before even and odd columns are widened apart.
EDGESCOUT_SIMD_CLONES
void sum_block(const std::uint8_t* const* sources, std::uint32_t count, std::size_t offset,
               std::size_t stride, std::uint16_t* sums) {
  Sums even[block_rows] = {}, odd[block_rows] = {};
  for (std::uint32_t p = 0; p < count; p += 4) {
    // A group cut short is filled up from the plane of zeros.
    for (int r = 0; r < block_rows; ++r) {
      Values four, next;
      std::memcpy(&four, sources[p] + offset + r * stride, sizeof four);
      for (int q = 1; q < 4; ++q) {
        std::memcpy(&next, sources[p + q] + offset + r * stride, sizeof next);
        four += next;
      }
      Sums pairs;
      std::memcpy(&pairs, &four, sizeof pairs);
      even[r] += pairs & 255;
      odd[r] += pairs >> 8;
    }
  }
  for (int r = 0; r < block_rows; ++r)
    for (int i = 0; i < block_columns / 2; ++i) {
      sums[r * block_columns + 2 * i] = even[r][i];
      sums[r * block_columns + 2 * i + 1] = odd[r][i];
    }
}

TemplateHit best_of_job(const Planes& planes, std::span<const TemplatePoint> points, const TemplateJob& job) {
  const std::uint8_t* sources[TEMPLATE_SCORE_MAX_POINTS + 3];
  for (std::uint32_t p = 0; p < job.point_count; ++p) {
    const TemplatePoint& point = points[job.first_point + p];
    sources[p] = planes.at(job.x0 + point.dx_px, job.y0 + point.dy_px, point.bin);
  }
  for (std::uint32_t p = job.point_count; p % 4 != 0; ++p)
    sources[p] = planes.at(job.x0, job.y0, planes.bins);
  TemplateHit hit{~0u, job.x0, job.y0};
  std::uint16_t sums[block_rows * block_columns];
  for (std::uint32_t y = 0; y < job.rows; y += block_rows)
    for (std::uint32_t x = 0; x < job.columns; x += block_columns) {
      sum_block(sources, job.point_count, y * planes.next_row() + x, planes.next_row(), sums);
      for (std::uint32_t r = 0; r < std::min<std::uint32_t>(block_rows, job.rows - y); ++r)
        for (std::uint32_t c = 0; c < std::min<std::uint32_t>(block_columns, job.columns - x); ++c) {
          const TemplateHit here{sums[r * block_columns + c], job.x0 + planes.step * int(x + c),
                                 job.y0 + planes.step * int(y + r)};
          // Blocks are visited column by column, so equal sums are decided by position, not by order.
          if (here.sum < hit.sum ||
              (here.sum == hit.sum && (here.y < hit.y || (here.y == hit.y && here.x < hit.x))))
            hit = here;
        }
    }
  return hit;
}

}  // namespace

void check_template_jobs(const TensorShape& shape, std::span<const TemplatePoint> points,
                         std::span<const TemplateJob> jobs, int anchor_step, std::size_t hits) {
  check(anchor_step >= 1 && anchor_step <= 16, "template_score: anchor step in [1, 16]");
  check(hits == jobs.size(), "template_score: as many hits as jobs");
  for (const TemplatePoint& point : points) check(point.bin < shape.bins, "template_score: bin out of range");
  for (const TemplateJob& job : jobs) {
    check(job.point_count >= 1 && job.point_count <= TEMPLATE_SCORE_MAX_POINTS,
          "template_score: points of a template");
    check(std::size_t(job.first_point) + job.point_count <= points.size(),
          "template_score: points beyond the list");
    check(job.columns >= 1 && job.rows >= 1, "template_score: a job without anchors");
  }
}

void template_score_reference(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                              std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs,
                              int anchor_step, std::span<TemplateHit> hits) {
  check_template_jobs(shape, points, jobs, anchor_step, hits.size());
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    const TemplateJob& job = jobs[j];
    hits[j] = {~0u, job.x0, job.y0};
    for (std::uint32_t row = 0; row < job.rows; ++row)
      for (std::uint32_t column = 0; column < job.columns; ++column) {
        const int x = job.x0 + anchor_step * int(column), y = job.y0 + anchor_step * int(row);
        std::uint32_t sum = 0;
        for (const TemplatePoint& point : points.subspan(job.first_point, job.point_count)) {
          const int px = x + point.dx_px, py = y + point.dy_px;
          const bool inside = px >= 0 && px < shape.width && py >= 0 && py < shape.height;
          sum += inside ? six_bit(tensor[shape.index(px, py, point.bin)]) : outside;
        }
        if (sum < hits[j].sum) hits[j] = {sum, x, y};
      }
  }
}

void template_score_fast(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                         std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs,
                         int anchor_step, std::span<TemplateHit> hits, ThreadPool& pool) {
  check_template_jobs(shape, points, jobs, anchor_step, hits.size());
  if (jobs.empty()) return;
  const Planes planes =
      make_planes(tensor, shape, touched(shape, points, jobs, anchor_step), anchor_step, pool);
  constexpr std::size_t chunk = 64;
  pool.for_each((jobs.size() + chunk - 1) / chunk, [&](std::size_t c) {
    for (std::size_t j = c * chunk; j < std::min(jobs.size(), (c + 1) * chunk); ++j)
      hits[j] = best_of_job(planes, points, jobs[j]);
  });
}

}  // namespace edgescout
