#include "host/cli/eval_targets.h"

#include <algorithm>
#include <limits>

#include "host/io/bop_targets.h"
#include "kernels/error.h"

namespace edgescout {

EvalTargets::EvalTargets(std::string file) : file_(std::move(file)) {
  if (file_.empty()) return;
  for (const BopTarget& target : load_bop_targets(file_))
    for (const BopView& view : target.views) {
      std::vector<Wanted>& wanted = images_[{target.scene_id, view.image_id}];
      auto place = std::ranges::find(wanted, view.camera_name, &Wanted::camera_name);
      if (place == wanted.end()) place = wanted.insert(wanted.end(), {view.camera_name, {}});
      if (target.object_id)
        place->objects[*target.object_id] =
            target.instances.value_or(std::numeric_limits<int>::max());
    }
}

const EvalTargets::Wanted* EvalTargets::find(const BopScene& scene, int image_id) const {
  const auto image = images_.find({scene.scene_id, image_id});
  if (image == images_.end()) return nullptr;
  for (const Wanted& wanted : image->second)
    if (wanted.camera_name.empty() || wanted.camera_name == scene.camera_name) return &wanted;
  return nullptr;
}

void EvalTargets::restrict(BopScene& scene) const {
  if (file_.empty()) return;
  for (const auto& [place, wanted] : images_)
    if (place.first == scene.scene_id && find(scene, place.second) &&
        std::ranges::find(scene.images, place.second, &BopImage::image_id) == scene.images.end())
      throw InputError(
          file_, "scene " + std::to_string(scene.scene_id), "image " + std::to_string(place.second),
          "an image in " + bop_file(scene.folder, "scene_camera", scene.camera_name).string());
  std::erase_if(scene.images, [&](const BopImage& image) { return !find(scene, image.image_id); });
}

std::map<int, int> EvalTargets::objects_of(const BopScene& scene, int image_id) const {
  const Wanted* wanted = find(scene, image_id);
  return wanted ? wanted->objects : std::map<int, int>{};
}

}  // namespace edgescout
