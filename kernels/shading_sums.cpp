#include "kernels/shading_sums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "kernels/error.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr int SIZE = int(SHADING_MAP_PX);
constexpr int HARMONICS = int(SHADING_HARMONICS);
constexpr std::int32_t FARTHEST_PX = 1000000;
constexpr std::uint32_t LONGEST_STRIDE_PX = 1000;

struct Normal {
  double x, y, z;
};

std::array<double, HARMONICS> harmonics(const Normal& n) {
  return {
      1, n.x, n.y, n.z, n.x * n.y, n.y * n.z, n.z * n.x, n.x * n.x - n.y * n.y, 3 * n.z * n.z - 1};
}

bool is_in_image(const ImageView& image, int x, int y) {
  return x >= 0 && y >= 0 && x < image.width && y < image.height;
}

// False where the nine pixels around are not one smooth surface.
bool normal_at(const float* depth, int i, int j, const Intrinsics& k, Normal& normal) {
  double w[3][3];
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      const float z = depth[(j + y) * SIZE + i + x];
      if (z == DEPTH_EMPTY) return false;
      w[y + 1][x + 1] = 1 / double(z);
    }
  const double middle = w[1][1];
  const double bend =
      std::max(std::abs(w[1][0] + w[1][2] - 2 * middle), std::abs(w[0][1] + w[2][1] - 2 * middle));
  if (bend > SHADING_MAX_BEND * middle) return false;
  const double a = 0.5 * (w[1][2] - w[1][0]) * k.fx, b = 0.5 * (w[2][1] - w[0][1]) * k.fy;
  const double c = middle - a * (i - k.cx) / k.fx - b * (j - k.cy) / k.fy;
  const double length = std::sqrt(a * a + b * b + c * c);
  normal = {a / length, b / length, c / length};
  return true;
}

// Whether a known surface may hide what pixel (i, j) of a map with camera `k` shows at depth `z`.
bool may_be_hidden(const DepthView& known, int i, int j, double z, const Intrinsics& k,
                   float tolerance_m) {
  if (known.width == 0 || !(z > 0)) return false;
  const Intrinsics& to = known.intrinsics;
  const double u = std::round(to.fx * ((i - k.cx) / k.fx) + to.cx),
               v = std::round(to.fy * ((j - k.cy) / k.fy) + to.cy);
  if (!(u >= 1 && v >= 1 && u < known.width - 1 && v < known.height - 1)) return false;
  const float limit = float(z - double(tolerance_m));
  for (int y = int(v) - 1; y <= int(v) + 1; ++y)
    for (int x = int(u) - 1; x <= int(u) + 1; ++x)
      if (known.z_m[std::size_t(y) * std::size_t(known.width) + std::size_t(x)] < limit)
        return true;
  return false;
}

void add_grey(ShadingSums& sums, double grey) {
  sums.pixels += 1;
  sums.grey += grey;
  sums.squares += grey * grey;
}

std::uint8_t grey_at(const ImageView& image, int x, int y) {
  return image.pixels[std::size_t(y) * std::size_t(image.width) + std::size_t(x)];
}

ShadingSums sum_reference(const ShadingView& view, const ShadingJob& job, const float* depth,
                          float tolerance_m) {
  const Intrinsics k = shading_map_camera(job, view.intrinsics);
  const int stride = int(job.stride_px);
  ShadingSums sums;
  for (int j = 1; j + 1 < SIZE; ++j)
    for (int i = 1; i + 1 < SIZE; ++i) {
      const int x = job.x_px + stride * i, y = job.y_px + stride * j;
      Normal normal;
      if (!is_in_image(view.image, x, y) || !normal_at(depth, i, j, k, normal) ||
          may_be_hidden(view.known, i, j, depth[j * SIZE + i], k, tolerance_m))
        continue;
      const double grey = grey_at(view.image, x, y);
      const std::array<double, HARMONICS> h = harmonics(normal);
      int entry = 0;
      for (int a = 0; a < HARMONICS; ++a) {
        for (int b = a; b < HARMONICS; ++b) sums.system[entry++] += h[a] * h[b];
        sums.right[a] += grey * h[a];
      }
      add_grey(sums, grey);
    }
  return sums;
}

constexpr int LANES = 8;

// Pixels that wait to be added, and the sums of those added, lane by lane.
struct LaneSums {
  double x[SIZE + LANES], y[SIZE + LANES], z[SIZE + LANES], one[SIZE + LANES], grey[SIZE + LANES];
  int waiting = 0;
  double system[SHADING_SYSTEM][LANES] = {};
  double right[HARMONICS][LANES] = {};
};

// Adds the first `count` of those that wait, a multiple of LANES.
EDGESCOUT_SIMD_CLONES
void add_waiting(LaneSums& s, int count) {
  for (int first = 0; first < count; first += LANES) {
    double h[HARMONICS][LANES];
    for (int l = 0; l < LANES; ++l) {
      const double x = s.x[first + l], y = s.y[first + l], z = s.z[first + l],
                   one = s.one[first + l];
      h[0][l] = one, h[1][l] = x, h[2][l] = y, h[3][l] = z;
      h[4][l] = x * y, h[5][l] = y * z, h[6][l] = z * x;
      h[7][l] = x * x - y * y, h[8][l] = 3 * z * z - one;
    }
    int entry = 0;
    for (int a = 0; a < HARMONICS; ++a) {
      for (int b = a; b < HARMONICS; ++b, ++entry)
        for (int l = 0; l < LANES; ++l) s.system[entry][l] += h[a][l] * h[b][l];
      for (int l = 0; l < LANES; ++l) s.right[a][l] += s.grey[first + l] * h[a][l];
    }
  }
}

// The normals of one row of a map, and where they count.
struct RowNormals {
  double x[SIZE], y[SIZE], z[SIZE];
  std::uint8_t counts[SIZE];
};

// `above`, `here`, `below`: inverse depths, 0 where nothing is.
EDGESCOUT_SIMD_CLONES
void find_normals(const double* above, const double* here, const double* below, int j,
                  const Intrinsics& k, RowNormals& row) {
  const double fx = k.fx, fy = k.fy, cx = k.cx, along_y = (j - double(k.cy)) / fy;
  double nearest[SIZE];  // the smallest inverse depth of three rows
  for (int i = 0; i < SIZE; ++i) nearest[i] = std::min(above[i], std::min(here[i], below[i]));
  for (int i = 1; i + 1 < SIZE; ++i) {
    const double middle = here[i],
                 least = std::min(nearest[i - 1], std::min(nearest[i], nearest[i + 1]));
    const double bend = std::max(std::abs(here[i - 1] + here[i + 1] - 2 * middle),
                                 std::abs(above[i] + below[i] - 2 * middle));
    const double a = 0.5 * (here[i + 1] - here[i - 1]) * fx, b = 0.5 * (below[i] - above[i]) * fy;
    const double c = middle - a * (i - cx) / fx - b * along_y;
    const double length = std::sqrt(a * a + b * b + c * c);
    row.counts[i] = least > 0 && bend <= SHADING_MAX_BEND * middle;
    row.x[i] = a / length, row.y[i] = b / length, row.z[i] = c / length;
  }
}

// Whether the row shows anything.
EDGESCOUT_SIMD_CLONES
bool invert_row(const float* depth, double* inverse) {
  double largest = 0;
  for (int i = 0; i < SIZE; ++i) inverse[i] = 1 / double(depth[i]);  // of DEPTH_EMPTY: 0
  for (int i = 0; i < SIZE; ++i) largest = std::max(largest, inverse[i]);
  return largest > 0;
}

class FastSums {
 public:
  FastSums(const ShadingView& view, const ShadingJob& job, const float* depth, float tolerance_m)
      : view_(view),
        job_(job),
        depth_(depth),
        tolerance_m_(tolerance_m),
        camera_(shading_map_camera(job, view.intrinsics)) {}

  ShadingSums sum() {
    double inverse[3][SIZE];
    bool shows[3];
    for (int j = 0; j < SIZE; ++j) {
      shows[j % 3] = invert_row(depth_ + j * SIZE, inverse[j % 3]);
      if (j < 2 || !shows[0] || !shows[1] || !shows[2]) continue;
      RowNormals row;
      find_normals(inverse[(j - 2) % 3], inverse[(j - 1) % 3], inverse[j % 3], j - 1, camera_, row);
      add_row(row, j - 1);
    }
    for (; lanes_.waiting % LANES != 0; ++lanes_.waiting) put({}, 0, 0);
    flush();
    return total();
  }

 private:
  void put(const Normal& n, double one, double grey) {
    const int at = lanes_.waiting;
    lanes_.x[at] = n.x, lanes_.y[at] = n.y, lanes_.z[at] = n.z;
    lanes_.one[at] = one, lanes_.grey[at] = grey;
  }

  // Leaves fewer than LANES waiting.
  void flush() {
    const int whole = lanes_.waiting / LANES * LANES;
    if (whole == 0) return;
    add_waiting(lanes_, whole);
    for (double* list : {lanes_.x, lanes_.y, lanes_.z, lanes_.one, lanes_.grey})
      std::copy(list + whole, list + lanes_.waiting, list);
    lanes_.waiting -= whole;
  }

  void add_row(const RowNormals& row, int j) {
    const int stride = int(job_.stride_px), y = job_.y_px + stride * j;
    if (y < 0 || y >= view_.image.height) return;
    for (int i = 1; i + 1 < SIZE; ++i) {
      const int x = job_.x_px + stride * i;
      if (!row.counts[i] || x < 0 || x >= view_.image.width) continue;
      if (may_be_hidden(view_.known, i, j, depth_[j * SIZE + i], camera_, tolerance_m_)) continue;
      const double grey = grey_at(view_.image, x, y);
      add_grey(sums_, grey);
      put({row.x[i], row.y[i], row.z[i]}, 1, grey);
      ++lanes_.waiting;
    }
    flush();
  }

  ShadingSums total() const {
    ShadingSums sums = sums_;
    for (std::size_t e = 0; e < SHADING_SYSTEM; ++e)
      for (const double value : lanes_.system[e]) sums.system[e] += value;
    for (int a = 0; a < HARMONICS; ++a)
      for (const double value : lanes_.right[a]) sums.right[a] += value;
    return sums;
  }

  const ShadingView& view_;
  const ShadingJob& job_;
  const float* depth_;
  float tolerance_m_;
  Intrinsics camera_;
  LaneSums lanes_;
  ShadingSums sums_;  // pixels, grey and squares
};

DepthJob depth_job(const ShadingJob& job, const ShadingView& view) {
  return {job.camera_from_object, shading_map_camera(job, view.intrinsics)};
}

}  // namespace

Intrinsics shading_map_camera(const ShadingJob& job, const Intrinsics& view) {
  const float s = 1.0f / float(job.stride_px);
  return {view.fx * s, view.fy * s, (view.cx - float(job.x_px)) * s,
          (view.cy - float(job.y_px)) * s};
}

void check_shading_sums(std::size_t views, const TriangleMesh& mesh,
                        std::span<const ShadingJob> jobs, float tolerance_m, std::size_t results) {
  check(results == jobs.size(), "shading_sums: as many results as jobs");
  check(tolerance_m >= 0, "shading_sums: tolerance");
  check_depth_raster(mesh, jobs.size(), SIZE, SIZE, jobs.size() * std::size_t(SIZE) * SIZE);
  for (const ShadingJob& job : jobs) {
    check(job.view < views, "shading_sums: no such view");
    check(job.stride_px >= 1 && job.stride_px <= LONGEST_STRIDE_PX, "shading_sums: stride");
    check(std::abs(double(job.x_px)) <= FARTHEST_PX && std::abs(double(job.y_px)) <= FARTHEST_PX,
          "shading_sums: a map that is nowhere");
  }
}

void shading_sums_reference(std::span<const ShadingView> views, const TriangleMesh& mesh,
                            std::span<const ShadingJob> jobs, float tolerance_m,
                            std::span<ShadingSums> out) {
  check_shading_sums(views.size(), mesh, jobs, tolerance_m, out.size());
  std::vector<float> depth(std::size_t(SIZE) * SIZE);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const ShadingView& view = views[jobs[i].view];
    out[i] = {};
    if (view.image.width == 0) continue;
    const DepthJob drawn = depth_job(jobs[i], view);
    depth_raster_reference(mesh, {&drawn, 1}, SIZE, SIZE, depth);
    out[i] = sum_reference(view, jobs[i], depth.data(), tolerance_m);
  }
}

void shading_sums_fast(std::span<const ShadingView> views, const TriangleMesh& mesh,
                       std::span<const ShadingJob> jobs, float tolerance_m,
                       std::span<ShadingSums> out, ThreadPool& pool) {
  check_shading_sums(views.size(), mesh, jobs, tolerance_m, out.size());
  for_each_in_chunks(pool, jobs.size(), 4, [&](std::size_t i) {
    const ShadingView& view = views[jobs[i].view];
    out[i] = {};
    if (view.image.width == 0) return;
    thread_local std::array<float, std::size_t(SIZE) * SIZE> depth;
    draw_depth_map(mesh, depth_job(jobs[i], view), SIZE, SIZE, depth);
    out[i] = FastSums(view, jobs[i], depth.data(), tolerance_m).sum();
  });
}

}  // namespace edgescout
