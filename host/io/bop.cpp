#include "host/io/bop.h"

#include <charconv>

#include "host/io/bop_layout.h"
#include "host/io/camera_reader.h"
#include "host/io/files.h"
#include "host/io/json_fields.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

int scene_number(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();  // resolves "."
  const std::string name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc{} && end == name.data() + name.size() ? number : 0;
}

std::map<int, BopImage> read_images(const fs::path& folder, const std::string& camera_name) {
  const fs::path file = bop_file(folder, "scene_camera", camera_name);
  const json content = read_json(file);
  const JsonField root{content, file.string(), ""};
  const ImageFiles files(folder, camera_name),
      depth_files = ImageFiles::of_depth(folder, camera_name);
  ProjectedRotations projected;
  std::map<int, BopImage> images;
  for (const auto& [image_id, entry] : numbered_fields(root)) {
    BopImage image;
    image.image_id = image_id;
    image.file = files.of(image.image_id);
    if (depth_files.has(image.image_id)) image.depth_file = depth_files.of(image.image_id);
    if (entry.has("depth_scale")) image.depth_scale = entry.at("depth_scale").number();
    CameraFields fields(entry.value, entry.source, entry.path.substr(1));
    image.camera = read_camera(fields);
    Camera checked = image.camera;
    if (checked.width == 0)
      checked.width = checked.height = 1 << 20;  // the real size is known when the image is read
    validate(checked, entry.source + ": " + entry.path);
    if (entry.has("cam_R_w2c"))
      image.camera_from_world =
          pose_from(entry.at("cam_R_w2c"), entry.at("cam_t_w2c"), METRES_PER_MM, projected);
    images[image.image_id] = image;
  }
  warn_of_projected(projected, file.string());
  return images;
}

void read_truth(const fs::path& file, std::map<int, std::vector<BopTruth>>& truth) {
  if (!is_there(file)) return;
  const json content = read_json(file);
  const JsonField root{content, file.string(), ""};
  ProjectedRotations projected;
  for (const auto& [image_id, image] : numbered_fields(root)) {
    std::vector<BopTruth>& objects = truth[image_id];  // also without any object
    for (const JsonField& entry : image.elements())
      objects.push_back(
          {entry.at("obj_id").integer(),
           pose_from(entry.at("cam_R_m2c"), entry.at("cam_t_m2c"), METRES_PER_MM, projected), 1.0});
  }
  warn_of_projected(projected, file.string());
}

void read_visible_fractions(const fs::path& file, std::map<int, std::vector<BopTruth>>& truth) {
  if (!is_there(file)) return;
  const json content = read_json(file);
  const JsonField root{content, file.string(), ""};
  std::map<int, std::string> keys;  // as written: they may be padded with zeros
  for (const auto& [image_id, image] : numbered_fields(root)) keys[image_id] = image.path.substr(1);
  for (auto& [image_id, objects] : truth) {
    if (objects.empty()) continue;
    const auto key = keys.find(image_id);
    const JsonField entries = root.at(key == keys.end() ? std::to_string(image_id) : key->second);
    const std::vector<JsonField> infos = entries.elements();
    if (infos.size() != objects.size())
      entries.fail(std::to_string(infos.size()) + " objects",
                   std::to_string(objects.size()) + " as in the file of the poses");
    for (std::size_t i = 0; i < infos.size(); ++i)
      if (infos[i].has("visib_fract"))
        objects[i].visible_fraction = infos[i].at("visib_fract").number();
  }
}

// The camera that is meant where none is named.
std::string only_camera(const fs::path& folder) {
  const std::vector<std::string> cameras = bop_cameras(folder);
  if (cameras.empty() || cameras[0].empty()) return "";
  if (cameras.size() == 1) return cameras[0];
  std::string names;
  for (const std::string& name : cameras) names += (names.empty() ? "" : ", ") + name;
  throw InputError(folder.string(), "cameras", names, "the name of one");
}

json camera_entry(const BopImage& image) {
  const Camera& c = image.camera;
  check(c.lens == LensModel::BrownConrady && c.skew == 0 && c.field_of_view_rad == 0,
        "save_bop_scene: a lens that BOP has no field for");
  json entry{{"cam_K", {c.fx, 0.0, c.cx, 0.0, c.fy, c.cy, 0.0, 0.0, 1.0}},
             {"depth_scale", image.depth_scale}};
  if (c.has_distortion()) entry["dist"] = c.distortion;
  if (image.camera_from_world) {
    entry["cam_R_w2c"] = rotation_numbers(*image.camera_from_world);
    entry["cam_t_w2c"] = translation_numbers(*image.camera_from_world, METRES_PER_MM);
  }
  return entry;
}

}  // namespace

BopScene load_bop_images(const fs::path& folder, const std::string& camera_name) {
  BopScene scene;
  scene.scene_id = scene_number(folder);
  scene.folder = folder;
  scene.camera_name = camera_name.empty() ? only_camera(folder) : camera_name;
  for (const auto& [id, image] : read_images(folder, scene.camera_name))
    scene.images.push_back(image);
  return scene;
}

BopScene load_bop_scene(const fs::path& folder, const std::string& camera_name) {
  BopScene scene = load_bop_images(folder, camera_name);
  read_truth(bop_file(folder, "scene_gt", scene.camera_name), scene.truth);
  read_visible_fractions(bop_file(folder, "scene_gt_info", scene.camera_name), scene.truth);
  return scene;
}

void save_bop_scene(const BopScene& scene, const fs::path& folder) {
  json cameras = json::object(), poses = json::object(), infos = json::object();
  for (const BopImage& image : scene.images)
    cameras[std::to_string(image.image_id)] = camera_entry(image);
  for (const auto& [image_id, objects] : scene.truth) {
    json& image_poses = poses[std::to_string(image_id)] = json::array();
    json& image_infos = infos[std::to_string(image_id)] = json::array();
    for (const BopTruth& object : objects) {
      image_poses.push_back(
          {{"obj_id", object.object_id},
           {"cam_R_m2c", rotation_numbers(object.camera_from_object)},
           {"cam_t_m2c", translation_numbers(object.camera_from_object, METRES_PER_MM)}});
      image_infos.push_back({{"visib_fract", object.visible_fraction}});
    }
  }
  write_file_atomically(bop_file(folder, "scene_camera", scene.camera_name),
                        cameras.dump(1) + "\n");
  write_file_atomically(bop_file(folder, "scene_gt", scene.camera_name), poses.dump(1) + "\n");
  write_file_atomically(bop_file(folder, "scene_gt_info", scene.camera_name), infos.dump(1) + "\n");
}

}  // namespace edgescout
