// One part before a small camera: ideal edges, observations and templates of it.
#pragma once

#include <gtest/gtest.h>

#include "host/detect/observation.h"
#include "host/model/template_set.h"
#include "tests/register/scene.h"

namespace edgescout::test {

inline Camera small_camera() { return {320, 240, 400, 400, 159.5, 119.5, {}}; }

// No image, so no Psi: the edges alone. World: the camera frame.
inline Observation observe_edges(const std::vector<EdgePoint>& edges, const Camera& camera,
                                 double reduction, Backend& backend) {
  const Image blank{
      camera.width, camera.height,
      std::vector<std::uint8_t>(static_cast<std::size_t>(camera.width) * camera.height)};
  return observe(blank, camera, Se3{}, edges, reduction, {}, backend);
}

inline TemplateSet part_templates(const std::string& part, int frequency, double distance_min_m,
                                  double distance_max_m, Backend& backend) {
  TemplateOptions options;
  options.frequency = frequency;
  options.in_plane_steps = 12;
  options.distance_min_m = distance_min_m;
  options.distance_max_m = distance_max_m;
  return build_templates(make_part(part), options, backend);
}

}  // namespace edgescout::test
