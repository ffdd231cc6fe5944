// edgescout render: renders scenes with known poses from CAD models, in BOP's layout.
#include <filesystem>
#include <iostream>

#include "host/cli/common_arguments.h"
#include "host/cli/depth_input.h"
#include "host/cli/exit_codes.h"
#include "host/cli/help.h"
#include "host/cli/progress.h"
#include "host/cli/scene_options.h"
#include "host/cli/verbs.h"
#include "host/io/bop.h"
#include "host/io/folder_lock.h"
#include "host/io/mesh.h"
#include "host/render/parts.h"
#include "host/render/photographs.h"
#include "host/render/write_bop.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

struct RenderRequest {
  std::vector<std::string> models;
  std::string unit;
  std::string models_info;
  std::vector<std::string> parts;
  std::string out;
  int scenes = 1;
  std::vector<std::string> clutter_models;
  std::string backgrounds, board_textures, environments;  // folders of photographs
  RenderOptions options;
};

// Models from files get the ids 1, 2 .. in the order given. The project's own parts have their own
// ids.
std::vector<Object> load_objects(const RenderRequest& request) {
  std::vector<Object> objects;
  if (request.models.empty() == request.parts.empty())
    throw InputError("command line", "--model, --part", request.models.empty() ? "neither" : "both",
                     "one of the two");
  for (const std::string& name : request.parts) objects.push_back(make_part(name));
  if (request.models.empty()) return objects;
  const std::optional<LengthUnit> unit = unit_of(request.unit);
  std::map<int, Symmetries> symmetries;
  if (!request.models_info.empty()) symmetries = load_symmetries(request.models_info);
  for (const std::string& file : request.models) {
    Object object;
    object.id = static_cast<int>(objects.size()) + 1;
    object.mesh = load_mesh(file, unit);
    if (symmetries.contains(object.id)) object.symmetries = symmetries.at(object.id);
    objects.push_back(std::move(object));
  }
  return objects;
}

// Puts the option's name before the error of a file that it gave.
template <typename Load>
auto load_for(const char* option, Load load) {
  try {
    return load();
  } catch (const InputError& error) {
    throw InputError(std::string(option) + ": " + error.what());
  }
}

SceneFiles load_files(const RenderRequest& request) {
  const auto photographs = [](const char* option, const std::string& folder) {
    if (folder.empty()) return PhotographFolders();
    return load_for(option, [&] { return list_photographs(folder); });
  };
  SceneFiles files;
  for (const std::string& file : request.clutter_models)
    files.clutter.push_back(
        load_for("--clutter-model", [&] { return load_mesh(file, LengthUnit::Millimetre); }));
  files.backgrounds = photographs("--backgrounds", request.backgrounds);
  files.board_textures = photographs("--board-texture", request.board_textures);
  files.environments = photographs("--environments", request.environments);
  return files;
}

std::string scene_folder(int scene) {
  const std::string digits = std::to_string(scene);
  return std::string(6 - std::min<std::size_t>(6, digits.size()), '0') + digits;
}

// InputError: an earlier run left scenes or images that the new run does not replace. They would
// look like results of the new run.
void require_no_other_scenes(const RenderRequest& request) {
  std::error_code not_there;
  for (const std::filesystem::directory_entry& entry :
       std::filesystem::directory_iterator(request.out, not_there)) {
    if (!is_bop_scene(entry.path())) continue;
    const BopScene old = load_bop_scene(entry.path());
    const int images = static_cast<int>(old.images.size());
    if (old.scene_id >= request.scenes || images > request.options.views)
      throw InputError(request.out, "output folder",
                       "scene " + entry.path().filename().string() + " of " +
                           std::to_string(images) + " images of an earlier run",
                       "another --out, or at least as many --scenes and --views");
  }
}

void render_scenes(const RenderRequest& request) {
  request.options.validate();
  const std::vector<Object> objects = load_objects(request);
  const SceneFiles files = load_files(request);
  const FolderLock lock(request.out, 2);  // down to SCENE/gray
  require_no_other_scenes(request);
  const std::filesystem::path out = request.out;
  write_bop_models(objects, turning_axes(objects), out / "models");
  ThreadPool pool;
  Progress progress("render", static_cast<std::size_t>(request.scenes), std::cerr,
                    stderr_is_terminal());
  for (int i = 0; i < request.scenes; ++i) {
    RenderOptions options = request.options;
    options.seed += static_cast<unsigned>(i);
    const SimulatedScene scene = make_scene(objects, options, files);
    write_bop_scene(scene, render(scene, pool), out / scene_folder(i));
    progress.step();
  }
  std::cout << "wrote " << request.scenes << " scenes of " << request.options.views << " views to "
            << out.string() << "\n";
}

void add_camera_options(CLI::App& verb, RenderOptions& o) {
  OptionTable(verb, "Cameras")
      .bounded("views", o.views, 1, 50, "Number of images of a scene, from around it")
      .level(OptionLevel::Expert)
      .bounded("min-elevation", o.min_elevation_deg, 10.0, 90.0,
               "Lowest elevation of the cameras over the board, degrees")
      .bounded("max-elevation", o.max_elevation_deg, 10.0, 90.0,
               "Highest elevation of the cameras over the board, degrees")
      .bounded("min-distance", o.min_distance_m, 0.0, 100.0,
               "Smallest distance from the cameras to the middle of the parts, m. 0: so that they "
               "fill the image")
      .bounded("max-distance", o.max_distance_m, 0.0, 100.0,
               "Largest distance from the cameras to the middle of the parts, m. 0: so that they "
               "fill the image");
}

// Files and folders that scenes take things from.
void add_file_options(CLI::App& verb, RenderRequest& request) {
  const auto add = [&](const char* name, auto& field, const char* type, const char* help) {
    CLI::Option* option = verb.add_option(name, field, help)->type_name(type);
    option->group("Files of scenes");
    mark_expert(verb, option);
  };
  add("--clutter-model", request.clutter_models, "FILE",
      "CAD files of foreign parts, in place of boxes, bars and rings. Their unit does not matter");
  add("--backgrounds", request.backgrounds, "DIR",
      "Folder of photographs that stand behind board and parts");
  add("--board-texture", request.board_textures, "DIR",
      "Folder of photographs that are printed on the board");
  add("--environments", request.environments, "DIR",
      "Folder of photographs that metal and gloss reflect. Without it: a room with lamps");
}

}  // namespace

void add_render(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "render", "Render scenes with known poses from CAD models, in BOP's layout");
  auto request = std::make_shared<RenderRequest>();
  verb->add_option("--model", request->models, "CAD files of the parts: " + MESH_FORMATS)
      ->type_name("FILE");
  verb->add_option("--unit", request->unit, UNIT_HELP);
  verb->add_option("--models-info", request->models_info,
                   "BOP models_info.json with symmetries. Id 1 is the first --model")
      ->type_name("FILE");
  verb->add_option("--part", request->parts,
                   "The project's own parts, in place of --model: l_bracket, bearing_block, "
                   "stepped_shaft, hex_nut, u_channel, gear_plate");
  verb->add_option("--out", request->out, "Folder of the dataset")->required()->type_name("DIR");
  OptionTable(*verb, "Scene")
      .bounded("scenes", request->scenes, 1, 100000, "Number of scenes, in folders from 000000");
  add_scene_options(*verb, request->options, OptionLevel::Basic);
  add_camera_options(*verb, request->options);
  add_file_options(*verb, *request);
  CommandLineOptions ranges(*verb);
  describe(request->options.clutter_ranges, ranges);
  describe(request->options.surfaces, ranges);
  describe(request->options.light, ranges);
  describe(request->options.camera, ranges);
  describe(request->options.depth, ranges);
  verb->callback([request, verb, &exit_code] {
    refuse_options_without_depth(*verb);
    render_scenes(*request);
    exit_code = exit_done;
  });
}

}  // namespace edgescout
