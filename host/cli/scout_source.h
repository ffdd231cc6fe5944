// Where `edgescout scout` takes its images: a rendered cell or views recorded before.
#pragma once

#include "host/active/source.h"
#include "host/active/views.h"
#include "host/cli/config.h"
#include "host/cli/scout_report.h"

namespace edgescout {

struct SourceRequest {
  std::string source;       // "cell", or a folder (load_recorded_views)
  std::string camera_file;  // of recorded views
  std::string views_file;   // of a cell, in place of the hemisphere
  RenderOptions scene;      // of a cell
  ArmNoise arm;
  HemisphereOptions hemisphere;  // radius 0: so that the parts fill the image
  std::vector<double> center_m{0, 0, 0};
  Settings settings;  // what a cell's images, and the belief, depend on beside models and views
};

void add_source_options(CLI::App& verb, SourceRequest& request);

// Of what was given on the command line. InputError: options of a cell with recorded views, of the
// hemisphere with a list of views.
void refuse_unused(const CLI::App& verb);

struct ScoutSource {
  std::unique_ptr<ViewSource> source;
  std::string name;
  Settings settings;              // what tells it from other runs with the same views and models
  std::vector<TrueObject> truth;  // of a cell
  std::vector<int> image_ids;     // one a view: BOP's, else its number
  std::vector<std::filesystem::path>
      image_files;  // one a view; empty in a cell, whose images have none
  int scene_id = 0;
};

// `objects` lie in a cell. InputError: neither "cell" nor a folder of recorded views, a file of the
// one with the other.
ScoutSource make_source(const SourceRequest& request, std::span<const Object> objects,
                        ThreadPool& pool);

}  // namespace edgescout
