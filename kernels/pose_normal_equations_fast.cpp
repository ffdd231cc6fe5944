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
  Lanes value, slope[3];  // of the tensor, slope by u, v, bins
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
  std::size_t tile, row;
  int bins, last_x, last_y;
  explicit Layout(const TensorView& view)
      : tensor(view.tensor.data()),
        tile(std::size_t(view.shape.bins) * DCD_TILE),
        row(std::size_t(view.shape.tiles_per_row()) * tile),
        bins(view.shape.bins),
        last_x(view.shape.width - 1),
        last_y(view.shape.height - 1) {}
  const std::uint16_t* at(int x, int y) const {
    return tensor + std::size_t(y) * row + std::size_t(x / int(DCD_TILE)) * tile +
           x % int(DCD_TILE);
  }
  std::size_t down(int y) const { return y < last_y ? row : 0; }
  std::size_t bin(int k) const { return std::size_t(k) * DCD_TILE; }
  std::size_t bin_after(int k) const { return bin(k + 1 == bins ? 0 : k + 1); }
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
    const std::uint16_t* place = layout.at(g.x0[i], g.y0[i]);
    for (const std::uint16_t* line : {place, place + layout.down(g.y0[i])}) {
      __builtin_prefetch(line + layout.bin(g.bin[i]));
      __builtin_prefetch(line + layout.bin_after(g.bin[i]));
    }
  }
}

inline __attribute__((always_inline)) void read_tensor(const Layout& layout, Group& g) {
  constexpr float unit = 1.0f / DCD_UNITS_PER_PX;
  for (int i = 0; i < lanes; ++i) {
    const float x = std::clamp(g.u[i], 0.0f, float(layout.last_x)),
                y = std::clamp(g.v[i], 0.0f, float(layout.last_y));
    const int x0 = g.x0[i], y0 = g.y0[i], k0 = g.bin[i];
    const float ax = x - float(x0), ay = y - float(y0), ak = g.turn[i] - float(k0);
    const std::uint16_t *left = layout.at(x0, y0),
                        *right = layout.at(std::min(x0 + 1, layout.last_x), y0);
    const std::size_t down = layout.down(y0), a = layout.bin(k0), b = layout.bin_after(k0);
    const float s00 = float(left[b]) - float(left[a]), s10 = float(right[b]) - float(right[a]);
    const float s01 = float(left[down + b]) - float(left[down + a]),
                s11 = float(right[down + b]) - float(right[down + a]);
    const float v00 = float(left[a]) + ak * s00, v10 = float(right[a]) + ak * s10;
    const float v01 = float(left[down + a]) + ak * s01, v11 = float(right[down + a]) + ak * s11;
    const float top = v00 + ax * (v10 - v00), bottom = v01 + ax * (v11 - v01);
    const float out_x = g.u[i] - x, out_y = g.v[i] - y,
                out = std::sqrt(out_x * out_x + out_y * out_y);
    g.value[i] = (top + ay * (bottom - top)) * unit + out;
    g.slope[0][i] =
        out_x != 0 ? out_x / out : ((v10 - v00) + ay * ((v11 - v01) - (v10 - v00))) * unit;
    g.slope[1][i] = out_y != 0 ? out_y / out : (bottom - top) * unit;
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
