#include "host/cli/template_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <optional>

#include "host/active/scout.h"
#include "host/cli/common_arguments.h"
#include "host/cli/progress.h"
#include "host/cli/symmetry_arguments.h"
#include "host/core/log.h"
#include "host/core/option_names.h"
#include "host/core/stopwatch.h"
#include "host/detect/searched_sizes.h"
#include "host/model/mesh_quality.h"
#include "kernels/backend.h"
#include "kernels/error.h"

namespace edgescout {

void add_model_arguments(CLI::App& verb, ModelArguments& arguments) {
  verb.add_option("--model", arguments.models,
                  "CAD files of the objects to detect: " + MESH_FORMATS)
      ->type_name("FILE");
  verb.add_option("--unit", arguments.unit, UNIT_HELP);
  verb.add_option("--models-info", arguments.models_info, "BOP models_info.json with symmetries")
      ->type_name("FILE");
  verb.add_option("--object-id", arguments.object_ids,
                  "BOP ids of the models; default: the number at the end of their names");
  add_symmetry(verb, arguments.symmetry);
  verb.add_option("--templates", arguments.templates,
                  "Template files of `edgescout model build`, in place of --model")
      ->type_name("FILE");
  add_template_cache_arguments(verb, arguments.cache);
}

void refuse_beside_templates(const CLI::App& verb) {
  if (verb.count("--templates") == 0) return;
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_name();
    const bool is_of_models = name == "--unit" || name == "--models-info" || name == "--object-id";
    if (option->count() > 0 && (is_of_models || option->get_group() == "Templates"))
      throw InputError("command line", name, "together with --templates",
                       "it with --model: a template file has its own");
  }
}

void state_symmetries(std::span<TemplateSet> sets, const ModelArguments& arguments) {
  std::vector<int> ids;
  for (const TemplateSet& set : sets) ids.push_back(set.object_id);
  const StatedSymmetries stated(arguments.symmetry, ids);
  for (std::size_t i = 0; i < sets.size(); ++i)
    if (const auto own = stated.of(ids[i], sets[i].model.mesh, DETECTION_SYMMETRY_STEPS))
      replace_symmetries(sets[i], *own, arguments.templates[i]);
}

KnownModels load_models(const ModelArguments& arguments) {
  if (arguments.models.empty() == arguments.templates.empty())
    throw InputError("command line", "--model, --templates",
                     arguments.models.empty() ? "neither" : "both", "one of the two");
  KnownModels known;
  for (const std::string& file : arguments.templates) {
    const auto start = std::chrono::steady_clock::now();
    known.sets.push_back(load_templates(file));
    known.origins.push_back({known.sets.back().object_id, "file", seconds_since(start)});
    for (std::size_t i = 0; i + 1 < known.sets.size(); ++i)
      if (known.sets[i].object_id == known.sets.back().object_id)
        throw InputError(file, "object id", fmt::format("{} twice", known.sets[i].object_id),
                         "ids that differ: give model build --object-id");
  }
  if (known.sets.empty())
    known.objects = load_objects(arguments);
  else
    state_symmetries(known.sets, arguments);
  return known;
}

namespace {

// A wrong unit or distance shows in these numbers: they do not fit each other.
void log_sizes(const TemplateSet& set, const TemplateOrigin& origin, const Camera& camera) {
  const SearchedSizes sizes = searched_sizes(set.model.mesh.diameter_m, set.options, camera);
  log(LogLevel::Info,
      fmt::format(
          "object {} ({}): diameter {:.1f} mm, searched {:.3f} to {:.3f} m from the camera, "
          "{:.0f} to {:.0f} px in the image, templates {} in {:.2f} s",
          set.object_id, set.model.mesh.name, 1000 * set.model.mesh.diameter_m,
          set.options.distance_min_m, set.options.distance_max_m, sizes.largest_px,
          sizes.smallest_px, origin.source == "built" ? "built" : "read from the " + origin.source,
          origin.seconds));
}

void check_size(const Mesh& mesh, const TemplateOptions& options, const Camera& camera) {
  require_searchable_size(mesh.name, mesh.diameter_m, options, camera);
  if (const std::string warning = size_warning(mesh.name, mesh.diameter_m, options, camera);
      !warning.empty())
    log(LogLevel::Warning, warning);
}

TemplateOptions with_distances(const TemplateOptions& options, double diameter_m,
                               const SearchedImages& images) {
  return with_default_distances(with_distances_to_box(options, diameter_m, images.camera,
                                                      images.prior, images.camera_from_world),
                                diameter_m, images.camera);
}

// The progress is shown from the first views on: templates that are read have none.
CachedTemplates templates_of(const Object& object, const TemplateOptions& options, Backend& backend,
                             TemplateCache& cache, const std::function<bool()>& cancelled) {
  std::optional<Progress> progress;
  return cache.get(object, options, backend, [&](int done, int all) {
    if (cancelled && cancelled()) throw Cancelled();
    if (!progress)
      progress.emplace("templates of " + object.mesh.name, 100, std::cerr, stderr_is_terminal());
    progress->move_to(100 * done / all);
  });
}

// Objects lie above the plane, and cameras look at them from there.
void warn_of_plane(const SearchedImages& searched) {
  if (searched.prior.plane.empty()) return;
  const auto height_m = [&](const Se3& camera_from_world) {
    return searched.prior.lowest_plane().signedDistance(
        (searched.prior.prior_from_world * inverse(camera_from_world)).translation_m);
  };
  double highest_m = -INFINITY;
  for (const Se3& pose : searched.camera_from_world)
    highest_m = std::max(highest_m, height_m(pose));
  if (highest_m < 0)
    log(LogLevel::Warning,
        fmt::format("{}: found all cameras below it, by {:.4g} m and more, expected one above: nx "
                    "ny nz d, m, with the normal towards the objects",
                    option_name("world-plane"), -highest_m));
}

}  // namespace

SearchedImages searched_images(std::span<const InputImage> images, const Camera& camera,
                               const WorldPrior& prior) {
  SearchedImages searched{camera, prior, {}};
  if (!prior.is_given()) return searched;
  for (const InputImage& image : images) {
    if (!image.camera_from_world)
      throw InputError(image.file.string(), "world pose", "none",
                       "cam_R_w2c and cam_t_w2c of every image with --world-box or --world-plane");
    searched.camera_from_world.push_back(*image.camera_from_world);
  }
  warn_of_plane(searched);
  return searched;
}

DistanceRange searched_distances(const KnownModels& known, const TemplateOptions& options,
                                 const SearchedImages& images) {
  DistanceRange range{INFINITY, 0};
  const auto include = [&range](const TemplateOptions& of_object) {
    range.min_m = std::min(range.min_m, of_object.distance_min_m);
    range.max_m = std::max(range.max_m, of_object.distance_max_m);
  };
  for (const TemplateSet& set : known.sets) include(set.options);
  for (const Object& object : known.objects)
    include(with_distances(options, object.mesh.diameter_m, images));
  return range;
}

LoadedTemplates template_sets_of(const KnownModels& known, const TemplateOptions& options,
                                 const SearchedImages& images, Backend& backend,
                                 TemplateCache cache, const std::function<bool()>& cancelled) {
  const Camera& camera = images.camera;
  LoadedTemplates loaded{known.sets, known.origins};
  for (const TemplateSet& set : known.sets) check_size(set.model.mesh, set.options, camera);
  for (const Object& object : known.objects)
    check_size(object.mesh, with_distances(options, object.mesh.diameter_m, images), camera);
  for (const Object& object : known.objects) {
    CachedTemplates found = templates_of(
        object, with_distances(options, object.mesh.diameter_m, images), backend, cache, cancelled);
    loaded.origins.push_back({object.id, found.are_cached ? "cache" : "built", found.seconds});
    loaded.sets.push_back(std::move(found.set));
  }
  for (std::size_t i = 0; i < loaded.sets.size(); ++i) {
    log_sizes(loaded.sets[i], loaded.origins[i], camera);
    warn_of_mesh(loaded.sets[i].model);
  }
  return loaded;
}

}  // namespace edgescout
