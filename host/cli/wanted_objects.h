// Restricts detection to the objects that a list of targets wants of an image.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "host/cli/inputs.h"
#include "host/core/types.h"

namespace edgescout {

// Warns, once, of the objects that the list wants of these images and that have no model, with the
// number of their targets. `targets` is the list's file.
void warn_of_targets_without_model(std::span<const InputImage> images,
                                   std::span<const TemplateSet> sets, const std::string& targets);

class WantedObjects {
 public:
  explicit WantedObjects(std::span<const TemplateSet> sets) : all_(sets) {}

  // Returns the sets to search in these images: all, if one of them names no objects. They hold
  // until the next call.
  std::span<const TemplateSet> sets_for(const std::vector<const InputImage*>& images);

  // For detections made with these sets, most probable first: keeps of each object as many as are
  // wanted of one image, and makes Detection::object an index into all sets.
  void keep_most_probable(const std::vector<const InputImage*>& images,
                          std::vector<Detection>& detections) const;

 private:
  std::span<const TemplateSet> all_;
  std::set<int> chosen_ids_;
  std::vector<TemplateSet> chosen_;  // of the images before, as a rule the same again
  std::vector<int> index_in_all_;    // of each chosen set
  bool takes_all_ = true;
};

}  // namespace edgescout
