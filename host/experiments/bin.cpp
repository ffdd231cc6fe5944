#include "host/experiments/bin.h"

#include "host/core/random.h"
#include "host/render/renderer.h"

namespace edgescout {

namespace {

constexpr double LEAST_USEFUL = 0.3;  // visible fraction

RenderOptions options_of(const ExperimentSettings& settings, int number, Random& random) {
  RenderOptions options = bin_image_options(settings);
  options.seed = 1000 * settings.seed + static_cast<unsigned>(number);
  options.objects = FEWEST_PARTS_OF_BIN + random.below(MOST_PARTS_OF_BIN - FEWEST_PARTS_OF_BIN + 1);
  options.min_distance_m = options.max_distance_m = bin_views().radius_m;
  return options;
}

}  // namespace

Shot RenderedCell::acquire(int view) {
  auto known = shots_.find(view);
  if (known == shots_.end()) known = shots_.emplace(view, cell_.acquire(view)).first;
  return known->second;
}

const std::vector<double>& RenderedCell::visible(int view) {
  auto known = visible_.find(view);
  if (known == visible_.end()) {
    SimulatedScene scene = scene_;
    scene.views = {{camera(), views()[static_cast<std::size_t>(view)]}};
    scene.options.supersampling = 1;  // only the truth at the pixel centres is needed, no image
    scene.lights.clear();
    known = visible_.emplace(view, render(scene, pool_)[0].visible_fraction).first;
  }
  return known->second;
}

HemisphereOptions bin_views() { return {}; }

std::vector<int> fixed_sequence(const Bin& bin) {
  constexpr int stride = 13;
  const int views = static_cast<int>(bin.cell->views().size());
  std::vector<int> sequence;
  for (int i = 0; i < views; ++i) sequence.push_back((bin.first_view + i * stride) % views);
  return sequence;
}

std::vector<int> clairvoyant_sequence(const Bin& bin, std::span<const BinInstance> targets,
                                      int views) {
  const int all = static_cast<int>(bin.cell->views().size());
  std::vector<double> shown(targets.size(), 0);  // by the images so far
  const auto with = [&](int view, std::size_t i) {
    const double visible = bin.cell->visible(view)[targets[i].placed];
    return std::min(1.0, shown[i] + std::max(0.0, visible - LEAST_USEFUL));
  };
  std::vector<int> sequence;
  const auto take = [&](int view) {
    for (std::size_t i = 0; i < targets.size(); ++i) shown[i] = with(view, i);
    sequence.push_back(view);
  };
  take(bin.first_view);
  while (static_cast<int>(sequence.size()) < std::min(views, all)) {
    int best = -1;
    double most = -1;
    for (int view = 0; view < all; ++view) {
      if (std::ranges::count(sequence, view) > 0) continue;
      double sum = 0;
      for (std::size_t i = 0; i < targets.size(); ++i) sum += with(view, i);
      if (sum > most) best = view, most = sum;
    }
    take(best);
  }
  return sequence;
}

Bin make_bin(std::span<const Object> types, const ExperimentSettings& settings, int number,
             ThreadPool& pool) {
  Random random = Random(settings.seed).split("bin").split(static_cast<std::uint64_t>(number));
  const RenderOptions options = options_of(settings, number, random);
  const std::vector<Se3> views = hemisphere_views(bin_views());
  Bin bin;
  bin.number = number;
  bin.parts = options.objects;
  bin.first_view = random.below(static_cast<int>(views.size()));
  const SimulatedScene scene = make_scene(types, options);
  bin.cell = std::make_unique<RenderedCell>(scene, views, pool);
  const std::vector<double>& visible = bin.cell->visible(bin.first_view);
  for (std::size_t i = 0; i < scene.placed.size(); ++i)
    if (const PlacedObject& placed = scene.placed[i]; placed.target)
      bin.instances.push_back({placed.object, placed.world_from_object, visible[i], visible[i], i});
  return bin;
}

}  // namespace edgescout
