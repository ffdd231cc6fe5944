// Makes the source of images of `edgescout scout`: a rendered cell or recorded views.
#pragma once

#include "host/active/views.h"
#include "host/cli/depth_input.h"
#include "host/cli/inputs.h"
#include "host/cli/option_table.h"
#include "host/cli/scout_report.h"
#include "host/render/simulated_cell.h"

namespace edgescout {

struct SourceRequest {
  std::string source;        // "cell", or a folder (load_recorded_views)
  CameraArguments camera;    // of recorded views
  DatasetArguments dataset;  // of recorded views: at most one camera
  DepthArguments depth;
  ImageOptions images;     // of recorded views
  std::string views_file;  // of a cell, in place of the hemisphere
  RenderOptions scene;     // of a cell
  ArmNoise arm;
  HemisphereOptions hemisphere{.radius_m = 0};  // 0: such that the parts fill the image
  std::vector<double> center_m{0, 0, 0};
  // What the images of a cell and the belief depend on, apart from models and views.
  Settings settings;
};

void add_source_options(CLI::App& verb, SourceRequest& request);

// Checks the options that were given. InputError: options of a cell with recorded views, options of
// the hemisphere with a list of views.
void refuse_unused(const CLI::App& verb);

struct ScoutSource {
  std::unique_ptr<ViewSource> source;
  std::string name;
  Settings settings;              // distinguishes it from other runs with the same views and models
  std::vector<TrueObject> truth;  // of a cell
  std::vector<int> image_ids;     // one per view: BOP's id, else the view's number
  std::vector<std::filesystem::path> image_files;  // one per view; empty for a cell
  int scene_id = 0;
};

// `objects` are placed in a cell. InputError: the source is neither "cell" nor a folder of recorded
// views; a file is given that the other kind of source needs.
ScoutSource make_source(const SourceRequest& request, std::span<const Object> objects,
                        ThreadPool& pool);

}  // namespace edgescout
