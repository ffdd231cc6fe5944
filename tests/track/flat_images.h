// Images of a part whose faces have one grey each, before a background that is flat or has stripes.
#pragma once

#include <cmath>

#include "host/core/types.h"
#include "host/render/raster.h"
#include "kernels/thread_pool.h"

namespace edgescout::test {

inline Camera flat_camera() { return {320, 240, 420, 420, 159.5, 119.5, {}}; }

inline double grey_of_face(const Eigen::Vector3d& normal_in_camera) {
  const Eigen::Vector3d light = Eigen::Vector3d(0.5, -0.7, -0.8).normalized();
  return 60 + 150 * std::max(0.0, normal_in_camera.dot(light));
}

// `stripes_px`: the width of stripes of the background; 0: none.
inline Image flat_image(const Mesh& mesh, const Se3& camera_from_object, ThreadPool& pool,
                        const Camera& camera = flat_camera(), int stripes_px = 0) {
  constexpr int samples = 3;
  const Camera fine = scaled(camera, samples);
  Triangles triangles;
  triangles.add(mesh, camera_from_object);
  const Raster raster = rasterize(triangles, fine, Se3{}, pool);
  Image image{camera.width, camera.height, {}};
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      double sum = 0;
      for (int sy = 0; sy < samples; ++sy)
        for (int sx = 0; sx < samples; ++sx) {
          const int triangle =
              raster.triangle[std::size_t(samples * y + sy) * std::size_t(fine.width) +
                              std::size_t(samples * x + sx)];
          const bool is_dark = stripes_px > 0 && (x / stripes_px) % 2 == 0;
          sum += triangle < 0 ? (is_dark ? 20 : 35)
                              : grey_of_face(camera_from_object.rotation *
                                             mesh.face_normals[std::size_t(triangle)]);
        }
      image.pixels.push_back(std::uint8_t(std::lround(sum / (samples * samples))));
    }
  return image;
}

}  // namespace edgescout::test
