// Loads the models to detect: from mesh files, or as templates that were built before.
#pragma once

#include <CLI/CLI.hpp>

#include "host/cli/inputs.h"
#include "host/cli/template_origin.h"
#include "host/detect/world_prior.h"
#include "host/model/template_set.h"

namespace edgescout {

class Backend;

// --model, --unit, --models-info, --object-id, --symmetry, --templates and those of the template
// cache.
void add_model_arguments(CLI::App& verb, ModelArguments& arguments);

// InputError: --templates was given with an option for reading models or building templates. A
// template file already has these properties.
void refuse_beside_templates(const CLI::App& verb);

// Gives the sets of the files the symmetries of --symmetry. InputError as symmetry_arguments.h.
void state_symmetries(std::span<TemplateSet> sets, const ModelArguments& arguments);

struct KnownModels {
  std::vector<Object> objects;          // from meshes: templates must be built
  std::vector<TemplateSet> sets;        // from template files
  std::vector<TemplateOrigin> origins;  // of the sets
};

// InputError: neither meshes nor templates, or both; a file that cannot be read; an id given twice.
KnownModels load_models(const ModelArguments& arguments);

// The images that are searched, as far as the distances depend on them.
struct SearchedImages {
  Camera camera;
  WorldPrior prior;
  std::vector<Se3> camera_from_world;  // of all images; not read without a prior
};

// InputError naming the first image without a world pose, if a prior is given.
SearchedImages searched_images(std::span<const InputImage> images, const Camera& camera,
                               const WorldPrior& prior);

// From the nearest to the farthest distance at which an object is searched. Distances left at 0:
// with_distances_to_box, without a box with_default_distances.
DistanceRange searched_distances(const KnownModels& known, const TemplateOptions& options,
                                 const SearchedImages& images);

struct LoadedTemplates {
  std::vector<TemplateSet> sets;
  std::vector<TemplateOrigin> origins;  // of each set
};

// Reads the missing templates from the cache or builds them, and shows the progress on standard
// error. Logs the size of every object, the range of its distances and where its templates come
// from, and warns of meshes with defects. Distances left at 0: as searched_distances. Cancelled
// (active/scout.h): `cancelled`, which is asked between views, returned true.
LoadedTemplates template_sets_of(const KnownModels& known, const TemplateOptions& options,
                                 const SearchedImages& images, Backend& backend,
                                 TemplateCache cache, const std::function<bool()>& cancelled = {});

}  // namespace edgescout
