// Assigns the starts to the images.
#include <fmt/format.h>

#include "host/cli/register_batch.h"
#include "host/core/log.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

std::string described(const StartPose& pose) {
  return pose.image.empty() ? fmt::format("image {}", pose.image_id) : pose.image.string();
}

// How a start of the same form would name another image: "parts.avi#000000" for a video's frame.
std::string name_in_poses(const StartPose& form, const InputImage& image) {
  return form.image.empty() ? fmt::format("image {}", image.image_id)
                            : image.file.filename().string();
}

// Returns the image of a start; nothing if the start's scene is not among the images.
std::optional<std::size_t> image_of(const StartPose& pose, std::span<const InputImage> images,
                                    const std::string& poses_file) {
  bool scene_is_given = !pose.scene_id;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < images.size(); ++i) {
    // Only images of BOP scenes have a camera; others belong to no scene.
    const std::optional<int> scene =
        images[i].camera ? std::optional(images[i].scene_id) : std::nullopt;
    scene_is_given |= !scene || scene == pose.scene_id;
    if (!belongs_to(pose, {images[i].file, scene, images[i].image_id, images[i].camera_name}))
      continue;
    if (!found.empty() &&
        same_ending(pose, images[i].file) > same_ending(pose, images[found[0]].file))
      found.clear();
    if (found.empty() ||
        same_ending(pose, images[i].file) == same_ending(pose, images[found[0]].file))
      found.push_back(i);
  }
  if (found.size() > 1)
    throw InputError(poses_file, "image",
                     fmt::format("{}, which is {} and {}", described(pose),
                                 images[found[0]].file.string(), images[found[1]].file.string()),
                     images[found[0]].camera_name.empty()
                         ? "one that fits a single image"
                         : "one that fits a single image: --cameras chooses cameras");
  if (!found.empty()) return found[0];
  if (scene_is_given)
    throw InputError(poses_file, "image", described(pose),
                     "one of the images given, such as " + name_in_poses(pose, images.front()));
  return std::nullopt;
}

RegisterJob::Start start_of(const StartPose& pose, std::size_t view,
                            std::span<const RegisterModel> models, const std::string& poses_file) {
  for (std::size_t m = 0; m < models.size(); ++m) {
    if (models[m].object_id != pose.object_id) continue;
    if (!((pose.camera_from_object * models[m].edges.center_m).z() > 0))
      throw InputError(
          poses_file, "t",
          fmt::format("object {} behind the camera of {}", pose.object_id, described(pose)),
          "an object in front of it");
    return {view, static_cast<int>(m), pose.camera_from_object};
  }
  throw InputError(poses_file, "object", std::to_string(pose.object_id),
                   "the id of one of the models given");
}

void require_world_poses(const RegisterJob& job) {
  for (const InputImage& view : job.views)
    if (!view.camera_from_world)
      throw InputError(view.file.string(), "world pose", "none",
                       "cam_R_w2c and cam_t_w2c of every view with --multi-view");
}

}  // namespace

std::vector<RegisterJob> make_jobs(std::span<const InputImage> images,
                                   std::span<const RegisterModel> models,
                                   std::span<const StartPose> poses, bool multi_view,
                                   const std::string& poses_file) {
  std::vector<RegisterJob> jobs;
  for (const std::span<const InputImage> views : groups_of(images, multi_view))
    jobs.emplace_back().views.assign(views.begin(), views.end());
  std::vector<std::pair<std::size_t, std::size_t>> place;  // job and view of every image
  for (std::size_t j = 0; j < jobs.size(); ++j)
    for (std::size_t v = 0; v < jobs[j].views.size(); ++v) place.emplace_back(j, v);
  std::size_t passed_over = 0;
  for (const StartPose& pose : poses) {
    const std::optional<std::size_t> image = image_of(pose, images, poses_file);
    if (!image) {
      ++passed_over;
      continue;
    }
    const auto [job, view] = place[*image];
    jobs[job].starts.push_back(start_of(pose, view, models, poses_file));
  }
  if (passed_over == poses.size())
    throw InputError(poses_file, "poses", poses.empty() ? "none" : "only such of other scenes",
                     "at least one for the images given");
  if (passed_over > 0)
    log(LogLevel::Info,
        fmt::format("{}: {} poses of other scenes passed over", poses_file, passed_over));
  std::erase_if(jobs, [](const RegisterJob& job) { return job.starts.empty(); });
  if (multi_view)
    for (const RegisterJob& job : jobs) require_world_poses(job);
  return jobs;
}

}  // namespace edgescout
