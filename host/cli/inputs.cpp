#include "host/cli/inputs.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "host/active/camera_geometry_check.h"
#include "host/cli/symmetry_arguments.h"
#include "host/cli/targets.h"
#include "host/core/camera_check.h"
#include "host/core/log.h"
#include "host/io/camera_file.h"
#include "host/io/image.h"
#include "host/io/mesh.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

// A path that cannot be examined is no folder.
bool is_folder(const fs::path& path) {
  std::error_code unknown;
  return fs::is_directory(path, unknown);
}

// Other systems leave hidden files beside images: "._a.png" of macOS.
std::vector<fs::path> sorted_entries(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure))
    if (!entry->path().filename().string().starts_with('.')) entries.push_back(entry->path());
  if (failure)
    throw InputError(folder.string(), "folder", failure.message(), "one that can be read");
  std::ranges::sort(entries);
  return entries;
}

void add_scene(const fs::path& folder, SceneLoader& loader, std::vector<InputImage>& images) {
  for (const BopScene& scene : loader.load(folder)) {
    const std::string& camera = scene.camera_name;
    for (const BopImage& image : scene.images)
      images.push_back({image.file,
                        folder,
                        scene.scene_id,
                        image.image_id,
                        camera,
                        image.camera,
                        image.camera_from_world,
                        fmt::format("{}_{}{}{}", six_digits(scene.scene_id),
                                    six_digits(image.image_id), camera.empty() ? "" : "_", camera),
                        0,
                        {},
                        {},
                        depth_file_of(image)});
    if (scene.images.empty())
      throw InputError(bop_file(folder, "scene_camera", camera).string(), "images", "none",
                       "at least one");
  }
}

void add_file(const fs::path& file, std::vector<InputImage>& images) {
  InputImage image;
  image.file = file;
  image.image_id = static_cast<int>(images.size());
  image.name = file.stem().string();
  images.push_back(image);
}

// The name is the same whichever frames are chosen.
void add_video(const fs::path& video, const InputOptions& options,
               std::vector<InputImage>& images) {
  int scene_id = 1;
  for (std::size_t i = 0; i < images.size(); ++i)
    if (!images[i].video.empty() && (i == 0 || images[i].video != images[i - 1].video)) ++scene_id;
  const int count = count_frames(video);
  const double frame_rate = stated_frame_rate(video);
  const auto frames = images.empty() || !images.back().frames ? std::make_shared<VideoReader>()
                                                              : images.back().frames;
  for (int frame = options.first_frame; frame < count && frame <= options.last_frame;
       frame += options.every) {
    InputImage& image = images.emplace_back();
    image.file = name_of_frame(video, frame);
    image.scene_id = scene_id;
    image.image_id = frame;
    image.name = fmt::format("{}_{:06}", video.stem().string(), frame);
    image.video = video;
    image.frame = frame;
    image.frame_rate = frame_rate;
    image.frames = frames;
  }
  if (options.first_frame >= count)
    throw InputError(video.string(), "frames", std::to_string(count),
                     fmt::format("more than {} (--first-frame)", options.first_frame));
}

void add_file_or_video(const fs::path& file, const InputOptions& options,
                       std::vector<InputImage>& images) {
  if (has_video_extension(file))
    add_video(file, options, images);
  else
    add_file(file, images);
}

void add_folder(const fs::path& folder, SceneLoader& loader, const InputOptions& options,
                std::vector<InputImage>& images) {
  if (is_bop_scene(folder)) return add_scene(folder, loader, images);
  const std::size_t before = images.size();
  const std::vector<fs::path> entries = sorted_entries(folder);
  bool has_scenes = false;
  for (const fs::path& entry : entries)
    if (is_folder(entry) && is_bop_scene(entry)) {
      has_scenes = true;
      add_scene(entry, loader, images);
    }
  if (has_scenes) return;
  for (const fs::path& entry : entries)
    if (!is_folder(entry) && (has_video_extension(entry) || is_image_file(entry)))
      add_file_or_video(entry, options, images);
  if (images.size() == before)
    throw InputError(folder.string(), "folder", "no image, no video and " + splits_in(folder),
                     "an image, a video, a BOP scene, or --split for a dataset");
}

void make_names_unique(std::vector<InputImage>& images) {
  std::set<std::string> taken{"shard", "summary"};  // the batch's own files
  std::map<std::string, int> next;                  // number of each name that comes again
  for (InputImage& image : images) {
    const std::string name = image.name;
    while (!taken.insert(image.name).second)
      image.name = fmt::format("{}_{}", name, next.try_emplace(name, 2).first->second++);
  }
}

SizePx size_of_first(std::span<const InputImage> images) {
  for (const InputImage& input : images) {
    try {
      const Image image = read_image(input);
      return {image.width, image.height};
    } catch (const InputError&) {
      if (&input == &images.back()) throw;
    }
  }
  throw InputError("command line", "inputs", "no image", "at least one");
}

int id_in_name(const std::string& file, int otherwise) {
  const std::string stem = fs::path(file).stem().string();
  const std::size_t digits = stem.size() - (stem.find_last_not_of("0123456789") + 1);
  if (digits == 0 || digits > 8) return otherwise;
  return std::stoi(stem.substr(stem.size() - digits));
}

}  // namespace

std::vector<InputImage> list_images(const std::vector<std::string>& arguments,
                                    const CameraArguments& chosen, const DatasetArguments& dataset,
                                    const InputOptions& options) {
  options.images.validate();
  if (options.last_frame < options.first_frame)
    throw InputError("command line", "--last-frame", std::to_string(options.last_frame),
                     fmt::format("{} (--first-frame) or more", options.first_frame));
  std::vector<InputImage> images;
  SceneLoader loader(dataset, false);
  for (const std::string& argument : arguments) {
    const fs::path path = folder_of_split(fs::path(argument).lexically_normal(), dataset);
    std::error_code unknown;
    if (is_folder(path))
      add_folder(path.has_filename() ? path : path.parent_path(), loader, options, images);
    else if (fs::exists(path, unknown))
      add_file_or_video(path, options, images);
    else
      throw InputError(argument, "input", unknown ? unknown.message() : "nothing of that name",
                       "an image, a video, a folder of images or a BOP scene");
  }
  loader.report();
  images = images_of_targets(images, dataset);
  make_names_unique(images);
  for (InputImage& image : images) image.reading = options.images;
  find_depth(images, options.depth);
  for (InputImage& image : images)
    if (image.camera) image.camera->field_of_view_rad = field_of_view_rad(chosen);
  return images;
}

Image read_image(const InputImage& input) {
  return input.frames ? input.frames->frame(input.video, input.frame, input.reading)
                      : load_image(input.file, input.reading);
}

std::vector<std::span<const InputImage>> groups_of(std::span<const InputImage> images,
                                                   bool by_scene) {
  std::vector<std::span<const InputImage>> groups;
  for (std::size_t first = 0, i = 1; i <= images.size(); ++i) {
    if (by_scene && i < images.size() && images[i].scene_folder == images[first].scene_folder &&
        images[i].group == images[first].group)
      continue;
    groups.push_back(images.subspan(first, i - first));
    first = i;
  }
  return groups;
}

void require_other_folder(std::span<const InputImage> images, const fs::path& out) {
  std::error_code not_there;
  for (const InputImage& image : images)
    if (image.scene_folder.empty() &&
        fs::equivalent(image.file.parent_path() / ".", out, not_there))
      throw InputError("command line", "--out", "the folder of the images", "another one");
}

double field_of_view_rad(const CameraArguments& arguments) {
  return arguments.field_of_view_deg * std::numbers::pi / 180;
}

std::optional<Camera> given_camera(const CameraArguments& arguments,
                                   std::span<const InputImage> images) {
  if (arguments.file.empty()) {
    if (arguments.name.empty()) return {};
    throw InputError("command line", "--camera-name", "it without --camera", "--camera FILE");
  }
  Camera camera = choose_camera(
      load_cameras(arguments.file), arguments.name, [&] { return size_of_first(images); },
      arguments.file);
  camera.field_of_view_rad = field_of_view_rad(arguments);
  return camera;
}

void warn_of_camera(const GivenCamera& given) {
  if (!given.camera) return;
  for (const std::string& warning : implausible_in(*given.camera))
    log(LogLevel::Warning, given.file + ": " + warning);
  if (given.camera->width == 0)
    log(LogLevel::Warning, fmt::format("{}: width, height: found none, expected the size of the "
                                       "calibration's images: taken to be that of every image",
                                       given.file));
}

Camera camera_of(const InputImage& image, int width, int height, const GivenCamera& given) {
  if (!given.camera && !image.camera)
    throw InputError(image.file.string(), "camera", "none", "--camera FILE");
  const std::string source =
      given.camera ? given.file
                   : bop_file(image.scene_folder, "scene_camera", image.camera_name).string();
  return naming(image, [&] {
    return camera_for_image(given.camera ? *given.camera : *image.camera, width, height,
                            given.may_scale, source);
  });
}

Camera first_camera(std::span<const InputImage> images, const CameraArguments& arguments,
                    bool may_scale) {
  const GivenCamera given{given_camera(arguments, images), arguments.file, may_scale};
  for (const InputImage& input : images) {
    try {
      const Image image = read_image(input);
      return camera_of(input, image.width, image.height, given);
    } catch (const InputError&) {
      if (&input == &images.back()) throw;
    }
  }
  throw InputError("command line", "inputs", "no image", "at least one");
}

void check_scene(std::span<const InputImage> images, const DistanceRange& searched,
                 const Camera& camera) {
  std::vector<PosedCamera> cameras;
  for (const InputImage& image : images) cameras.push_back({camera, *image.camera_from_world});
  check_camera_poses(cameras, searched, images[0].scene_folder.string());
}

std::optional<LengthUnit> unit_of(const std::string& word) {
  if (word.empty()) return {};
  return length_unit(word);
}

void take_models_of_dataset(ModelArguments& arguments, const std::vector<std::string>& inputs,
                            const DatasetArguments& dataset, bool to_evaluate) {
  if (dataset.split.empty() || !arguments.models.empty() || !arguments.templates.empty()) return;
  std::vector<int> ids = arguments.object_ids;
  if (ids.empty() && !dataset.targets.empty() && !to_evaluate) {
    const std::set<int> named = objects_of_targets(dataset.targets);
    ids.assign(named.begin(), named.end());
  }
  const DatasetModels found = models_of_dataset(inputs, ids, to_evaluate);
  if (found.files.empty()) return;
  arguments.models = found.files;
  arguments.object_ids = found.object_ids;
  arguments.unit = "mm";
  if (arguments.models_info.empty()) arguments.models_info = found.models_info;
}

namespace {

// Where a file of symmetries is given, an object that it lacks is hardly meant to have none.
void set_symmetries(Object& object, const std::map<int, Symmetries>& symmetries,
                    const std::string& models_info, bool is_stated) {
  if (symmetries.contains(object.id))
    object.symmetries = symmetries.at(object.id);
  else if (!models_info.empty() && !is_stated)
    log(LogLevel::Warning, fmt::format("{}: object {}: found nothing, expected its symmetries: it "
                                       "is taken for one without",
                                       models_info, object.id));
}

}  // namespace

std::vector<Object> load_objects(const ModelArguments& arguments, int continuous_steps) {
  for (const std::string& file : arguments.models)
    if (is_template_file(file))
      throw InputError(file, "model", "a template file",
                       "a CAD file (templates are given with --templates)");
  if (!arguments.object_ids.empty() && arguments.object_ids.size() != arguments.models.size())
    throw InputError("command line", "--object-id",
                     std::to_string(arguments.object_ids.size()) + " ids",
                     "one for each of " + std::to_string(arguments.models.size()) + " models");
  std::map<int, Symmetries> symmetries;
  if (!arguments.models_info.empty())
    symmetries = load_symmetries(arguments.models_info, continuous_steps);
  std::vector<Object> objects;
  std::vector<int> ids;
  for (std::size_t i = 0; i < arguments.models.size(); ++i) {
    Object object;
    object.id = arguments.object_ids.empty() ? id_in_name(arguments.models[i], int(i) + 1)
                                             : arguments.object_ids[i];
    if (std::ranges::find(ids, object.id) != ids.end())
      throw InputError(arguments.models[i], "object id", std::to_string(object.id) + " twice",
                       "ids that differ: give --object-id");
    ids.push_back(object.id);
    object.mesh = load_mesh(arguments.models[i], unit_of(arguments.unit));
    set_symmetries(object, symmetries, arguments.models_info, !arguments.symmetry.empty());
    objects.push_back(std::move(object));
  }
  const StatedSymmetries stated(arguments.symmetry, ids);
  for (Object& object : objects)
    if (const auto own = stated.of(object.id, object.mesh, continuous_steps))
      replace_symmetries(object, *own, symmetries.contains(object.id) ? arguments.models_info : "");
  return objects;
}

}  // namespace edgescout
