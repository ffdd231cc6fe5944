// How large the experiments are, and on what they run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/active/scout.h"
#include "host/baselines/baseline.h"
#include "host/edge/edges.h"
#include "host/experiments/table.h"
#include "host/render/scene.h"

namespace edgescout {

// Knows the scene, and takes the views that show most of what is sought (clairvoyant_sequence):
// what a choice of views could reach at all.
inline constexpr char CLAIRVOYANT[] = "clairvoyant";

// Weight of the orientation in the tensors that the paper's methods read (Sec. 6), and in
// edgescout's own.
inline constexpr float PAPER_LAMBDA_PX_PER_RAD = 100;
inline constexpr float OWN_LAMBDA_PX_PER_RAD = TensorOptions{}.lambda_px_per_rad;
TensorOptions with_lambda(TensorOptions tensor, float lambda_px_per_rad);
// Both as results say what they were made with: name and value.
std::pair<std::string, std::string> lambda_note();

struct ExperimentSettings {
  std::filesystem::path
      data;  // folder with d2co-starts, brackets, cat, triangle, cad; empty: rendered scenes alone
  unsigned seed = 1;
  int scenes = 4;        // images with up to five parts: detection and registration
  int groups = 1;        // of three images with up to twenty parts: several views
  int starts = 8;        // of the registration around every instance
  int group_starts = 2;  // the same for the groups
  int every = 54;        // of the recorded starts (d2co-starts) those whose number this divides
  int frames_every =
      4;  // of the cat's photographs one in so many is used, and of a pile's as the first view
  int candidates = 1260;  // of the detection, in every image and for every type
  int bins = 1;           // of the next best view: piled parts, looked at from a hemisphere
  int cad_bins = 1;       // the same with parts of data/cad, where there is data
  // The bins of these numbers, of both kinds, in place of the first ones; of none whose number
  // above is 0.
  std::vector<int> only_bins;
  // What is sought in a bin: one type (another from bin to bin), each type by itself, or all of
  // them together.
  std::vector<std::string> searches{"one", "all"};
  // In the bins, by name; all from one belief, so that none changes what another finds. Beside
  // these there is CLAIRVOYANT.
  std::vector<std::string> strategies{"mi-max", "random", "dis", "fixed"};
  // Of Random, whose one draw a bin says little of its mean: every draw after the first chooses a
  // second view and ends there.
  int random_draws = 1;
  EdgeMethod edges = EdgeMethod::Gradient;  // that are registered to
  TensorOptions tensor;  // of all methods of registration and of FDCM; lambda is each method's own
  BaselineOptions methods;  // of registration, but edgescout's own
  ScoutOptions scout;  // in the bins; strategy, sequence, seeds and first view are the experiment's
  double image_scale = 1;  // of the paper's image sizes; the bins' are 640x480
  int supersampling = 3;   // of the renderer; odd
  bool times = true;       // off: columns of times stay empty, so that two runs give the same bytes
  ExperimentSettings();
  static ExperimentSettings short_form();  // minutes on two cores
  // The paper's numbers of images and a few bins: an hour on two cores; thirty bins take three
  // hours more.
  static ExperimentSettings full_form();
  std::vector<int> bin_numbers(
      int count) const;   // of the bins that are run: the first ones, or only_bins
  void validate() const;  // InputError naming the field and the violated bound
};

// Of a bin's camera and light; how many parts there are and where differs from bin to bin (bin.h).
RenderOptions bin_image_options(const ExperimentSettings& settings);

// Dataset 1: up to five parts in an image; Dataset 2: up to twenty in three (paper, Sec. 6). At the
// paper's sizes times `image_scale`.
RenderOptions single_image_options(const ExperimentSettings& settings, int scene);
RenderOptions image_group_options(const ExperimentSettings& settings, int group);

}  // namespace edgescout
