// Reads the inputs that the command line names: images, cameras and models.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/cli/dataset.h"
#include "host/cli/depth_input.h"
#include "host/cli/template_cache_arguments.h"
#include "host/core/types.h"
#include "host/io/bop.h"
#include "host/io/image_options.h"
#include "host/io/mesh.h"
#include "host/io/video.h"
#include "host/model/template_set.h"
#include "kernels/error.h"

namespace edgescout {

struct InputImage {
  std::filesystem::path file;
  std::filesystem::path scene_folder;  // of a BOP scene; else empty
  int scene_id = 0;
  int image_id = 0;
  std::string camera_name;       // of a BOP scene with several cameras; else empty
  std::optional<Camera> camera;  // of a BOP scene; size 0 x 0 until the image is read
  std::optional<Se3> camera_from_world;
  // The name of its result files, unique in the batch: "000001_000012" in a BOP scene, with
  // "_cam1" where the scene has several cameras, else the file's stem (with a number if needed).
  std::string name;
  // By a list of targets. Images of one scene and one group are worked on together. Objects to
  // search, with the largest number of instances; empty: all.
  int group = 0;
  std::map<int, int> wanted;
  ImageOptions reading = {};
  std::optional<DepthFile> depth = {};  // of a BOP scene that has some, or by --depth
  // Of a frame of a video, whose `file` then is the video's with the frame's number:
  // "a.avi#000012".
  std::filesystem::path video = {};
  int frame = 0;
  double frame_rate = 0;                     // Hz, as the video's header says; 0: it does not
  std::shared_ptr<VideoReader> frames = {};  // shared by all frames
};

// InputError: as load_image.
Image read_image(const InputImage& input);

// How images are read, and which frames of videos.
struct InputOptions {
  ImageOptions images;
  int every = 1;
  int first_frame = 0, last_frame = 1'000'000'000;
  DepthArguments depth;
};

// What --camera, --camera-name and --field-of-view say.
struct CameraArguments {
  std::string file;              // empty: BOP scenes have their own cameras
  std::string name;              // of one of several cameras in the file
  double field_of_view_deg = 0;  // of undistorted images; 0: they keep the focal length
};

// Each argument is an image, a video, a BOP scene folder (is_bop_scene), a folder of such scenes,
// or a folder of images and videos, sorted by name. With a split it is the folder of a dataset.
// Frames of the first video have scene_id 1, of the second one 2, and their number in the video,
// from 0, as image_id. The cameras of scenes get the chosen field of view. No truth is read.
// InputError: an argument is none of these or has no image.
std::vector<InputImage> list_images(const std::vector<std::string>& arguments,
                                    const CameraArguments& chosen = {},
                                    const DatasetArguments& dataset = {},
                                    const InputOptions& options = {});

// Divides the images into groups of one, or with `by_scene` into the consecutive images of each
// scene, of all its cameras, or of each group of a list of targets.
std::vector<std::span<const InputImage>> groups_of(std::span<const InputImage> images,
                                                   bool by_scene);

// InputError: `out` is the folder of an image that belongs to no scene. The next run would read
// result pictures as images.
void require_other_folder(std::span<const InputImage> images, const std::filesystem::path& out);

// Returns the result of `work`. Adds the image's file name to its InputErrors.
template <typename Work>
auto naming(const InputImage& image, Work work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(image.file.string() + ": " + error.what());
  }
}

// A calibration that the user gives for all images.
struct GivenCamera {
  std::optional<Camera> camera;  // absent: the camera of the BOP scene
  std::string file;
  bool may_scale = false;  // to images of another size
};
// That of CameraArguments; 0: none is chosen.
double field_of_view_rad(const CameraArguments& arguments);

// Reads the calibration of all images, with the chosen field of view. Of several cameras of other
// sizes in the file the one of the first usable image's size is taken. Empty: no file is given.
std::optional<Camera> given_camera(const CameraArguments& arguments,
                                   std::span<const InputImage> images);

// Warns of a calibration without image size, which is accepted for images of every size but may be
// wrong for most, and of values that are hardly right (core/camera_check.h).
void warn_of_camera(const GivenCamera& given);

// Returns the camera of an image of this size. InputError naming the image and its calibration:
// there is none, or it does not fit.
Camera camera_of(const InputImage& image, int width, int height, const GivenCamera& given);

// Returns the camera from which default distances are computed: that of the first usable image.
// InputError: if no image is usable, that of the last one.
Camera first_camera(std::span<const InputImage> images, const CameraArguments& arguments,
                    bool may_scale);

// As check_camera_poses, for images of one scene, which have world poses. They are taken to have
// one camera: for the check that is near enough.
void check_scene(std::span<const InputImage> images, const DistanceRange& searched,
                 const Camera& camera);

struct ModelArguments {
  std::vector<std::string> models;  // mesh files
  std::string unit;                 // empty: the files state it
  std::string models_info;          // BOP models_info.json; empty: no symmetries
  // One per model. Empty: the number at the end of the file's name, else 1, 2 ..
  std::vector<int> object_ids;
  std::vector<std::string> templates;  // template files, in place of models
  std::vector<std::string> symmetry;   // words, in place of what files say (symmetry_arguments.h)
  TemplateCacheArguments cache;        // of templates that are built of models
};
// The unit of --unit; absent where none is given.
std::optional<LengthUnit> unit_of(const std::string& word);

// Without models and templates, takes those of the dataset that the inputs name.
void take_models_of_dataset(ModelArguments& arguments, const std::vector<std::string>& inputs,
                            const DatasetArguments& dataset, bool to_evaluate);
// Continuous symmetries are sampled in `continuous_steps` steps.
std::vector<Object> load_objects(const ModelArguments& arguments,
                                 int continuous_steps = DETECTION_SYMMETRY_STEPS);

}  // namespace edgescout
