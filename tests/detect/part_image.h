// One part in front of a small camera: its ideal edges, views and templates.
#pragma once

#include <gtest/gtest.h>

#include "host/detect/tensors.h"
#include "host/model/template_set.h"
#include "tests/register/scene.h"

namespace edgescout::test {

inline Camera small_camera() { return {320, 240, 400, 400, 159.5, 119.5, {}}; }

// The edges alone: the image is blank, so psi means nothing. The world is the camera frame.
inline ObjectView view_of_edges(const std::vector<EdgePoint>& edges, const Camera& camera,
                                double reduction, Backend& backend) {
  ObjectView view;
  view.camera = camera;
  view.image = std::make_shared<Image>(
      Image{camera.width, camera.height,
            std::vector<std::uint8_t>(static_cast<std::size_t>(camera.width) * camera.height)});
  view.edges = std::make_shared<EdgeIndex>(edges, camera.width, camera.height);
  add_tensors(view, reduction, backend, {});
  return view;
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
