#include "host/detect/template_projection.h"

#include <algorithm>

#include "kernels/error.h"
#include "kernels/simd.h"
#include "kernels/undirected_angle.h"

namespace edgescout {

namespace {

constexpr int MOST = TEMPLATE_SCORE_MAX_POINTS;

// Rounds half away from zero. Clamps places far outside: they stay outside, and adding the place of
// a job does not overflow.
inline int rounded(float pixel) {
  const float near = std::min(std::max(pixel, -16000.0f), 16000.0f);
  return static_cast<int>(near + (near < 0 ? -0.5f : 0.5f));
}

// Returns the number of points nearer than `nearest_m`. Eq. 1's projection with d = z^2 *
// d(projection)(tangent), as in kernels/pose_geometry.h.
EDGESCOUT_SIMD_CLONES
int project_points(const Pose& pose, const Intrinsics& k, const float* const* coordinates,
                   int count, float x_px, float y_px, int bins, float nearest_m,
                   TemplatePoint* out) {
  const float* m = pose.m;
  const float *x = coordinates[0], *y = coordinates[1], *z = coordinates[2], *tx = coordinates[3],
              *ty = coordinates[4], *tz = coordinates[5];
  const float bins_per_rad = float(bins) / 3.14159265f;
  int dx[MOST], dy[MOST], bin[MOST];
  int too_near = 0;
  for (int i = 0; i < count; ++i) {
    const float px = m[0] * x[i] + m[1] * y[i] + m[2] * z[i] + m[3],
                py = m[4] * x[i] + m[5] * y[i] + m[6] * z[i] + m[7];
    const float pz = m[8] * x[i] + m[9] * y[i] + m[10] * z[i] + m[11];
    const float qx = m[0] * tx[i] + m[1] * ty[i] + m[2] * tz[i],
                qy = m[4] * tx[i] + m[5] * ty[i] + m[6] * tz[i];
    const float qz = m[8] * tx[i] + m[9] * ty[i] + m[10] * tz[i];
    too_near += pz < nearest_m ? 1 : 0;
    const float inverse = 1.0f / pz;
    dx[i] = rounded(k.fx * px * inverse + k.cx - x_px);
    dy[i] = rounded(k.fy * py * inverse + k.cy - y_px);
    const int turn = static_cast<int>(
        undirected_angle(k.fx * (pz * qx - px * qz), k.fy * (pz * qy - py * qz)) * bins_per_rad +
        0.5f);
    bin[i] = turn >= bins ? 0 : turn;
  }
  for (int i = 0; i < count; ++i)
    out[i] = {static_cast<std::int16_t>(dx[i]), static_cast<std::int16_t>(dy[i]),
              static_cast<std::uint16_t>(bin[i])};
  return too_near;
}

}  // namespace

ThinnedView::ThinnedView(const TemplateView& view, int most)
    : count_(std::min<int>(most, int(view.points.size()))) {
  check(most >= 1 && most <= MOST, "ThinnedView: number of points");
  for (int i = 0; i < count_; ++i) {
    const ModelPoint& p = view.points[std::size_t(i) * view.points.size() / count_];
    const float values[] = {p.x_m, p.y_m, p.z_m, p.tx, p.ty, p.tz};
    for (int c = 0; c < 6; ++c) coordinates_[c].push_back(values[c]);
  }
}

bool ThinnedView::project(const Pose& camera_from_object, const Intrinsics& intrinsics, float x_px,
                          float y_px, int bins, float nearest_m, TemplatePoint* out) const {
  const float* coordinates[6];
  for (int c = 0; c < 6; ++c) coordinates[c] = coordinates_[c].data();
  return project_points(camera_from_object, intrinsics, coordinates, count_, x_px, y_px, bins,
                        nearest_m, out) == 0;
}

}  // namespace edgescout
