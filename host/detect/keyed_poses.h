// Poses of one object with the keys by which a stage chooses among them.
#pragma once

#include "host/detect/distinct_poses.h"
#include "host/model/template_set.h"
#include "host/register/thresholds.h"

namespace edgescout {

// A lower key is better.
struct KeyedPoses {
  std::vector<Se3> poses;
  std::vector<double> keys;

  void add(const Se3& pose, double key) {
    poses.push_back(pose);
    keys.push_back(key);
  }
  // Those with a lower key than pose `index`.
  KeyedPoses better_than(std::size_t index) const {
    KeyedPoses better;
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (keys[i] < keys[index]) better.add(poses[i], keys[i]);
    return better;
  }
  // Indices of distinct ones, lowest key first, at most `most`.
  std::vector<std::size_t> best_distinct_of(const TemplateSet& set, std::size_t most) const {
    return best_distinct(poses, keys, set.model.mesh, set.symmetries,
                         thresholds::SAME_POSE * set.model.mesh.diameter_m, most);
  }
  // The same of hits that are aligned in one image, in the frame of its camera. Registration brings
  // starts to one optimum that differ in what the image hardly shows: the distance by a step of the
  // templates.
  std::vector<std::size_t> best_distinct_starts_of(const TemplateSet& set, std::size_t most,
                                                   ThreadPool& threads) const {
    return best_distinct_in_view(poses, keys, set.model.mesh, set.symmetries,
                                 {thresholds::SAME_START, most}, threads);
  }
};

}  // namespace edgescout
