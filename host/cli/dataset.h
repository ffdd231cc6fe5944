// Chooses what of a BOP dataset is worked on: the split, the cameras, the targets and the models.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "host/io/bop.h"

namespace edgescout {

struct DatasetArguments {
  std::string split;                 // of dataset folders; empty: the inputs are no dataset folders
  std::vector<std::string> cameras;  // of scenes with several; empty: all
  std::string targets;               // file of load_bop_targets; empty: all images
};

// --split, --cameras, --targets
void add_dataset_arguments(CLI::App& verb, DatasetArguments& dataset);
void add_camera_names(CLI::App& verb, DatasetArguments& dataset);  // --cameras alone

// Returns the folder of the split's scenes: DATASET/SPLIT, else the only DATASET/SPLIT_*. Without a
// split the input itself. InputError: there is no such folder, or several.
std::filesystem::path folder_of_split(const std::filesystem::path& input,
                                      const DatasetArguments& dataset);

// For the error about a folder without scenes: "the splits test, train_pbr", or "no BOP scene".
std::string splits_in(const std::filesystem::path& folder);

// Loads scenes one by one, with or without their truth.
class SceneLoader {
 public:
  SceneLoader(const DatasetArguments& dataset, bool with_truth)
      : dataset_(dataset), with_truth_(with_truth) {}
  // One for each chosen camera that the scene has. If it has scene_camera.json and none is chosen,
  // that of this file alone.
  std::vector<BopScene> load(const std::filesystem::path& folder);
  // Warns, once, of scenes that lack a chosen camera. InputError: no scene has one of them.
  void report() const;

 private:
  std::vector<std::string> cameras_of(const std::filesystem::path& folder);

  const DatasetArguments& dataset_;
  bool with_truth_;
  int scenes_ = 0, empty_ = 0, incomplete_ = 0;
  std::string example_;  // a scene that lacks a camera, and the cameras that it has
  bool said_others_ = false;
};

struct DatasetModels {
  std::vector<std::string> files;  // empty: none of the inputs is a dataset with models
  std::vector<int> object_ids;     // one per file
  std::string models_info;         // empty: none
};

// Finds the models of the first dataset folder among the inputs: obj_*.ply in the first of its
// folders models, models_cad, models_eval, or with `to_evaluate` models_eval, models, models_cad.
// `object_ids` chooses among them; empty: all. InputError: a chosen object that is not there.
DatasetModels models_of_dataset(const std::vector<std::string>& inputs,
                                const std::vector<int>& object_ids, bool to_evaluate);

}  // namespace edgescout
