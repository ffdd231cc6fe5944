// The same systems on the CPU, fast: points in groups of 16 lanes, arithmetic in loops the compiler
// turns into vectors, only the tensor's reads one by one; problems spread over the threads.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "kernels/error.h"
#include "kernels/pose_normal_equations.h"
#include "kernels/simd.h"
#include "kernels/thread_pool.h"
#include "kernels/undirected_angle.h"

namespace edgescout {

namespace {

constexpr int lanes = 16;
constexpr int sum_count = 21 + 6 + 5;
struct Lanes {
  float v[lanes];
  float& operator[](int i) { return v[i]; }
  const float& operator[](int i) const { return v[i]; }
};

struct Group {
  Lanes active, arm[3], point[3], tangent[3];
  Lanes u, v, dx, dy, turn;  // turn: orientation in bins
  int x0[lanes], y0[lanes], bin[lanes];
  const std::uint16_t* place[lanes];                           // of x0, y0, bin
  std::ptrdiff_t right[lanes], down[lanes], bin_after[lanes];  // from there to the neighbours
  Lanes value, slope[3];                                       // of the tensor, slope by u, v, bins
};

inline __attribute__((always_inline)) void load_points(const ModelPoint* models, int count,
                                                       const Pose& pose, const Intrinsics& k,
                                                       float bins_per_rad, Group& g) {
  Lanes m[6];
  for (int i = 0; i < lanes; ++i) {
    const ModelPoint& p = models[std::min(i, count - 1)];
    m[0][i] = p.x_m, m[1][i] = p.y_m, m[2][i] = p.z_m, m[3][i] = p.tx, m[4][i] = p.ty,
    m[5][i] = p.tz;
  }
  for (int r = 0; r < 3; ++r) {
    const float* row = pose.m + 4 * r;
    for (int i = 0; i < lanes; ++i) {
      g.arm[r][i] = row[0] * m[0][i] + row[1] * m[1][i] + row[2] * m[2][i];
      g.tangent[r][i] = row[0] * m[3][i] + row[1] * m[4][i] + row[2] * m[5][i];
      g.point[r][i] = g.arm[r][i] + row[3];
    }
  }
  for (int i = 0; i < lanes; ++i) {
    constexpr float range = float(POSE_MAX_RANGE_M);
    const bool seen = g.point[2][i] > POSE_MIN_DEPTH_M && g.point[2][i] < range &&
                      std::abs(g.point[0][i]) < range && std::abs(g.point[1][i]) < range;
    g.active[i] = seen && i < count ? 1.0f : 0.0f;
    for (int r = 0; r < 3; ++r) {  // elsewhere something finite, which counts nowhere
      g.point[r][i] = seen ? g.point[r][i] : 1.0f;
      g.arm[r][i] = seen ? g.arm[r][i] : 1.0f;
      g.tangent[r][i] = seen ? g.tangent[r][i] : 1.0f;
    }
    const float inverse = 1.0f / g.point[2][i];
    g.u[i] = k.fx * g.point[0][i] * inverse + k.cx;
    g.v[i] = k.fy * g.point[1][i] * inverse + k.cy;
    g.dx[i] = k.fx * (g.point[2][i] * g.tangent[0][i] - g.point[0][i] * g.tangent[2][i]);
    g.dy[i] = k.fy * (g.point[2][i] * g.tangent[1][i] - g.point[1][i] * g.tangent[2][i]);
    g.turn[i] = undirected_angle(g.dx[i], g.dy[i]) * bins_per_rad;
  }
}

// Where the tensor is: rows of tiles, of every tile all bins (kernels/tensor_layout.h).
struct Layout {
  const std::uint16_t* tensor;
  std::ptrdiff_t tile, row;
  int bins, last_x, last_y;
  explicit Layout(const TensorView& view)
      : tensor(view.tensor.data()),
        tile(std::ptrdiff_t(view.shape.bins) * DCD_TILE),
        row(std::ptrdiff_t(view.shape.tiles_per_row()) * tile),
        bins(view.shape.bins),
        last_x(view.shape.width - 1),
        last_y(view.shape.height - 1) {}
  const std::uint16_t* at(int x, int y, int bin) const {
    return tensor + std::ptrdiff_t(y) * row + std::ptrdiff_t(x / int(DCD_TILE)) * tile +
           std::ptrdiff_t(bin) * DCD_TILE + x % int(DCD_TILE);
  }
  std::ptrdiff_t right(int x) const {
    if (x == last_x) return 0;
    return x % int(DCD_TILE) == int(DCD_TILE) - 1 ? tile - (int(DCD_TILE) - 1) : 1;
  }
  std::ptrdiff_t down(int y) const { return y < last_y ? row : 0; }
  std::ptrdiff_t bin_after(int k) const {
    return std::ptrdiff_t(k + 1 == bins ? 1 - bins : 1) * DCD_TILE;
  }
};

// The tensor is many times a cache: of a whole group the reads are under way before the first is
// waited for.
inline __attribute__((always_inline)) void fetch(const Layout& layout, Group& g) {
  for (int i = 0; i < lanes; ++i) {
    g.x0[i] = std::min(int(std::clamp(g.u[i], 0.0f, float(layout.last_x))),
                       std::max(0, layout.last_x - 1));
    g.y0[i] = std::min(int(std::clamp(g.v[i], 0.0f, float(layout.last_y))),
                       std::max(0, layout.last_y - 1));
    g.bin[i] = std::min(int(g.turn[i]), layout.bins - 1);
  }
  for (int i = 0; i < lanes; ++i) {
    g.place[i] = layout.at(g.x0[i], g.y0[i], g.bin[i]);
    g.right[i] = layout.right(g.x0[i]);
    g.down[i] = layout.down(g.y0[i]);
    g.bin_after[i] = layout.bin_after(g.bin[i]);
    for (const std::uint16_t* line : {g.place[i], g.place[i] + g.down[i]}) {
      __builtin_prefetch(line);
      __builtin_prefetch(line + g.bin_after[i]);
    }
  }
}

// The eight values around a point, by x, y and bin. Apart from the arithmetic, which becomes
// vectors.
struct Corners {
  int v[2][2][2][lanes];
};

inline __attribute__((always_inline)) void read_corners(const Group& g, Corners& c) {
  for (int i = 0; i < lanes; ++i) {
    const std::uint16_t* left = g.place[i];
    const std::ptrdiff_t down = g.down[i], after = g.bin_after[i];
    const std::uint16_t* right = left + g.right[i];
    c.v[0][0][0][i] = left[0], c.v[0][0][1][i] = left[after];
    c.v[1][0][0][i] = right[0], c.v[1][0][1][i] = right[after];
    c.v[0][1][0][i] = left[down], c.v[0][1][1][i] = left[down + after];
    c.v[1][1][0][i] = right[down], c.v[1][1][1][i] = right[down + after];
  }
}

inline __attribute__((always_inline)) void read_tensor(const Layout& layout, Group& g) {
  constexpr float unit = 1.0f / DCD_UNITS_PER_PX;
  Corners c;
  read_corners(g, c);
  const float last_x = float(layout.last_x), last_y = float(layout.last_y);
  for (int i = 0; i < lanes; ++i) {
    const float x = std::min(std::max(g.u[i], 0.0f), last_x),
                y = std::min(std::max(g.v[i], 0.0f), last_y);
    const float ax = x - float(g.x0[i]), ay = y - float(g.y0[i]), ak = g.turn[i] - float(g.bin[i]);
    const float a00 = float(c.v[0][0][0][i]), a10 = float(c.v[1][0][0][i]),
                a01 = float(c.v[0][1][0][i]), a11 = float(c.v[1][1][0][i]);
    const float s00 = float(c.v[0][0][1][i]) - a00, s10 = float(c.v[1][0][1][i]) - a10,
                s01 = float(c.v[0][1][1][i]) - a01, s11 = float(c.v[1][1][1][i]) - a11;
    const float v00 = a00 + ak * s00, v10 = a10 + ak * s10;
    const float v01 = a01 + ak * s01, v11 = a11 + ak * s11;
    const float top = v00 + ax * (v10 - v00), bottom = v01 + ax * (v11 - v01);
    const float out_x = g.u[i] - x, out_y = g.v[i] - y,
                out = std::sqrt(out_x * out_x + out_y * out_y);
    const float inner_x = ((v10 - v00) + ay * ((v11 - v01) - (v10 - v00))) * unit,
                inner_y = (bottom - top) * unit;
    const float outer_x = out_x / out, outer_y = out_y / out;  // no numbers inside the image
    g.value[i] = (top + ay * (bottom - top)) * unit + out;
    g.slope[0][i] = out_x != 0 ? outer_x : inner_x;
    g.slope[1][i] = out_y != 0 ? outer_y : inner_y;
    const float slope_top = s00 + ax * (s10 - s00), slope_bottom = s01 + ax * (s11 - s01);
    g.slope[2][i] = (slope_top + ay * (slope_bottom - slope_top)) * unit;
  }
}

inline __attribute__((always_inline)) void accumulate(const Group& g, const Intrinsics& k,
                                                      float bins_per_rad, const PoseLoss& loss,
                                                      Lanes* sums) {
  Lanes j[6], weight;
  const float s = loss.scale_px;
  const bool huber = loss.kind == LOSS_HUBER;
  for (int i = 0; i < lanes; ++i) {
    const float inverse = 1.0f / g.point[2][i], norm2 = g.dx[i] * g.dx[i] + g.dy[i] * g.dy[i];
    const float least = POSE_MIN_FORESHORTENING * k.fx * g.point[2][i];
    const float by_angle = norm2 > least * least ? g.slope[2][i] * bins_per_rad / norm2 : 0.0f;
    const float along_x = -by_angle * g.dy[i] * k.fx, along_y = by_angle * g.dx[i] * k.fy;
    const float su = g.slope[0][i] * k.fx * inverse, sv = g.slope[1][i] * k.fy * inverse;
    const float bp0 = su - along_x * g.tangent[2][i], bp1 = sv - along_y * g.tangent[2][i];
    const float bp2 = -(su * g.point[0][i] + sv * g.point[1][i]) * inverse +
                      along_x * g.tangent[0][i] + along_y * g.tangent[1][i];
    const float bt0 = along_x * g.point[2][i], bt1 = along_y * g.point[2][i];
    const float bt2 = -along_x * g.point[0][i] - along_y * g.point[1][i];
    j[0][i] = bp0, j[1][i] = bp1, j[2][i] = bp2;
    j[3][i] = g.arm[1][i] * bp2 - g.arm[2][i] * bp1 + g.tangent[1][i] * bt2 - g.tangent[2][i] * bt1;
    j[4][i] = g.arm[2][i] * bp0 - g.arm[0][i] * bp2 + g.tangent[2][i] * bt0 - g.tangent[0][i] * bt2;
    j[5][i] = g.arm[0][i] * bp1 - g.arm[1][i] * bp0 + g.tangent[0][i] * bt1 - g.tangent[1][i] * bt0;
    const float r = g.value[i], q = s * s / (s * s + r * r);
    const float huber_weight = r <= s ? 1.0f : s / r,
                huber_cost = r <= s ? 0.5f * r * r : s * (r - 0.5f * s);
    weight[i] = g.active[i] * (huber ? huber_weight : q * q);
    sums[27][i] += g.active[i] * (huber ? huber_cost : 0.5f * q * r * r);
    sums[28][i] += g.active[i] * r;
    sums[29][i] += weight[i];
    sums[30][i] += g.active[i];
  }
  int entry = 0;
  for (int a = 0; a < 6; ++a) {
    Lanes weighted;
    for (int i = 0; i < lanes; ++i) weighted[i] = weight[i] * j[a][i];
    for (int b = a; b < 6; ++b, ++entry)
      for (int i = 0; i < lanes; ++i) sums[entry][i] += weighted[i] * j[b][i];
    for (int i = 0; i < lanes; ++i) sums[21 + a][i] += weighted[i] * g.value[i];
  }
}

EDGESCOUT_SIMD_CLONES
void sum_problem(const TensorView& view, const ModelPoint* models, std::uint32_t count,
                 const Pose& pose, const PoseLoss& loss, float* totals) {
  const float bins_per_rad = float(view.shape.bins) / 3.14159265f;
  const Layout layout(view);
  Lanes sums[sum_count] = {};
  Group groups[2];
  for (std::uint32_t first = 0, i = 0; first < count + lanes; first += lanes, i ^= 1) {
    if (first < count) {
      load_points(models + first, static_cast<int>(std::min<std::uint32_t>(lanes, count - first)),
                  pose, view.intrinsics, bins_per_rad, groups[i]);
      fetch(layout, groups[i]);
    }
    if (first == 0) continue;
    read_tensor(layout, groups[i ^ 1]);
    accumulate(groups[i ^ 1], view.intrinsics, bins_per_rad, loss, sums);
  }
  for (int e = 0; e < sum_count; ++e) {
    totals[e] = 0;
    for (int i = 0; i < lanes; ++i) totals[e] += sums[e][i];
  }
}

}  // namespace

void pose_normal_equations_fast(std::span<const TensorView> views,
                                std::span<const ModelPoint> points,
                                std::span<const PoseProblem> problems, const PoseLoss& loss,
                                std::span<NormalEquations> out, ThreadPool& pool) {
  check(out.size() == problems.size(), "pose_normal_equations: as many systems as problems");
  pool.for_each(problems.size(), [&](std::size_t i) {
    const PoseProblem& problem = problems[i];
    check(std::size_t(problem.first_point) + problem.point_count <= points.size(),
          "pose_normal_equations: points beyond the list");
    check(problem.view < views.size(), "pose_normal_equations: no such view");
    float totals[sum_count] = {};
    sum_problem(views[problem.view], points.data() + problem.first_point, problem.point_count,
                problem.camera_from_object, loss, totals);
    NormalEquations& system = out[i];
    std::copy(totals, totals + 21, system.hessian);
    std::copy(totals + 21, totals + 27, system.gradient);
    system.cost = totals[27];
    system.residual_sum = totals[28];
    system.weight_sum = totals[29];
    system.points = totals[30];
    system.behind = float(problem.point_count) - totals[30];
  });
}

}  // namespace edgescout
