// What a user names on the command line as input, as a list of images; and the models to look for.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/core/types.h"
#include "host/io/bop.h"
#include "kernels/error.h"

namespace edgescout {

struct InputImage {
  std::filesystem::path file;
  std::filesystem::path scene_folder;  // of a BOP scene; else empty
  int scene_id = 0;
  int image_id = 0;
  std::optional<Camera> camera;  // of a BOP scene; size 0 x 0 until the image is read
  std::optional<Se3> camera_from_world;
  // A name no other image of the batch has, for its result files: "000001_000012" in a BOP scene,
  // else the file's stem (made unique by a number).
  std::string name;
};

// Each argument is an image, a BOP scene folder (has scene_camera.json), a folder of such scenes,
// or a folder of images (png, jpg, jpeg, pgm, ppm, bmp, tif, tiff; sorted by name). InputError
// where one is none of these or holds no image.
std::vector<InputImage> list_images(const std::vector<std::string>& arguments);

// What is worked on together: every image alone, or `by_scene` all of a scene that follow each
// other.
std::vector<std::span<const InputImage>> groups_of(std::span<const InputImage> images,
                                                   bool by_scene);

// Results among images that a scene does not list would be taken for images the next time.
// InputError where `out` is the folder of one.
void require_other_folder(std::span<const InputImage> images, const std::filesystem::path& out);

// What `work` makes of the image. Its InputErrors know no file: they get this one's name.
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
  std::optional<Camera> camera;  // absent: BOP scenes bring their own
  std::string file;
  bool may_scale = false;  // to images of another size
};
// Warns of a calibration of unknown size, which fits images of every size and may be wrong for
// most.
void warn_of_unknown_size(const GivenCamera& given);

// Of an image of this size. InputError naming the image and its calibration: there is none, one
// that does not fit.
Camera camera_of(const InputImage& image, int width, int height, const GivenCamera& given);

struct ModelArguments {
  std::vector<std::string> models;  // mesh files
  std::string unit;
  std::string models_info;  // BOP models_info.json; empty: no symmetries
  // of the models; empty: the number at the end of the file's name, else 1, 2 ..
  std::vector<int> object_ids;
  std::vector<std::string> templates;  // template files, in place of models
};
// Surfaces of revolution are sampled in `continuous_steps` turns.
std::vector<Object> load_objects(const ModelArguments& arguments,
                                 int continuous_steps = DETECTION_SYMMETRY_STEPS);

}  // namespace edgescout
