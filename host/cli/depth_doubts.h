// Says where a run's depth images cannot belong to its grey ones.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/core/options.h"
#include "host/register/object_view.h"

namespace edgescout {

class DepthDoubts {
 public:
  // Logs what is in doubt for debugging. `view` has edges, and may have depth. `distances_m`: where
  // objects may be, along the camera's axis.
  void look_at(const std::string& image, const ObjectView& view, const Range& distances_m);
  // One warning of each kind of doubt.
  void say() const;

 private:
  struct Doubt {
    std::string first;  // of the first image
    int images = 0;
  };
  void add(const std::string& kind, const std::string& image, const std::string& what);

  std::map<std::string, Doubt> doubts_;  // by kind: what it may come from
  int looked_at_ = 0;
};

}  // namespace edgescout
