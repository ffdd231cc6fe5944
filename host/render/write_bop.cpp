#include "host/render/write_bop.h"

#include <nlohmann/json.hpp>

#include "host/io/bop.h"
#include "host/io/depth_png.h"
#include "host/io/files.h"
#include "host/io/image.h"
#include "host/io/mesh.h"
#include "kernels/error.h"

namespace edgescout {
namespace {

using nlohmann::json;

json matrix_mm(const Se3& transform) {
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = transform.rotation.toRotationMatrix();
  matrix.topRightCorner<3, 1>() = 1e3 * transform.translation_m;
  return std::vector<double>(matrix.data(), matrix.data() + 16);
}

json model_info(const Object& object, const std::map<int, Eigen::Vector3d>& turning_axes) {
  const Mesh& mesh = object.mesh;
  const Eigen::Vector3d low = 1e3 * mesh.box_min_m, size = 1e3 * (mesh.box_max_m - mesh.box_min_m);
  json info = {{"diameter", 1e3 * mesh.diameter_m},
               {"min_x", low.x()},
               {"min_y", low.y()},
               {"min_z", low.z()},
               {"size_x", size.x()},
               {"size_y", size.y()},
               {"size_z", size.z()}};
  if (const auto axis = turning_axes.find(object.id); axis != turning_axes.end()) {
    const std::vector<double> direction{axis->second.x(), axis->second.y(), axis->second.z()};
    info["symmetries_continuous"] = {{{"axis", direction}, {"offset", {0, 0, 0}}}};
    return info;
  }
  for (std::size_t i = 1; i < object.symmetries.discrete.size();
       ++i)  // BOP does not list the identity
    info["symmetries_discrete"].push_back(matrix_mm(object.symmetries.discrete[i]));
  return info;
}

}  // namespace

void write_bop_scene(const SimulatedScene& scene, std::span<const Rendering> renderings,
                     const std::filesystem::path& folder) {
  check(renderings.size() == scene.views.size(), "write_bop_scene: one rendering a view");
  require_writable_folder(folder / "gray");
  if (scene.options.depth.on) require_writable_folder(folder / "depth");
  BopScene bop;
  bop.folder = folder;
  for (std::size_t v = 0; v < scene.views.size(); ++v) {
    BopImage image;
    image.image_id = static_cast<int>(v);
    image.file = folder / "gray" / (six_digits(image.image_id) + ".png");
    image.camera = scene.views[v].camera;
    image.camera_from_world = scene.views[v].camera_from_world;
    std::vector<BopTruth>& truth = bop.truth[image.image_id];
    for (std::size_t p = 0; p < scene.placed.size(); ++p)
      if (const PlacedObject& part = scene.placed[p]; part.target)
        truth.push_back({scene.objects[part.object].id,
                         scene.views[v].camera_from_world * part.world_from_object,
                         renderings[v].visible_fraction[p]});
    save_png(renderings[v].image, image.file);
    if (const DepthSensor& sensor = scene.options.depth; sensor.on) {
      image.depth_scale = 1e3 * sensor.unit_m;
      write_depth_png(renderings[v].measured_depth, sensor.unit_m,
                      folder / "depth" / image.file.filename());
    }
    bop.images.push_back(image);
  }
  save_bop_scene(bop, folder);
}

void write_bop_models(std::span<const Object> objects,
                      const std::map<int, Eigen::Vector3d>& turning_axes,
                      const std::filesystem::path& folder) {
  require_writable_folder(folder);
  json infos = json::object();
  for (const Object& object : objects) {
    save_ply_mm(object.mesh, folder / ("obj_" + six_digits(object.id) + ".ply"));
    infos[std::to_string(object.id)] = model_info(object, turning_axes);
  }
  write_file_atomically(folder / "models_info.json", infos.dump(1) + "\n");
}

}  // namespace edgescout
