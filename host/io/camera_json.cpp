#include "host/io/camera_json.h"

#include <algorithm>
#include <cmath>

#include "kernels/error.h"

namespace edgescout {

void set_intrinsics(Camera& camera, const std::vector<double>& k, const std::string& source,
                    const std::string& field) {
  if (k.size() != 9)
    throw InputError(source, field, std::to_string(k.size()) + " numbers",
                     "9 (a 3x3 matrix by row)");
  if (std::abs(k[1]) > 1e-3 || k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1)
    throw InputError(source, field, "a matrix with skew or another scale",
                     "fx 0 cx, 0 fy cy, 0 0 1");
  camera.fx = k[0];
  camera.fy = k[4];
  camera.cx = k[2];
  camera.cy = k[5];
}

void set_distortion(Camera& camera, const std::vector<double>& coefficients,
                    const std::string& source, const std::string& field) {
  constexpr std::size_t most = 8;
  const std::size_t kept = std::min(coefficients.size(), most);
  if (std::any_of(coefficients.begin() + static_cast<std::ptrdiff_t>(kept), coefficients.end(),
                  [](double x) { return x != 0; }))
    throw InputError(source, field, "thin-prism or tilt coefficients",
                     "at most 8 coefficients k1 k2 p1 p2 k3 k4 k5 k6");
  if (kept != 0 && kept != 4 && kept != 5 && kept != 8)
    throw InputError(source, field, std::to_string(coefficients.size()) + " coefficients",
                     "0, 4, 5 or 8");
  std::copy_n(coefficients.begin(), kept, camera.distortion.begin());
}

Camera camera_from_bop(const JsonField& entry) {
  Camera camera;
  if (entry.has("cam_K")) {
    const JsonField k = entry.at("cam_K");
    set_intrinsics(camera, k.numbers(), k.source, k.path);
  } else {
    camera.fx = entry.at("fx").number();
    camera.fy = entry.at("fy").number();
    camera.cx = entry.at("cx").number();
    camera.cy = entry.at("cy").number();
  }
  if (entry.has("width")) camera.width = entry.at("width").integer();
  if (entry.has("height")) camera.height = entry.at("height").integer();
  if (entry.has("dist"))
    set_distortion(camera, entry.at("dist").numbers(), entry.source, entry.path + "/dist");
  return camera;
}

}  // namespace edgescout
