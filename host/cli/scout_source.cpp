#include "host/cli/scout_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>

#include "host/active/recorded_views.h"
#include "host/cli/batch_settings.h"
#include "host/cli/common_arguments.h"
#include "host/cli/help.h"
#include "host/cli/scene_options.h"
#include "host/io/bop.h"
#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

std::vector<Se3> cell_views(const SourceRequest& request, const SimulatedScene& scene) {
  if (!request.views_file.empty()) return load_views(request.views_file);
  if (request.center_m.size() != 3)
    throw InputError("command line", "--center",
                     std::to_string(request.center_m.size()) + " numbers", "3");
  HemisphereOptions hemisphere = request.hemisphere;
  hemisphere.center_m = {request.center_m[0], request.center_m[1], request.center_m[2]};
  if (hemisphere.radius_m == 0)
    hemisphere.radius_m = inverse(scene.views[0].camera_from_world).translation_m.norm();
  return hemisphere_views(hemisphere);
}

// `--depth scene` switches the sensor on.
DepthSensor cell_sensor(const SourceRequest& request) {
  DepthSensor sensor = request.scene.depth;
  const DepthArguments& depth = request.depth;
  if (!depth.from.empty() && depth.from != DEPTH_OF_SCENES)
    throw InputError("command line", "--depth", depth.from + " for a cell", DEPTH_OF_SCENES);
  if (!depth.camera.empty() || !depth.pose.empty())
    throw InputError("command line", depth.camera.empty() ? "--depth-pose" : "--depth-camera",
                     "one for a cell", "none");
  if (depth.options.unit_m > 0)
    throw InputError("command line", "--depth-unit", "one for a cell", "none");
  sensor.on = !depth.from.empty();
  sensor.range_m = depth.options.range_m;
  sensor.noise_m = depth.options.noise.at_one_metre_m;
  sensor.noise_floor_m = depth.options.noise.floor_m;
  return sensor;
}

ScoutSource make_cell(const SourceRequest& request, std::span<const Object> objects,
                      ThreadPool& pool) {
  if (!request.camera.file.empty())
    throw InputError("command line", "--camera", "one for a cell", "--width, --height and --focal");
  RenderOptions options = request.scene;
  options.depth = cell_sensor(request);
  options.min_distance_m = options.max_distance_m = request.hemisphere.radius_m;
  const SimulatedScene scene = make_scene(objects, options);
  ArmNoise arm = request.arm;
  arm.seed = options.seed;
  ScoutSource made;
  made.name = "a rendered cell of " + std::to_string(options.objects) + " parts, seed " +
              std::to_string(options.seed);
  made.settings = request.settings;
  made.settings.emplace_back("source", "cell");
  made.settings.emplace_back("radius",
                             fmt::format("{}", request.hemisphere.radius_m));  // sizes the board
  for (const PlacedObject& placed : scene.placed)
    if (placed.target) made.truth.push_back({placed.object, placed.world_from_object});
  made.source = std::make_unique<SimulatedCell>(scene, scene.views[0].camera,
                                                cell_views(request, scene), arm, pool);
  return made;
}

// Returns a BOP scene in the folders of a dataset, or in the folders of its splits; empty if there
// is none.
std::filesystem::path scene_below(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code unreadable;
  for (fs::recursive_directory_iterator entry(folder, unreadable), end; !unreadable && entry != end;
       entry.increment(unreadable)) {
    if (is_bop_scene(entry->path())) return entry->path();
    if (entry.depth() >= 1) entry.disable_recursion_pending();
  }
  return {};
}

// What the images' camera depends on.
std::string text_of(const CameraArguments& camera) {
  std::string text = checksum_text(read_file(camera.file));
  if (!camera.name.empty()) text += ", " + camera.name;
  if (camera.field_of_view_deg > 0) text += fmt::format(", {} degrees", camera.field_of_view_deg);
  return text;
}

// A scout has one camera.
std::string camera_of(const SourceRequest& request) {
  const std::vector<std::string>& chosen = request.dataset.cameras;
  if (chosen.size() == 1) return chosen[0];
  const std::vector<std::string> there = bop_cameras(request.source);
  const bool has_own = there.empty() || there[0].empty();
  if (chosen.size() > 1 || (!has_own && there.size() > 1))
    throw InputError("command line", "--cameras", std::to_string(chosen.size()) + " names",
                     fmt::format("one of {}", fmt::join(there, ", ")));
  return "";
}

// Recorded views with the depth images that belong to them.
class ViewsWithDepth : public ViewSource {
 public:
  // `images`: one per view.
  ViewsWithDepth(RecordedViews views, std::vector<InputImage> images,
                 const DepthArguments& arguments, ThreadPool& pool)
      : views_(std::move(views)), images_(std::move(images)), reader_(arguments), pool_(pool) {}
  Camera camera() const override { return views_.camera(); }
  std::vector<Se3> views() const override { return views_.views(); }
  Shot acquire(int view) override {
    Shot shot = views_.acquire(view);
    try {
      shot.depth = reader_.read(images_[static_cast<std::size_t>(view)], camera(), pool_);
    } catch (const InputError& error) {
      throw AcquisitionError(error.what());
    }
    return shot;
  }

 private:
  RecordedViews views_;
  std::vector<InputImage> images_;
  DepthReader reader_;
  ThreadPool& pool_;
};

std::unique_ptr<ViewSource> with_depth(RecordedViews views, std::span<const BopImage> of_scene,
                                       const DepthArguments& arguments, ThreadPool& pool) {
  if (arguments.from.empty()) return std::make_unique<RecordedViews>(std::move(views));
  std::vector<InputImage> images;
  for (const RecordedViews::Recording& recording : views.recordings())
    images.emplace_back().file = recording.file;
  for (std::size_t i = 0; i < of_scene.size(); ++i) {
    images[i].scene_folder = of_scene[i].file.parent_path().parent_path();
    images[i].depth = depth_file_of(of_scene[i]);
  }
  find_depth(images, arguments);
  return std::make_unique<ViewsWithDepth>(std::move(views), std::move(images), arguments, pool);
}

ScoutSource make_recorded(const SourceRequest& request, ThreadPool& pool) {
  request.images.validate();
  if (!request.views_file.empty())
    throw InputError("command line", "--views", "a list for recorded views", "their own poses");
  if (!std::filesystem::is_directory(request.source))
    throw InputError(request.source, "source", "no folder",
                     "\"cell\" or a folder of recorded views");
  if (!is_bop_scene(request.source) &&
      !std::filesystem::exists(std::filesystem::path(request.source) / "CameraPose"))
    if (const std::filesystem::path scene = scene_below(request.source); !scene.empty())
      throw InputError(request.source, "source", "a folder of BOP scenes",
                       "one of them, such as " + scene.string());
  std::optional<Camera> camera;
  if (!request.camera.file.empty()) camera = given_camera(request.camera, {});
  if (!camera && request.camera.field_of_view_deg > 0)
    throw InputError("command line", "--field-of-view", "it without --camera", "--camera FILE");
  ScoutSource made;
  const std::filesystem::path folder = std::filesystem::canonical(request.source);
  made.name = folder.filename().string();
  made.settings = request.settings;
  made.settings.emplace_back("source", folder.string());
  made.settings.emplace_back("camera",
                             request.camera.file.empty() ? "its own" : text_of(request.camera));
  const std::string camera_name = camera_of(request);
  if (!camera_name.empty()) made.settings.emplace_back("camera's name", camera_name);
  RecordedViews views = load_recorded_views(request.source, camera, camera_name, request.images);
  for (const RecordedViews::Recording& recording : views.recordings())
    made.image_files.push_back(recording.file);
  BopScene scene;
  if (is_bop_scene(request.source)) scene = load_bop_images(request.source, camera_name);
  made.source = with_depth(std::move(views), scene.images, request.depth, pool);
  made.scene_id = scene.scene_id;
  for (const BopImage& image : scene.images) made.image_ids.push_back(image.image_id);
  return made;
}

}  // namespace

namespace {

void add_hemisphere_options(CLI::App& verb, SourceRequest& r) {
  verb.add_option("--views", r.views_file,
                  "Views of a cell, in place of the hemisphere: [{camera_from_world: {R, t}} ..]")
      ->type_name("FILE")
      ->group("Views");
  OptionTable(verb, "Views")
      .bounded("view-count", r.hemisphere.count, 1, 10000, "Number of views on the hemisphere")
      .level(OptionLevel::Expert)
      .bounded("radius", r.hemisphere.radius_m, 0.0, 100.0,
               "Radius of the hemisphere of views, m. 0: so that the parts fill the image");
  CLI::Option* elevations =
      verb.add_option("--elevations", r.hemisphere.elevations_deg,
                      "Elevations of the hemisphere's rings of views above the board, degrees");
  elevations->capture_default_str()->group("Views");
  mark_expert(verb, elevations);
  CommandLineOptions(verb, "Views")
      .numbers({"center", "Middle of the hemisphere of views, m: x y z"}, r.center_m, 3, -100, 100);
}

}  // namespace

void add_source_options(CLI::App& verb, SourceRequest& r) {
  verb.add_option("source", r.source,
                  "\"cell\": a rendered scene of the models. Else a folder of recorded views: a "
                  "BOP scene, or a folder with CameraPose and Images")
      ->required();
  add_camera(verb, r.camera);
  add_camera_names(verb, r.dataset);
  add_depth(verb, r.depth);
  CommandLineOptions sensor(verb);
  describe_errors(r.scene.depth, sensor);
  describe(r.images, sensor);
  add_hemisphere_options(verb, r);
  add_scene_options(verb, r.scene, OptionLevel::Expert);
  OptionTable(verb, "Arm", OptionLevel::Expert)
      .bounded("arm-shift", r.arm.translation_m, 0.0, 1.0,
               "Error of a cell's arm in position, standard deviation along each axis, m")
      .bounded("arm-turn", r.arm.rotation_rad, 0.0, 1.0,
               "Error of a cell's arm in rotation, standard deviation about each axis, rad")
      .flag("arm-tells", r.arm.known, "The encoders of a cell's arm report its real pose");
}

void refuse_unused(const CLI::App& verb) {
  const bool is_cell = verb["source"]->as<std::string>() == "cell",
             has_list = verb.count("--views") > 0;
  for (const CLI::Option* option : verb.get_options()) {
    const std::string &name = option->get_name(), &group = option->get_group();
    if (option->count() == 0 || name == "--views") continue;
    if (!is_cell && (group == "Scene" || group == "Image" || group == "Arm" || group == "Views" ||
                     group == "Depth sensor"))
      throw InputError("command line", name, "together with recorded views", "it with a cell");
    if (is_cell && group == "Images")
      throw InputError("command line", name, "together with a cell", "it with recorded views");
    if (has_list && group == "Views" && name != "--radius")  // which sizes the board as well
      throw InputError("command line", name, "together with --views", "one of the two");
  }
}

ScoutSource make_source(const SourceRequest& request, std::span<const Object> objects,
                        ThreadPool& pool) {
  ScoutSource made =
      request.source == "cell" ? make_cell(request, objects, pool) : make_recorded(request, pool);
  if (made.image_ids.empty()) {
    made.image_ids.resize(made.source->views().size());
    std::iota(made.image_ids.begin(), made.image_ids.end(), 0);
  }
  return made;
}

}  // namespace edgescout
