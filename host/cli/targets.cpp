#include "host/cli/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "kernels/error.h"

namespace edgescout {

namespace {

bool is_view(const InputImage& image, const BopView& view) {
  return image.image_id == view.image_id &&
         (view.camera_name.empty() || view.camera_name == image.camera_name);
}

// Of the images of one scene.
std::vector<InputImage> images_of_view(std::span<const InputImage> scene, const BopView& view,
                                       const DatasetArguments& dataset) {
  std::vector<InputImage> found;
  for (const InputImage& image : scene)
    if (is_view(image, view)) found.push_back(image);
  const bool is_of_other_camera = !view.camera_name.empty() && !dataset.cameras.empty() &&
                                  std::ranges::count(dataset.cameras, view.camera_name) == 0;
  if (found.empty() && !is_of_other_camera)
    throw InputError(dataset.targets, fmt::format("scene {}", scene[0].scene_id),
                     fmt::format("image {}{}", view.image_id,
                                 view.camera_name.empty() ? "" : " of camera " + view.camera_name),
                     "an image in " + scene[0].scene_folder.string());
  return found;
}

class ChosenImages {
 public:
  // An image that is there already gets the target's object in addition.
  void add(InputImage image, const BopTarget& target) {
    const auto [place, is_new] =
        places_.emplace(std::pair(image.file, image.group), images_.size());
    if (is_new) images_.push_back(std::move(image));
    if (!target.object_id) return;
    int& count = images_[place->second].wanted[*target.object_id];
    count = std::max(count, target.instances.value_or(std::numeric_limits<int>::max()));
  }
  std::vector<InputImage> take() { return std::move(images_); }

 private:
  std::vector<InputImage> images_;
  std::map<std::pair<std::filesystem::path, int>, std::size_t> places_;
};

}  // namespace

std::vector<InputImage> images_of_targets(const std::vector<InputImage>& images,
                                          const DatasetArguments& dataset) {
  if (dataset.targets.empty()) return images;
  const std::vector<BopTarget> targets = load_bop_targets(dataset.targets);
  ChosenImages chosen;
  for (const std::span<const InputImage> scene : groups_of(images, true)) {
    if (scene[0].scene_folder.empty()) continue;
    for (std::size_t t = 0; t < targets.size(); ++t) {
      if (targets[t].scene_id != scene[0].scene_id) continue;
      for (const BopView& view : targets[t].views)
        for (InputImage& image : images_of_view(scene, view, dataset)) {
          image.group = targets[t].is_group ? int(t) : 0;
          chosen.add(std::move(image), targets[t]);
        }
    }
  }
  std::vector<InputImage> left = chosen.take();
  if (left.empty())
    throw InputError(dataset.targets, "targets", "none in the scenes given", "at least one");
  return left;
}

std::set<int> objects_of_targets(const std::string& file) {
  std::set<int> objects;
  for (const BopTarget& target : load_bop_targets(file))
    if (target.object_id) objects.insert(*target.object_id);
  return objects;
}

}  // namespace edgescout
