#include "host/cli/batch_tables.h"

#include <algorithm>

#include "host/cli/batch_results.h"

namespace edgescout {

void BatchTables::add(const InputImage& input, const ImageResult& result,
                      const std::filesystem::path& folder) {
  PageImage& image = add_image(input);
  image.folder = folder;
  for (const StageSeconds& stage : result.stages) image.seconds += stage.seconds;
  for (const Detection& d : result.detections) {
    rows.push_back({result.scene_id, result.image_id,
                    result.objects[static_cast<std::size_t>(d.object)].id, d.probability,
                    result.camera_from_world.value_or(Se3{}) * d.world_from_object, image.seconds,
                    result.camera_name});
    image.best_probability = std::max(image.best_probability, d.probability);
    out_of_sight += d.convergence == OUT_OF_SIGHT;
  }
  image.poses = static_cast<int>(result.detections.size());
  incomplete += !result.incomplete.empty();
  devices.insert(result.device);
  ++done;
  add_stages(input, result);
}

PageImage& BatchTables::add_image(const InputImage& input) {
  if (!input.camera_name.empty()) cameras.insert(input.camera_name);
  PageImage& image = images.emplace_back();
  image.name = input.name;
  return image;
}

void BatchTables::add_stages(const InputImage& input, const ImageResult& result) {
  if (by_scene_ && !counted_.insert(input.scene_folder).second) return;
  for (const StageSeconds& stage : result.stages) {
    const auto known = std::ranges::find(stages, stage.name, &StageSeconds::name);
    if (known == stages.end())
      stages.push_back({stage.name, stage.seconds});
    else
      known->seconds += stage.seconds;
  }
}

void BatchTables::add_failed(const InputImage& input, const std::string& message) {
  PageImage& image = add_image(input);
  image.state = PageImage::State::Failed;
  image.message = message;
}

void BatchTables::add_missing(const InputImage& input, const std::string& message) {
  PageImage& image = add_image(input);
  image.state = PageImage::State::Missing;
  image.message = message;
}

}  // namespace edgescout
