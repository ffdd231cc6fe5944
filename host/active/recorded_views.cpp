#include "host/active/recorded_views.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "host/io/bop.h"
#include "host/io/files.h"
#include "host/io/image.h"
#include "host/io/rotations.h"
#include "host/io/text_tokens.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

std::vector<RecordedViews::Recording> bop_recordings(const BopScene& scene, Camera& camera) {
  std::vector<RecordedViews::Recording> recordings;
  const bool given = camera.fx > 0;
  for (const BopImage& image : scene.images) {
    if (!image.camera_from_world)
      throw InputError(image.file.string(), "world pose", "none",
                       "cam_R_w2c and cam_t_w2c of every view");
    const Camera& c = image.camera;
    if (!given && recordings.empty()) camera = c;
    if (!given && !same_intrinsics(c, camera))
      throw InputError(image.file.string(), "camera", "another one than the images' before",
                       "one camera for all views");
    recordings.push_back({image.file, *image.camera_from_world});
  }
  return recordings;
}

Se3 read_matrix(const fs::path& file, ProjectedRotations& projected) {
  const std::string text = read_file(file);
  TextTokens tokens(text, file.string());
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 16; ++i) matrix(i / 4, i % 4) = tokens.number("a 4 x 4 matrix");
  if (!matrix.allFinite() || matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw InputError(file.string(), "camera pose",
                     "a matrix with another last row than 0 0 0 1 or not finite",
                     "a rigid transform");
  const std::optional<Se3> pose =
      nearest_rigid(matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>(), projected);
  if (!pose)
    throw InputError(file.string(), "camera pose", "a matrix that is no rotation",
                     EXPECTED_ROTATION);
  return *pose;
}

std::string digits(int number, std::size_t width) {
  const std::string text = std::to_string(number);
  return std::string(width - std::min(width, text.size()), '0') + text;
}

// Every image that has a pose, in the order of their numbers, which may have gaps. Whether the
// image itself exists shows when its view is acquired.
std::vector<RecordedViews::Recording> visp_recordings(const fs::path& folder) {
  std::map<int, fs::path> poses;
  for (const auto& entry : fs::directory_iterator(folder / "CameraPose")) {
    int number = 0;
    if (const std::string name = entry.path().filename().string();
        std::sscanf(name.c_str(), "Camera_%d", &number) == 1 &&
        name == "Camera_" + digits(number, 3) + ".txt")
      poses.emplace(number, entry.path());
  }
  std::vector<RecordedViews::Recording> recordings;
  ProjectedRotations projected;
  for (const auto& [number, pose] : poses)
    recordings.push_back({folder / "Images" / ("Image_" + digits(number, 4) + ".pgm"),
                          read_matrix(pose, projected)});
  warn_of_projected(projected, (folder / "CameraPose").string());
  return recordings;
}

}  // namespace

RecordedViews::RecordedViews(const Camera& camera, std::vector<Recording> recordings,
                             const ImageOptions& reading)
    : camera_(camera), recordings_(std::move(recordings)), reading_(reading) {
  if (recordings_.empty()) throw InputError("recorded views: found none, expected at least one");
  for (std::size_t i = 0; camera_.width == 0; ++i) {
    try {
      const Image image = load_image(recordings_[i].file, reading_);
      camera_.width = image.width;
      camera_.height = image.height;
    } catch (const InputError&) {
      if (i + 1 == recordings_.size()) throw;
    }
  }
  validate(camera_, recordings_[0].file.string());
}

std::vector<Se3> RecordedViews::views() const {
  std::vector<Se3> poses;
  for (const Recording& recording : recordings_) poses.push_back(recording.camera_from_world);
  return poses;
}

Shot RecordedViews::acquire(int view) {
  check(view >= 0 && view < static_cast<int>(recordings_.size()),
        "RecordedViews::acquire: no such view");
  const Recording& recording = recordings_[static_cast<std::size_t>(view)];
  try {
    return {load_image(recording.file, reading_), recording.camera_from_world};
  } catch (const InputError& error) {
    throw AcquisitionError(error.what());
  }
}

RecordedViews load_recorded_views(const fs::path& folder, const std::optional<Camera>& given,
                                  const std::string& camera_name, const ImageOptions& reading) {
  Camera camera = given.value_or(Camera{});
  if (is_bop_scene(folder)) {
    const std::vector<RecordedViews::Recording> recordings =
        bop_recordings(load_bop_images(folder, camera_name), camera);
    return {camera, recordings, reading};
  }
  if (!fs::is_directory(folder / "CameraPose"))
    throw InputError(folder.string(), "folder", "neither scene_camera.json nor CameraPose",
                     "a BOP scene or a folder with CameraPose and Images");
  if (!given)
    throw InputError(folder.string(), "camera", "none",
                     "one: these recordings bring none of their own");
  return {camera, visp_recordings(folder), reading};
}

}  // namespace edgescout
