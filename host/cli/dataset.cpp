#include "host/cli/dataset.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "host/core/log.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> folders;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    std::error_code unknown;
    if (fs::is_directory(entry->path(), unknown)) folders.push_back(entry->path());
  }
  std::ranges::sort(folders);
  return folders;
}

bool holds_scenes(const fs::path& folder) {
  return std::ranges::any_of(folders_in(folder), is_bop_scene);
}

std::vector<std::string> names_of_splits(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::path& split : folders_in(folder))
    if (holds_scenes(split)) names.push_back(split.filename().string());
  return names;
}

// obj_000012.ply -> 12. Nothing: no model of a dataset.
std::optional<int> id_of_model(const fs::path& file) {
  const std::string stem = file.stem().string();
  if (file.extension() != ".ply" || !stem.starts_with("obj_")) return {};
  int id = 0;
  const char* first = stem.data() + 4;
  const auto [end, error] = std::from_chars(first, stem.data() + stem.size(), id);
  if (error != std::errc{} || end != stem.data() + stem.size()) return {};
  return id;
}

std::map<int, std::string> models_in(const fs::path& folder) {
  std::map<int, std::string> models;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure))
    if (const std::optional<int> id = id_of_model(entry->path()))
      models[*id] = entry->path().string();
  return models;
}

DatasetModels chosen_models(const fs::path& folder, const std::map<int, std::string>& models,
                            const std::vector<int>& object_ids) {
  DatasetModels chosen;
  for (const int id : object_ids)
    if (!models.contains(id))
      throw InputError("command line", "--object-id", std::to_string(id),
                       "an object with a model in " + folder.string());
  for (const auto& [id, file] : models)
    if (object_ids.empty() || std::ranges::count(object_ids, id) > 0) {
      chosen.files.push_back(file);
      chosen.object_ids.push_back(id);
    }
  if (fs::exists(folder / "models_info.json"))
    chosen.models_info = (folder / "models_info.json").string();
  return chosen;
}

}  // namespace

void add_camera_names(CLI::App& verb, DatasetArguments& dataset) {
  verb.add_option("--cameras", dataset.cameras,
                  "Cameras of BOP scenes with several, by their names: cam1,cam2. Default: all")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES");
}

void add_dataset_arguments(CLI::App& verb, DatasetArguments& dataset) {
  verb.add_option("--split", dataset.split,
                  "The inputs are folders of BOP datasets; take the scenes of this split: test, "
                  "val, train_pbr .. Without --model the dataset's models are taken")
      ->type_name("NAME");
  add_camera_names(verb, dataset);
  verb.add_option(
          "--targets", dataset.targets,
          "BOP's list of images to work on (test_targets_bop19.json, .._bop24.json, "
          ".._multiview_bop25.json). That of 2019 also says which objects each image holds, "
          "and how many")
      ->type_name("FILE");
}

fs::path folder_of_split(const fs::path& input, const DatasetArguments& dataset) {
  if (dataset.split.empty()) return input;
  std::error_code unknown;
  if (fs::is_directory(input / dataset.split, unknown)) return input / dataset.split;
  std::vector<std::string> names;
  for (const fs::path& folder : folders_in(input))
    if (folder.filename().string().starts_with(dataset.split + "_") && holds_scenes(folder))
      names.push_back(folder.filename().string());
  if (names.size() == 1) return input / names[0];
  if (names.empty()) names = names_of_splits(input);
  throw InputError(input.string(), "--split", dataset.split,
                   names.empty() ? "a split of a dataset: it has no folder of scenes"
                                 : fmt::format("one of {}", fmt::join(names, ", ")));
}

std::string splits_in(const fs::path& folder) {
  const std::vector<std::string> names = names_of_splits(folder);
  if (names.empty()) return "no BOP scene";
  return fmt::format("the splits {} of a dataset", fmt::join(names, ", "));
}

std::vector<std::string> SceneLoader::cameras_of(const fs::path& folder) {
  std::vector<std::string> there = bop_cameras(folder);
  if (dataset_.cameras.empty()) {
    if (there.size() < 2 || !there[0].empty()) return there;
    if (!said_others_)
      log(LogLevel::Info,
          fmt::format("{}: scene_camera.json is taken; --cameras chooses others: {}",
                      folder.string(), fmt::join(there.begin() + 1, there.end(), ", ")));
    said_others_ = true;
    return {""};
  }
  std::vector<std::string> chosen;
  for (const std::string& name : dataset_.cameras)
    if (std::ranges::count(there, name) > 0 && std::ranges::count(chosen, name) == 0)
      chosen.push_back(name);
    else if (std::ranges::count(there, name) == 0)
      example_ = fmt::format(
          "{}: found the cameras {}", folder.string(),
          there[0].empty() ? "of scene_camera.json" : fmt::format("{}", fmt::join(there, ", ")));
  empty_ += chosen.empty();
  incomplete_ += chosen.size() < dataset_.cameras.size();
  return chosen;
}

std::vector<BopScene> SceneLoader::load(const fs::path& folder) {
  ++scenes_;
  std::vector<BopScene> views;
  for (const std::string& name : cameras_of(folder))
    views.push_back(with_truth_ ? load_bop_scene(folder, name) : load_bop_images(folder, name));
  return views;
}

void SceneLoader::report() const {
  if (incomplete_ == 0 || example_.empty()) return;
  const std::string chosen = fmt::format("{}", fmt::join(dataset_.cameras, ", "));
  if (empty_ == scenes_)
    throw InputError(fmt::format("{}, expected those of --cameras: {}", example_, chosen));
  log(LogLevel::Warning, fmt::format("{} of {} scenes do not have all of the cameras {}; {}",
                                     incomplete_, scenes_, chosen, example_));
}

DatasetModels models_of_dataset(const std::vector<std::string>& inputs,
                                const std::vector<int>& object_ids, bool to_evaluate) {
  const std::vector<const char*> order = to_evaluate
                                             ? std::vector{"models_eval", "models", "models_cad"}
                                             : std::vector{"models", "models_cad", "models_eval"};
  for (const std::string& input : inputs)
    for (const char* name : order) {
      const fs::path folder = fs::path(input) / name;
      const std::map<int, std::string> models = models_in(folder);
      if (!models.empty()) return chosen_models(folder, models, object_ids);
    }
  return {};
}

}  // namespace edgescout
