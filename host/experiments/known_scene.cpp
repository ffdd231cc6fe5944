#include "host/experiments/known_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>

#include "host/detect/tensors.h"
#include "host/edge/edges.h"
#include "host/io/bop.h"
#include "host/io/image.h"
#include "host/io/mesh.h"
#include "host/render/parts.h"
#include "host/render/renderer.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

// Samples of the symmetry of a turned part, as many as the BOP toolkit evaluates: a pose is at most
// 0.01 rad from a sample.
constexpr int TURNS = 315;

// Size of the smallest instance in an image. The coarse tensor must resolve it.
double smallest_size_px(const KnownScene& scene, const KnownImage& view) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const KnownInstance& instance : scene.instances) {
    const double depth_m = (view.camera_from_world * instance.world_from_object).translation_m.z();
    if (depth_m > 0)
      smallest = std::min(
          smallest, view.camera.fx * scene.objects[instance.object].mesh.diameter_m / depth_m);
  }
  return std::min<double>(smallest, std::max(view.camera.width, view.camera.height));
}

Object load_bop_object(const fs::path& models, int id) {
  Object object;
  object.id = id;
  object.mesh = load_mesh(models / fmt::format("obj_{:06}.ply", id), LengthUnit::Millimetre);
  if (const fs::path info = models / "models_info.json"; fs::exists(info)) {
    const std::map<int, Symmetries> symmetries = load_symmetries(info);
    if (symmetries.contains(id)) object.symmetries = symmetries.at(id);
  }
  return object;
}

const BopImage& image_of(const BopScene& scene, int id) {
  const auto image = std::ranges::find(scene.images, id, &BopImage::image_id);
  if (image == scene.images.end())
    throw InputError((scene.folder / "scene_camera.json").string(), std::to_string(id), "no entry",
                     "this image");
  return *image;
}

}  // namespace

std::vector<Object> rendered_types() {
  std::vector<Object> types;
  for (const char* name :
       {"bearing_block", "l_bracket", "u_channel", "gear_plate", "stepped_shaft"})
    types.push_back(make_part(name));
  for (const auto& [id, axis] : turning_axes(types)) {
    Symmetries& symmetries = std::ranges::find(types, id, &Object::id)->symmetries;
    symmetries.discrete.clear();
    for (int step = 0; step < TURNS; ++step)
      symmetries.discrete.push_back(
          {so3_exp(2 * std::numbers::pi * step / TURNS * axis), {0, 0, 0}});
  }
  return types;
}

KnownScene rendered_scene(const std::string& name, const std::vector<Object>& types,
                          const RenderOptions& options, ThreadPool& pool) {
  KnownScene known;
  known.set = "rendered";
  known.name = name;
  known.objects = types;
  const SimulatedScene scene = make_scene(known.objects, options);
  const std::vector<Rendering> renderings = render(scene, pool);
  for (std::size_t v = 0; v < scene.views.size(); ++v)
    known.images.push_back(
        {renderings[v].image, scene.views[v].camera, scene.views[v].camera_from_world});
  for (std::size_t i = 0; i < scene.placed.size(); ++i)
    if (const PlacedObject& placed = scene.placed[i]; placed.target)
      known.instances.push_back({fmt::format("{}_{}", known.objects[placed.object].mesh.name, i),
                                 placed.object, placed.world_from_object,
                                 renderings[0].visible_fraction[i]});
  std::erase_if(known.instances,
                [](const KnownInstance& instance) { return instance.visible < LEAST_VISIBLE; });
  return known;
}

KnownScene bop_scene(const std::string& set, const fs::path& scene_folder, const fs::path& models,
                     const std::vector<int>& image_ids) {
  const BopScene scene = load_bop_scene(scene_folder);
  KnownScene known;
  known.set = set;
  known.name = fmt::format("{}_{:06}", scene_folder.filename().string(), image_ids.front());
  const Se3 first_from_world = image_of(scene, image_ids.front()).camera_from_world.value_or(Se3{});
  for (const int id : image_ids) {
    const BopImage& entry = image_of(scene, id);
    if (image_ids.size() > 1 && !entry.camera_from_world)
      throw InputError((scene_folder / "scene_camera.json").string(), std::to_string(id),
                       "no cam_R_w2c", "the camera's pose in every image of several");
    const Image image = load_image(entry.file);
    Camera camera = entry.camera;
    camera.width = image.width;
    camera.height = image.height;
    known.images.push_back(
        {undistort(image, camera), undistorted(camera), entry.camera_from_world.value_or(Se3{})});
  }
  if (!scene.truth.contains(image_ids.front()))
    throw InputError((scene_folder / "scene_gt.json").string(), std::to_string(image_ids.front()),
                     "no entry", "the poses in this image");
  std::map<int, int> index_of;
  for (const BopTruth& truth : scene.truth.at(image_ids.front())) {
    const auto [index, is_new] =
        index_of.emplace(truth.object_id, static_cast<int>(known.objects.size()));
    if (is_new) known.objects.push_back(load_bop_object(models, truth.object_id));
    if (truth.visible_fraction < LEAST_VISIBLE) continue;
    known.instances.push_back({fmt::format("{}_{}", truth.object_id, known.instances.size()),
                               index->second, inverse(first_from_world) * truth.camera_from_object,
                               truth.visible_fraction});
  }
  return known;
}

SceneEdges edges_of(const KnownScene& scene, Backend& backend, EdgeMethod method) {
  EdgesOptions options;
  options.method = method;
  SceneEdges edges;
  for (const KnownImage& view : scene.images)
    edges.push_back(find_edges(view.image, options, backend));
  return edges;
}

std::vector<ObjectView> register_views(const KnownScene& scene, const SceneEdges& edges,
                                       const TensorOptions& tensor, Backend& backend) {
  std::vector<ObjectView> views;
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const KnownImage& known = scene.images[i];
    ObjectView& view = views.emplace_back();
    view.camera = known.camera;
    view.camera_from_world = known.camera_from_world;
    view.image = std::make_shared<Image>(known.image);
    view.edges = std::make_shared<EdgeIndex>(edges[i], known.camera.width, known.camera.height);
    add_tensors(view, reduction_for(smallest_size_px(scene, known)), backend, tensor);
  }
  return views;
}

}  // namespace edgescout
