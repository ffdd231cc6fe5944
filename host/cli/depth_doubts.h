// Says where a run's depth images cannot belong to its grey ones.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/core/options.h"
#include "host/register/depth_offset.h"
#include "host/register/object_view.h"

namespace edgescout {

// What to say of a sensor by whose depth poses were moved so; empty: nothing.
std::string doubt_of_bias(std::span<const DepthOffset> offsets);

class DepthDoubts {
 public:
  // Logs what is in doubt for debugging. `view` has edges, and may have depth. `distances_m`: where
  // objects may be, along the camera's axis.
  void look_at(const std::string& image, const ObjectView& view, const Range& distances_m);
  // Compares poses that were found in one view, with its depth, with where its edges alone hold
  // them.
  void compare(const std::string& image, const Scene& scene, std::span<const Detection> found);
  // One warning of each kind of doubt.
  void say() const;

 private:
  struct Doubt {
    std::string first;  // of the first image
    int images = 0;
  };
  void add(const std::string& kind, const std::string& image, const std::string& what);

  std::vector<DepthOffset> offsets_;     // of all images
  std::map<std::string, Doubt> doubts_;  // by kind: what it may come from
  int looked_at_ = 0;
};

}  // namespace edgescout
