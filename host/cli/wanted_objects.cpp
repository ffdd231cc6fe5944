#include "host/cli/wanted_objects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/core/log.h"

namespace edgescout {

namespace {

// By object, the largest number that one of the images wants. Empty: one of them wants all.
std::map<int, int> wanted_of(const std::vector<const InputImage*>& images) {
  std::map<int, int> wanted;
  for (const InputImage* image : images) {
    if (image->wanted.empty()) return {};
    for (const auto& [id, instances] : image->wanted) wanted[id] = std::max(wanted[id], instances);
  }
  return wanted;
}

}  // namespace

void warn_of_targets_without_model(std::span<const InputImage> images,
                                   std::span<const TemplateSet> sets, const std::string& targets) {
  std::set<int> objects;
  int count = 0, all = 0;
  for (const InputImage& image : images)
    for (const auto& [id, instances] : image.wanted) {
      ++all;
      if (std::ranges::find(sets, id, &TemplateSet::object_id) != sets.end()) continue;
      objects.insert(id);
      ++count;
    }
  if (count > 0)
    log(LogLevel::Warning,
        fmt::format("{}: obj_id: found {}, expected objects with a model: {} of {} targets are not "
                    "searched for",
                    targets, fmt::join(objects, ", "), count, all));
}

std::span<const TemplateSet> WantedObjects::sets_for(const std::vector<const InputImage*>& images) {
  std::set<int> ids;
  const std::map<int, int> wanted = wanted_of(images);
  for (const TemplateSet& set : all_)
    if (wanted.contains(set.object_id)) ids.insert(set.object_id);
  takes_all_ = wanted.empty() || ids.size() == all_.size();
  if (takes_all_) return all_;
  if (ids == chosen_ids_) return chosen_;
  chosen_ids_ = ids;
  chosen_.clear();
  index_in_all_.clear();
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (ids.contains(all_[i].object_id)) {
      chosen_.push_back(all_[i]);
      index_in_all_.push_back(static_cast<int>(i));
    }
  return chosen_;
}

void WantedObjects::keep_most_probable(const std::vector<const InputImage*>& images,
                                       std::vector<Detection>& detections) const {
  if (!takes_all_)
    for (Detection& found : detections)
      found.object = index_in_all_[static_cast<std::size_t>(found.object)];
  std::map<int, int> left = wanted_of(images);
  if (left.empty()) return;
  std::erase_if(detections, [&](const Detection& found) {
    return --left[all_[static_cast<std::size_t>(found.object)].object_id] < 0;
  });
}

}  // namespace edgescout
