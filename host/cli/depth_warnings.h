// Warns where a run's depth images cannot belong to its grey ones.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/core/options.h"
#include "host/register/depth_offset.h"
#include "host/register/object_view.h"

namespace edgescout {

// The warning about a sensor whose depth moved poses by these offsets; empty: none.
std::string bias_warning(std::span<const DepthOffset> offsets);

class DepthWarnings {
 public:
  // Collects the warnings of an image and logs them for debugging. `view` has edges, and may have
  // depth. `distances_m`: where objects may be, along the camera's axis.
  void check_view(const std::string& image, const ObjectView& view, const Range& distances_m);
  // Compares poses that were found in one view, with its depth, with where its edges alone hold
  // them.
  void compare(const std::string& image, const Scene& scene, std::span<const Detection> found);
  // One line for each kind of warning.
  void log_warnings() const;

 private:
  struct Warning {
    std::string first;  // of the first image
    int images = 0;
  };
  void add(const std::string& kind, const std::string& image, const std::string& what);

  std::vector<DepthOffset> offsets_;         // of all images
  std::map<std::string, Warning> warnings_;  // by kind: what it may come from
  int checked_ = 0;
};

}  // namespace edgescout
