// Cameras as the name of a model and one list of all its parameters.
#include <algorithm>
#include <map>

#include "host/io/camera_lens.h"
#include "host/io/camera_reader.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct ParameterModel {
  LensModel lens;
  bool one_focal_length;
  std::size_t coefficients;
};

// COLMAP's names (https://colmap.github.io/cameras.html). Its image has the corner of the first
// pixel at 0, 0.
const std::map<std::string, ParameterModel, std::less<>> colmap_models{
    {"SIMPLE_PINHOLE", {LensModel::BrownConrady, true, 0}},
    {"PINHOLE", {LensModel::BrownConrady, false, 0}},
    {"SIMPLE_RADIAL", {LensModel::BrownConrady, true, 1}},
    {"RADIAL", {LensModel::BrownConrady, true, 2}},
    {"OPENCV", {LensModel::BrownConrady, false, 4}},
    {"FULL_OPENCV", {LensModel::BrownConrady, false, 8}},
    {"OPENCV_FISHEYE", {LensModel::Fisheye, false, 4}},
    {"SIMPLE_RADIAL_FISHEYE", {LensModel::Fisheye, true, 1}},
    {"RADIAL_FISHEYE", {LensModel::Fisheye, true, 2}},
    {"FOV", {LensModel::FieldOfView, false, 1}},
    {"THIN_PRISM_FISHEYE", {LensModel::ThinPrismFisheye, false, 8}},
    {"RAD_TAN_THIN_PRISM_FISHEYE", {LensModel::Fisheye, false, 12}}};

constexpr const char* colmap_names =
    "SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, FULL_OPENCV, OPENCV_FISHEYE, "
    "SIMPLE_RADIAL_FISHEYE, RADIAL_FISHEYE, FOV, THIN_PRISM_FISHEYE or RAD_TAN_THIN_PRISM_FISHEYE";

void set_parameters(Camera& camera, const ParameterModel& model,
                    const std::vector<double>& parameters, const JsonField& field) {
  const std::size_t intrinsics = model.one_focal_length ? 3 : 4;
  if (parameters.size() != intrinsics + model.coefficients)
    field.fail(std::to_string(parameters.size()) + " parameters",
               std::to_string(intrinsics + model.coefficients) + " of this model");
  camera.fx = parameters[0];
  camera.fy = parameters[intrinsics - 3];
  camera.cx = parameters[intrinsics - 2];
  camera.cy = parameters[intrinsics - 1];
  camera.lens = model.lens;
  std::copy(parameters.begin() + static_cast<std::ptrdiff_t>(intrinsics), parameters.end(),
            camera.distortion.begin());
}

void read_colmap(CameraFields& fields, Camera& camera) {
  const JsonField name = *fields.take({"model", "modelname"}), list = *fields.take({"params"});
  const auto model = colmap_models.find(text_in_field(name));
  if (model == colmap_models.end()) name.fail(text_in_field(name), colmap_names);
  set_parameters(camera, model->second, numbers_in_field(list), list);
  camera.cx -= 0.5;
  camera.cy -= 0.5;
  read_size(fields, camera);
}

// BOP's cam_model: the names of Meta's hand tracking toolkit, with pixel centres at integers.
void read_cam_model(CameraFields& fields, Camera& camera) {
  const JsonField list = *fields.take({"projectionparams"});
  const auto name = fields.take({"projectionmodeltype", "projectionmodel"});
  if (!name)
    throw InputError(fields.source(), fields.at("projection_model_type"), "nothing", "a model");
  const std::vector<double> parameters = numbers_in_field(list);
  static const std::map<std::string, ParameterModel, std::less<>> models{
      {"pinhole", {LensModel::BrownConrady, false, 0}},
      {"pinholeplane", {LensModel::BrownConrady, false, 0}},
      {"linear", {LensModel::BrownConrady, false, 0}},
      {"opencv", {LensModel::BrownConrady, false, 5}},
      {"rational", {LensModel::BrownConrady, false, 8}},
      {"kannalabrandt", {LensModel::Fisheye, false, 4}},
      {"kannalabrandtk3", {LensModel::Fisheye, false, 4}},
      {"fisheye624", {LensModel::Fisheye, false, 12}},
      {"fisheye62", {LensModel::Fisheye, false, 8}},
      {"fisheyeradtanthinprism", {LensModel::Fisheye, false, 12}},  // Project Aria's name
      {"oculusvisionfisheye624", {LensModel::Fisheye, false, 12}}};
  std::string word = plain_name(text_in_field(*name));
  if (word.starts_with("cameramodeltype")) word.erase(0, std::string("cameramodeltype").size());
  const auto found = models.find(word);
  if (found == models.end())
    name->fail(text_in_field(*name), "PINHOLE, OpenCV, Rational, KANNALA_BRANDT or FISHEYE624");
  ParameterModel model = found->second;
  // Aria writes one focal length.
  model.one_focal_length = parameters.size() == 3 + model.coefficients;
  set_parameters(camera, model, parameters, list);
  read_size(fields, camera);
}

}  // namespace

bool read_model_with_parameters(CameraFields& fields, Camera& camera) {
  const bool is_cam_model = fields.has({"projectionparams"});
  if (!is_cam_model && !(fields.has({"params"}) && fields.has({"model", "modelname"})))
    return false;
  if (is_cam_model)
    read_cam_model(fields, camera);
  else
    read_colmap(fields, camera);
  return true;
}

}  // namespace edgescout
