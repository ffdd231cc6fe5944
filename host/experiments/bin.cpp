#include "host/experiments/bin.h"

#include "host/core/random.h"
#include "host/render/parts.h"
#include "host/render/renderer.h"

namespace edgescout {

namespace {

RenderOptions options_of(const ExperimentSettings& settings, int number, Random& random) {
  RenderOptions options = bin_image_options(settings);
  options.seed = 1000 * settings.seed + static_cast<unsigned>(number);
  options.objects = FEWEST_PARTS_OF_BIN + random.below(MOST_PARTS_OF_BIN - FEWEST_PARTS_OF_BIN + 1);
  options.min_distance_m = options.max_distance_m = bin_views().radius_m;
  return options;
}

// How much of every placed object shows from a view.
std::vector<double> visible_from(Scene scene, const Camera& camera, const Se3& camera_from_world,
                                 ThreadPool& pool) {
  scene.views = {{camera, camera_from_world}};
  scene.options.supersampling = 1;  // the truth at the pixels' centres alone
  return render(scene, pool)[0].visible_fraction;
}

}  // namespace

Shot BinCell::acquire(int view) {
  auto known = shots_.find(view);
  if (known == shots_.end()) known = shots_.emplace(view, cell_.acquire(view)).first;
  return known->second;
}

HemisphereOptions bin_views() { return {}; }

const std::vector<Object>& bin_types() {
  static const std::vector<Object> parts{make_part("l_bracket"), make_part("bearing_block"),
                                         make_part("u_channel")};
  return parts;
}

std::vector<TemplateSet> bin_templates(Backend& backend) {
  TemplateOptions options;
  options.distance_min_m = bin_views().radius_m - BIN_DEPTH_MARGIN_M;
  options.distance_max_m = bin_views().radius_m + BIN_DEPTH_MARGIN_M;
  std::vector<TemplateSet> sets;
  for (const Object& type : bin_types()) sets.push_back(build_templates(type, options, backend));
  return sets;
}

std::vector<int> fixed_sequence(const Bin& bin) {
  constexpr int stride = 13;
  const int views = bin_views().count;
  std::vector<int> sequence;
  for (int i = 0; i < views; ++i) sequence.push_back((bin.first_view + i * stride) % views);
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
  const Scene scene = make_scene(types, options);
  bin.cell = std::make_unique<BinCell>(scene, views, pool);
  const std::vector<double> visible =
      visible_from(scene, bin.cell->camera(), views[static_cast<std::size_t>(bin.first_view)], pool);
  for (std::size_t i = 0; i < scene.placed.size(); ++i)
    if (const PlacedObject& placed = scene.placed[i]; placed.target)
      bin.instances.push_back({placed.object, placed.world_from_object, visible[i]});
  return bin;
}

}  // namespace edgescout
