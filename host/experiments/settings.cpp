#include "host/experiments/settings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string_view>

#include "host/core/random.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr std::string_view STRATEGIES[] = {"mi-max", "random", "dis", "fixed", CLAIRVOYANT};
constexpr std::string_view SEARCHES[] = {"one", "each", "all"};
constexpr int MOST_PARTS = 5, MOST_PARTS_IN_GROUP = 20, VIEWS_OF_GROUP = 3;

void require(bool holds, const char* field, double found, const char* expected) {
  if (!holds) throw InputError("experiments", field, number_text(found), expected);
}

// At least one of the known words, none twice.
void require_words(const std::vector<std::string>& words, std::span<const std::string_view> known,
                   const char* field) {
  std::string list;
  for (const std::string_view word : known) list += (list.empty() ? "" : ", ") + std::string(word);
  require(!words.empty(), field, 0, "at least one");
  for (const std::string& word : words) {
    if (std::ranges::find(known, word) == known.end())
      throw InputError("experiments", field, word, "one of " + list);
    if (std::ranges::count(words, word) > 1)
      throw InputError("experiments", field, word + " twice", "each once");
  }
}

// Every second image has a cluttered board, as "many images" of the paper. The number of parts and
// how much they hide each other change from scene to scene.
RenderOptions options_of(const ExperimentSettings& settings, const char* dataset, int number,
                         int most_parts) {
  Random random = Random(settings.seed).split(dataset).split(static_cast<std::uint64_t>(number));
  RenderOptions options;
  options.seed = static_cast<unsigned>(random.bits() >> 33);
  options.objects = 1 + random.below(most_parts);
  options.clutter = number % 2;
  options.pile = random.uniform(0, 0.8);
  options.supersampling = settings.supersampling;
  return options;
}

void set_camera(RenderOptions& options, int width, int height, double focal_px, double scale) {
  options.width = static_cast<int>(std::lround(width * scale));
  options.height = static_cast<int>(std::lround(height * scale));
  options.focal_px = focal_px * scale;
}

}  // namespace

TensorOptions with_lambda(TensorOptions tensor, float lambda_px_per_rad) {
  tensor.lambda_px_per_rad = lambda_px_per_rad;
  return tensor;
}

std::pair<std::string, std::string> lambda_note() {
  return {"lambda_px_per_rad",
          number_text(PAPER_LAMBDA_PX_PER_RAD) + " and " + number_text(OWN_LAMBDA_PX_PER_RAD)};
}

ExperimentSettings::ExperimentSettings() {
  scout.min_entropy_nats = 0;  // all strategies take all their views
}

ExperimentSettings ExperimentSettings::short_form() { return {}; }

ExperimentSettings ExperimentSettings::full_form() {
  ExperimentSettings settings;
  settings.scenes = 60;
  settings.groups = 30;
  settings.starts = 20;
  settings.group_starts = 4;
  settings.every = 1;
  settings.frames_every = 1;
  settings.bins = 2;
  return settings;
}

std::vector<int> ExperimentSettings::bin_numbers(int count) const {
  if (!only_bins.empty()) return count > 0 ? only_bins : std::vector<int>{};
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

void ExperimentSettings::validate() const {
  require(scenes >= 1 && scenes <= 10000, "scenes", scenes, "1 to 10000");
  require(groups >= 1 && groups <= 10000, "groups", groups, "1 to 10000");
  require(starts >= 1 && starts <= 1000, "starts", starts, "1 to 1000");
  require(group_starts >= 1 && group_starts <= 1000, "group_starts", group_starts, "1 to 1000");
  require(every >= 1, "every", every, "at least 1");
  require(frames_every >= 1, "frames_every", frames_every, "at least 1");
  require(candidates >= 1 && candidates <= 100000, "candidates", candidates, "1 to 100000");
  require(bins >= 0 && bins <= 10000, "bins", bins, "0 to 10000");
  require(cad_bins >= 0 && cad_bins <= 10000, "cad_bins", cad_bins, "0 to 10000");
  for (const int bin : only_bins) {
    require(bin >= 0 && bin < 10000, "only_bins", bin, "0 to 9999");
    if (std::ranges::count(only_bins, bin) > 1)
      throw InputError("experiments", "only_bins", std::to_string(bin) + " twice", "each once");
  }
  require_words(searches, SEARCHES, "searches");
  require_words(strategies, STRATEGIES, "strategies");
  require(random_draws >= 1 && random_draws <= 100, "random_draws", random_draws, "1 to 100");
  tensor.validate();
  methods.validate();
  scout.validate();
  require(image_scale >= 0.1 && image_scale <= 2, "image_scale", image_scale, "0.1 to 2");
  require(supersampling % 2 == 1 && supersampling >= 1 && supersampling <= 7, "supersampling",
          supersampling, "1, 3, 5 or 7");
}

RenderOptions bin_image_options(const ExperimentSettings& settings) {
  RenderOptions options;
  options.pile = 0.7;
  options.depth.on = settings.depth;
  options.depth.holes = 0.33;
  options.supersampling = settings.supersampling;
  set_camera(options, 640, 480, 760, settings.image_scale);
  return options;
}

RenderOptions single_image_options(const ExperimentSettings& settings, int scene) {
  RenderOptions options = options_of(settings, "single images", scene, MOST_PARTS);
  set_camera(options, 1024, 768, 1200, settings.image_scale);
  return options;
}

RenderOptions image_group_options(const ExperimentSettings& settings, int group) {
  RenderOptions options = options_of(settings, "image groups", group, MOST_PARTS_IN_GROUP);
  options.views = VIEWS_OF_GROUP;
  set_camera(options, 1920, 1200, 2200, settings.image_scale);
  return options;
}

}  // namespace edgescout
