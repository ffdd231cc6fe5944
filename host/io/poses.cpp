#include "host/io/poses.h"

#include "host/io/bop.h"
#include "host/io/json_fields.h"
#include "host/io/json_text.h"
#include "host/io/results.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

std::vector<StartPose> from_bop_results(const std::filesystem::path& file) {
  std::vector<StartPose> poses;
  for (const BopResult& row : load_bop_results(file))
    poses.push_back({row.scene_id, row.image_id, "", row.camera_name, row.object_id,
                     row.camera_from_object, row.score});
  return poses;
}

std::vector<StartPose> from_image_result(const std::filesystem::path& file) {
  const ImageResult result = load_image_result(file);
  const Se3 camera_from_world = result.camera_from_world.value_or(Se3{});
  // The scene id is also 0 for an image that belongs to no scene.
  const std::optional<int> scene =
      result.scene_id == 0 ? std::nullopt : std::optional(result.scene_id);
  std::vector<StartPose> poses;
  for (const Detection& found : result.detections)
    poses.push_back({scene, result.image_id, result.image, result.camera_name,
                     result.objects.at(static_cast<std::size_t>(found.object)).id,
                     camera_from_world * found.world_from_object, found.probability});
  return poses;
}

StartPose from_entry(const JsonField& entry, ProjectedRotations& projected) {
  StartPose pose;
  const JsonField image = entry.at("image");
  if (image.value.is_string())
    pose.image = image.text();
  else
    pose.image_id = image.integer();
  if (entry.has("scene")) pose.scene_id = entry.at("scene").integer();
  if (entry.has("camera")) pose.camera_name = entry.at("camera").text();
  if (entry.has("score")) pose.score = entry.at("score").number();
  pose.object_id = entry.at("object").integer();
  pose.camera_from_object = pose_from(entry.at("R"), entry.at("t"), 1.0, projected);
  return pose;
}

// BOP's scene_gt.json: lists of objects by the number of the image, in mm.
std::vector<StartPose> from_bop_truth(const JsonField& root, ProjectedRotations& projected) {
  std::vector<StartPose> poses;
  for (const auto& [image_id, objects] : numbered_fields(root))
    for (const JsonField& entry : objects.elements()) {
      StartPose& pose = poses.emplace_back();
      pose.image_id = image_id;
      pose.object_id = entry.at("obj_id").integer();
      pose.camera_from_object =
          pose_from(entry.at("cam_R_m2c"), entry.at("cam_t_m2c"), METRES_PER_MM, projected);
    }
  return poses;
}

}  // namespace

std::vector<StartPose> load_start_poses(const std::filesystem::path& file) {
  if (file.extension() == ".csv") return from_bop_results(file);
  if (is_image_result(file)) return from_image_result(file);
  const nlohmann::json content = read_json(file);
  std::vector<StartPose> poses;
  ProjectedRotations projected;
  const JsonField root{content, file.string(), ""};
  if (content.is_object() && !root.has("image"))
    poses = from_bop_truth(root, projected);
  else if (content.is_object())
    poses.push_back(from_entry(root, projected));
  else
    for (const JsonField& entry : root.elements()) poses.push_back(from_entry(entry, projected));
  warn_of_projected(projected, file.string());
  return poses;
}

bool belongs_to(const StartPose& pose, const PosedImage& image) {
  if (pose.scene_id && image.scene_id && *pose.scene_id != *image.scene_id) return false;
  if (!pose.camera_name.empty() && pose.camera_name != image.camera_name) return false;
  if (pose.image.empty()) return pose.image_id == image.image_id;
  return pose.image.filename() == as_in_json(image.file.filename().string());
}

int same_ending(const StartPose& pose, const std::filesystem::path& image) {
  const std::filesystem::path a = pose.image.lexically_normal(),
                              b = as_in_json(
                                  std::filesystem::absolute(image).lexically_normal().string());
  int count = 0;
  for (auto i = a.end(), j = b.end(); i != a.begin() && j != b.begin() && *--i == *--j;) ++count;
  return count;
}

}  // namespace edgescout
