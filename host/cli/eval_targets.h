// Restricts an evaluation to the images of a BOP list of targets.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/io/bop.h"

namespace edgescout {

class EvalTargets {
 public:
  // Empty: no list, all images. InputError: a list that cannot be read.
  explicit EvalTargets(std::string file);

  // Removes the scene's images that the list does not name. InputError: it names an image that the
  // scene does not have.
  void restrict(BopScene& scene) const;
  // By object, how many instances are to be found in this image; empty: what is seen enough.
  std::map<int, int> objects_of(const BopScene& scene, int image_id) const;

 private:
  struct Wanted {
    std::string camera_name;  // empty: every camera
    std::map<int, int> objects;
  };
  const Wanted* find(const BopScene& scene, int image_id) const;

  std::string file_;
  std::map<std::pair<int, int>, std::vector<Wanted>> images_;  // by scene and image
};

}  // namespace edgescout
