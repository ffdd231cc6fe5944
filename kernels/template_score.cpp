#include "kernels/template_score.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include "kernels/error.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr std::uint8_t outside = TEMPLATE_SCORE_OUTSIDE;

std::uint32_t capped(std::uint16_t value) {
  return std::min<std::uint32_t>(
      TEMPLATE_SCORE_CAP,
      (std::uint32_t(value) + (1u << (TEMPLATE_SCORE_SHIFT - 1))) >> TEMPLATE_SCORE_SHIFT);
}

// A part of the tensor as planes, `outside` around the image, so that a template may hang over the
// border. Columns are sorted by their remainder, [bin][y][x % step][x / step]: anchors `step` apart
// lie side by side. After the bins' planes come one of zeros and one of `outside`.
struct Planes {
  int left, top, step, stride, rows, bins;
  std::vector<std::uint32_t> column;  // where a column lies in its row
  std::vector<std::uint8_t> values;
  std::size_t plane() const { return std::size_t(rows) * step * stride; }
  std::size_t at(int x, int y, int bin) const {
    return (std::size_t(bin) * rows + (y + top)) * step * stride + column[x + left];
  }
  std::size_t zeros() const { return bins * plane(); }
  std::size_t nothing() const { return (bins + 1) * plane(); }
  std::size_t next_row() const { return std::size_t(step) * step * stride; }  // of anchors
};

constexpr int block_columns = 32, block_rows = 8;

// What jobs read: pixels, bins, and how far one point is moved over all anchors of a job, in whole
// blocks.
struct Bounds {
  int x_min = 0, x_max = 0, y_min = 0, y_max = 0, bin_max = 0, reach_x = 0, reach_y = 0;
};

constexpr std::size_t chunk_jobs = 64;

Bounds joined(const Bounds& a, const Bounds& b) {
  return {std::min(a.x_min, b.x_min),     std::max(a.x_max, b.x_max),
          std::min(a.y_min, b.y_min),     std::max(a.y_max, b.y_max),
          std::max(a.bin_max, b.bin_max), std::max(a.reach_x, b.reach_x),
          std::max(a.reach_y, b.reach_y)};
}

int reach_x(const TemplateJob& job, int step) { return step * (int(job.columns) + block_columns); }
int reach_y(const TemplateJob& job, int step) { return step * (int(job.rows) + block_rows); }

// How far the points of a template reach from its anchor. Words of 16 bits become vectors.
struct Extent {
  std::int16_t left = 32767, right = -32768, top = 32767, bottom = -32768;
  std::uint16_t bin = 0;
};

EDGESCOUT_SIMD_CLONES
Extent extent_of(const TemplatePoint* points, std::uint32_t count) {
  Extent e;
  for (std::uint32_t p = 0; p < count; ++p) {
    e.left = std::min(e.left, points[p].dx_px), e.right = std::max(e.right, points[p].dx_px);
    e.top = std::min(e.top, points[p].dy_px), e.bottom = std::max(e.bottom, points[p].dy_px);
    e.bin = std::max(e.bin, points[p].bin);
  }
  return e;
}

Bounds touched_by(const TemplateJob& job, const TemplatePoint* points, int step) {
  const Extent e = extent_of(points, job.point_count);
  const int x = reach_x(job, step), y = reach_y(job, step);
  return {job.x0 + e.left,
          job.x0 + e.right + x,
          job.y0 + e.top,
          job.y0 + e.bottom + y,
          int(e.bin),
          x,
          y};
}

// What all jobs read. Points that never reach the image are not read: the bounds do not go beyond
// its neighbourhood, however far away they lie.
Bounds touched(const TensorShape& shape, std::span<const TemplatePoint> points,
               std::span<const TemplateJob> jobs, int step, ThreadPool& pool) {
  std::vector<Bounds> of_chunks((jobs.size() + chunk_jobs - 1) / chunk_jobs);
  pool.for_each(of_chunks.size(), [&](std::size_t c) {
    const auto chunk =
        jobs.subspan(c * chunk_jobs, std::min(chunk_jobs, jobs.size() - c * chunk_jobs));
    of_chunks[c] = touched_by(chunk[0], points.data() + chunk[0].first_point, step);
    for (const TemplateJob& job : chunk)
      of_chunks[c] = joined(of_chunks[c], touched_by(job, points.data() + job.first_point, step));
  });
  Bounds b = std::accumulate(of_chunks.begin(), of_chunks.end(), of_chunks[0], joined);
  b.x_min = std::clamp(b.x_min, -b.reach_x, shape.width),
  b.y_min = std::clamp(b.y_min, -b.reach_y, shape.height);
  b.x_max = std::clamp(b.x_max, b.x_min + b.reach_x, std::max(b.x_min, shape.width) + b.reach_x);
  b.y_max = std::clamp(b.y_max, b.y_min + b.reach_y, std::max(b.y_min, shape.height) + b.reach_y);
  return b;
}

Planes make_planes(std::span<const std::uint16_t> tensor, const TensorShape& shape, const Bounds& b,
                   int step, ThreadPool& pool) {
  Planes planes;
  planes.step = step;
  planes.bins = shape.bins;
  planes.left = -b.x_min;
  planes.top = -b.y_min;
  planes.stride = (b.x_max - b.x_min) / step + 1;
  planes.rows = b.y_max - b.y_min + 1;
  for (int c = 0; c < b.x_max - b.x_min + 1; ++c)
    planes.column.push_back(static_cast<std::uint32_t>(c % step * planes.stride + c / step));
  planes.values.assign((shape.bins + 2) * planes.plane(), outside);
  std::fill_n(planes.values.begin() + static_cast<std::ptrdiff_t>(planes.zeros()), planes.plane(),
              std::uint8_t{0});
  const int tile = int(DCD_TILE), right = std::min(shape.width, b.x_max + 1),
            left = std::clamp(b.x_min, 0, shape.width), top = std::max(0, b.y_min),
            bottom = std::min(shape.height, b.y_max + 1);
  // In the order of the tensor, which is larger than the caches.
  pool.for_each(std::max(0, bottom - top), [&](std::size_t row) {
    const int y = top + int(row);
    std::uint8_t values[DCD_TILE];
    for (int x0 = left / tile * tile; x0 < right; x0 += tile) {
      const int begin = std::max(0, left - x0), end = std::min(tile, right - x0);
      for (int bin = 0; bin < shape.bins; ++bin) {
        const std::uint16_t* from = tensor.data() + shape.index(x0, y, bin);
        for (int i = 0; i < tile; ++i) values[i] = static_cast<std::uint8_t>(capped(from[i]));
        for (int first = begin; first < std::min(begin + step, end); ++first) {
          std::uint8_t* to = planes.values.data() + planes.at(x0 + first, y, bin);
          for (int i = first; i < end; i += step) *to++ = values[i];
        }
      }
    }
  });
  return planes;
}

using Values = std::uint8_t __attribute__((vector_size(block_columns)));
using Sums = std::uint16_t __attribute__((vector_size(block_columns)));

// Sums of a template at block_rows x block_columns anchors, even and odd columns apart.
struct BlockSums {
  Sums even[block_rows], odd[block_rows];
  std::uint16_t at(std::uint32_t row, std::uint32_t column) const {
    return column % 2 == 0 ? even[row][column / 2] : odd[row][column / 2];
  }
};

// Lanes of the columns that do not count, all ones.
struct LaneMask {
  Sums even = {}, odd = {};
  explicit LaneMask(std::uint32_t columns) {
    for (std::uint32_t i = 0; i < block_columns / 2; ++i) {
      even[i] = 2 * i < columns ? 0 : 0xffff;
      odd[i] = 2 * i + 1 < columns ? 0 : 0xffff;
    }
  }
};

// Returns the lowest of the first `rows`. The block stays in registers while the points go by; four
// values add up in a byte before even and odd columns are widened apart.
EDGESCOUT_SIMD_CLONES
std::uint32_t sum_block(const std::uint8_t* planes, const std::size_t* sources, std::uint32_t count,
                        std::size_t offset, std::size_t stride, std::uint32_t rows,
                        const LaneMask& mask, BlockSums& out) {
  Sums even[block_rows] = {}, odd[block_rows] = {};
  for (std::uint32_t p = 0; p < count; p += 4) {
    // A group cut short is filled up from the plane of zeros.
    for (int r = 0; r < block_rows; ++r) {
      Values four, next;
      std::memcpy(&four, planes + sources[p] + offset + r * stride, sizeof four);
      for (int q = 1; q < 4; ++q) {
        std::memcpy(&next, planes + sources[p + q] + offset + r * stride, sizeof next);
        four += next;
      }
      Sums pairs;
      std::memcpy(&pairs, &four, sizeof pairs);
      even[r] += pairs & 255;
      odd[r] += pairs >> 8;
    }
  }
  Sums lowest = mask.even | 0xffff;
  for (std::uint32_t r = 0; r < block_rows; ++r) {
    out.even[r] = even[r] | mask.even, out.odd[r] = odd[r] | mask.odd;
    const Sums both = out.even[r] < out.odd[r] ? out.even[r] : out.odd[r];
    const Sums lower = both < lowest ? both : lowest;
    lowest = r < rows ? lower : lowest;
  }
  std::uint16_t least = 0xffff;
  for (int i = 0; i < block_columns / 2; ++i) least = std::min<std::uint16_t>(least, lowest[i]);
  return least;
}

// The first row with such a sum; block_rows where there is none.
EDGESCOUT_SIMD_CLONES
int first_row_with(const BlockSums& sums, std::uint16_t wanted) {
  for (int r = 0; r < block_rows; ++r) {
    const auto same = (sums.even[r] == wanted) | (sums.odd[r] == wanted);
    std::uint64_t words[sizeof same / sizeof(std::uint64_t)], any = 0;
    std::memcpy(words, &same, sizeof same);
    for (const std::uint64_t word : words) any |= word;
    if (any != 0) return r;
  }
  return block_rows;
}

// Row and column of the first of these sums, row by row.
std::pair<int, int> first_in_block(const BlockSums& sums, std::uint32_t wanted) {
  const int r = first_row_with(sums, static_cast<std::uint16_t>(wanted));
  for (int c = 0; r < block_rows && c < block_columns; ++c)
    if (sums.at(r, c) == wanted) return {r, c};
  throw LogicError("template_score: a lowest sum that is nowhere");
}

TemplateHit best_of_job(const Planes& planes, const TensorShape& shape,
                        std::span<const TemplatePoint> points, const TemplateJob& job) {
  std::size_t sources[TEMPLATE_SCORE_MAX_POINTS + 3];
  const int right = reach_x(job, planes.step), down = reach_y(job, planes.step);
  for (std::uint32_t p = 0; p < job.point_count; ++p) {
    const TemplatePoint& point = points[job.first_point + p];
    const int x = job.x0 + point.dx_px, y = job.y0 + point.dy_px;
    const bool is_near = x > -right && x < shape.width && y > -down && y < shape.height;
    sources[p] = is_near ? planes.at(x, y, point.bin) : planes.nothing();
  }
  for (std::uint32_t p = job.point_count; p % 4 != 0; ++p) sources[p] = planes.zeros();
  TemplateHit hit{~0u, job.x0, job.y0};
  BlockSums sums;
  for (std::uint32_t x = 0; x < job.columns; x += block_columns) {
    const LaneMask mask(job.columns - x);
    for (std::uint32_t y = 0; y < job.rows; y += block_rows) {
      const std::uint32_t sum =
          sum_block(planes.values.data(), sources, job.point_count, y * planes.next_row() + x,
                    planes.next_row(), job.rows - y, mask, sums);
      if (sum > hit.sum) continue;
      const auto [row, column] = first_in_block(sums, sum);
      const TemplateHit here{sum, job.x0 + planes.step * (int(x) + column),
                             job.y0 + planes.step * (int(y) + row)};
      // Blocks are visited column by column, so equal sums are decided by position, not by order.
      if (here.sum < hit.sum || here.y < hit.y || (here.y == hit.y && here.x < hit.x)) hit = here;
    }
  }
  return hit;
}

bool is_plain(const TemplateJob& job) { return job.columns == 1 && job.rows == 1; }

// Of jobs of one anchor each, where planes and blocks would be read for one value of many. Returns
// the largest bin.
int score_plainly(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                  std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs,
                  std::span<TemplateHit> hits) {
  int largest = 0;
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    std::uint32_t sum = 0;
    for (const TemplatePoint& point : points.subspan(jobs[j].first_point, jobs[j].point_count)) {
      const int x = jobs[j].x0 + point.dx_px, y = jobs[j].y0 + point.dy_px;
      largest = std::max<int>(largest, point.bin);
      const bool inside =
          x >= 0 && x < shape.width && y >= 0 && y < shape.height && int(point.bin) < shape.bins;
      sum += inside ? capped(tensor[shape.index(x, y, point.bin)]) : outside;
    }
    hits[j] = {sum, jobs[j].x0, jobs[j].y0};
  }
  return largest;
}

// All but what points hold.
void check_jobs(std::size_t points, std::span<const TemplateJob> jobs, int anchor_step,
                std::size_t hits) {
  check(anchor_step >= 1 && anchor_step <= 16, "template_score: anchor step in [1, 16]");
  check(hits == jobs.size(), "template_score: as many hits as jobs");
  for (const TemplateJob& job : jobs) {
    check(job.point_count >= 1 && job.point_count <= TEMPLATE_SCORE_MAX_POINTS,
          "template_score: points of a template");
    check(std::size_t(job.first_point) + job.point_count <= points,
          "template_score: points beyond the list");
    const std::uint64_t anchors = std::uint64_t(job.columns) * job.rows;
    check(anchors >= 1 && anchors <= TEMPLATE_SCORE_MAX_ANCHORS,
          "template_score: anchors of a job");
  }
}

constexpr const char* BIN_OUT_OF_RANGE = "template_score: bin out of range";

}  // namespace

void check_template_jobs(const TensorShape& shape, std::span<const TemplatePoint> points,
                         std::span<const TemplateJob> jobs, int anchor_step, std::size_t hits) {
  check_jobs(points.size(), jobs, anchor_step, hits);
  for (const TemplatePoint& point : points) check(point.bin < shape.bins, BIN_OUT_OF_RANGE);
}

void template_score_reference(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                              std::span<const TemplatePoint> points,
                              std::span<const TemplateJob> jobs, int anchor_step,
                              std::span<TemplateHit> hits) {
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
          sum += inside ? capped(tensor[shape.index(px, py, point.bin)]) : outside;
        }
        if (sum < hits[j].sum) hits[j] = {sum, x, y};
      }
  }
}

void template_score_fast(std::span<const std::uint16_t> tensor, const TensorShape& shape,
                         std::span<const TemplatePoint> points, std::span<const TemplateJob> jobs,
                         int anchor_step, std::span<TemplateHit> hits, ThreadPool& pool) {
  check_jobs(points.size(), jobs, anchor_step, hits.size());
  if (jobs.empty()) return;
  const std::size_t chunks = (jobs.size() + chunk_jobs - 1) / chunk_jobs;
  if (std::ranges::all_of(jobs, is_plain)) {
    std::vector<int> bins(chunks);
    pool.for_each(chunks, [&](std::size_t c) {
      const std::size_t first = c * chunk_jobs, count = std::min(chunk_jobs, jobs.size() - first);
      bins[c] = score_plainly(tensor, shape, points, jobs.subspan(first, count),
                              hits.subspan(first, count));
    });
    check(std::ranges::max(bins) < shape.bins, BIN_OUT_OF_RANGE);
    return;
  }
  const Bounds bounds = touched(shape, points, jobs, anchor_step, pool);
  check(bounds.bin_max < shape.bins, BIN_OUT_OF_RANGE);
  const Planes planes = make_planes(tensor, shape, bounds, anchor_step, pool);
  pool.for_each(chunks, [&](std::size_t c) {
    for (std::size_t j = c * chunk_jobs; j < std::min(jobs.size(), (c + 1) * chunk_jobs); ++j)
      hits[j] = best_of_job(planes, shape, points, jobs[j]);
  });
}

}  // namespace edgescout
