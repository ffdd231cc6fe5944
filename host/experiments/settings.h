// The sizes of the experiments, their data and their options.
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

// A strategy that knows the scene and takes the views that show most of the targets
// (clairvoyant_sequence): the upper bound for a choice of views.
inline constexpr char CLAIRVOYANT[] = "clairvoyant";

// Weight of the orientation in the tensors of the paper's methods (Sec. 6) and of edgescout.
inline constexpr float PAPER_LAMBDA_PX_PER_RAD = 100;
inline constexpr float OWN_LAMBDA_PX_PER_RAD = TensorOptions{}.lambda_px_per_rad;
TensorOptions with_lambda(TensorOptions tensor, float lambda_px_per_rad);
// Both weights as a note of a table: name and value.
std::pair<std::string, std::string> lambda_note();

struct ExperimentSettings {
  // Folder with d2co-starts, brackets, cat, triangle and cad. Empty: only rendered scenes are used.
  std::filesystem::path data;
  unsigned seed = 1;
  int scenes = 4;         // images with up to five parts, for detection and registration
  int groups = 1;         // groups of three images with up to twenty parts, for several views
  int starts = 8;         // registrations around every instance of the images
  int group_starts = 2;   // registrations around every instance of the groups
  int every = 54;         // uses the recorded starts (d2co-starts) with a multiple of this number
  int frames_every = 4;   // uses every n-th photograph of the cat, and of a pile as the first view
  int candidates = 1260;  // of the detection, in every image and for every type
  int bins = 1;           // of the next best view: piled parts, with views on a hemisphere
  int cad_bins = 1;       // the same with parts of data/cad, if there is data
  // Numbers of the bins to run, in place of the first ones. A kind of bins whose number above is 0
  // is not run.
  std::vector<int> only_bins;
  // What is detected in a bin: "one" type (it changes from bin to bin), "each" type by itself, or
  // "all" types in one search.
  std::vector<std::string> searches{"one", "all"};
  // Names of the strategies in the bins. All continue from the same first image, so none changes
  // the result of another. CLAIRVOYANT is also known.
  std::vector<std::string> strategies{"mi-max", "random", "dis", "fixed"};
  // Draws of the strategy Random per bin, since a single draw says little of its mean. Every draw
  // after the first takes one more view and ends.
  int random_draws = 1;
  // Rendered bins come with depth images of a sensor, of which a third of the parts' pixels is
  // missing beside its other holes.
  bool depth = false;
  EdgeMethod edges = EdgeMethod::Gradient;  // for registration
  TensorOptions tensor;     // of all registration methods and FDCM; each method has its own lambda
  BaselineOptions methods;  // of the registration methods apart from edgescout
  // In the bins. The experiment sets strategy, sequence, seeds and first view.
  ScoutOptions scout;
  double image_scale = 1;  // of the paper's image sizes; those of bins are 640x480
  int supersampling = 3;   // of the renderer; odd
  bool times = true;       // off: columns of times are empty, so that two runs give the same bytes
  ExperimentSettings();
  static ExperimentSettings short_form();  // takes minutes on two cores
  // The paper's numbers of images and a few bins. Takes an hour on two cores; thirty bins take
  // three hours more.
  static ExperimentSettings full_form();
  // The numbers of the bins to run: the first `count`, or only_bins.
  std::vector<int> bin_numbers(int count) const;
  void validate() const;  // InputError naming the field and the violated bound
};

// Camera and light of a bin. The number of parts and their places change from bin to bin (bin.h).
RenderOptions bin_image_options(const ExperimentSettings& settings);

// Dataset 1: up to five parts in one image. Dataset 2: up to twenty parts in three images (paper,
// Sec. 6). The image sizes are the paper's times `image_scale`.
RenderOptions single_image_options(const ExperimentSettings& settings, int scene);
RenderOptions image_group_options(const ExperimentSettings& settings, int group);

}  // namespace edgescout
