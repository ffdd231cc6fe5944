// The calibration that Azure Kinect and Femto cameras keep: in units of the image, for all modes.
#include <algorithm>

#include "host/io/camera_lens.h"
#include "host/io/camera_reader.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// The sensor's image is reduced to `binned`, then cut to the mode's size from its middle, or for
// narrow depth from `left`, `top`.
struct SensorMode {
  int binned_width, binned_height;
  int left, top;
  int width, height;
};

constexpr SensorMode color_modes[] = {
    {1280, 960, 0, 120, 1280, 720},   {1920, 1440, 0, 180, 1920, 1080},
    {2560, 1920, 0, 240, 2560, 1440}, {2048, 1536, 0, 0, 2048, 1536},
    {3840, 2880, 0, 360, 3840, 2160}, {4096, 3072, 0, 0, 4096, 3072}};
constexpr SensorMode depth_modes[] = {{512, 512, 96, 90, 320, 288},
                                      {1024, 1024, 192, 180, 640, 576},
                                      {512, 512, 0, 0, 512, 512},
                                      {1024, 1024, 0, 0, 1024, 1024}};

struct Factory {
  std::vector<double> p;  // cx cy fx fy k1 .. k6 codx cody p2 p1 [metric radius]
  bool tangential_is_halved = false;
};

Factory read_factory(CameraFields& fields) {
  const JsonField list = *fields.take({"modelparameters"});
  const auto type = fields.take({"modeltype"});
  Factory factory{numbers_in_field(list)};
  const std::string model = type ? plain_name(text_in_field(*type)) : "";
  if (!model.ends_with("brownconrady") && !model.ends_with("rational6kt"))
    (type ? *type : list)
        .fail(type ? text_in_field(*type) : "no ModelType",
              "CALIBRATION_LensDistortionModelBrownConrady or ..Rational6KT");
  if (factory.p.size() != 14 && factory.p.size() != 15)
    list.fail(std::to_string(factory.p.size()) + " numbers", "14 or 15");
  if (factory.p[10] != 0 || factory.p[11] != 0)
    list.fail("a centre of distortion beside the axis (codx, cody)", "0 and 0");
  factory.tangential_is_halved = model.ends_with("rational6kt");
  // Rational6KT has x y where Brown-Conrady has 2 x y: no other model is the same.
  if (factory.tangential_is_halved && (factory.p[12] != 0 || factory.p[13] != 0))
    list.fail("tangential coefficients of Rational6KT", "Brown-Conrady, or 0 and 0");
  return factory;
}

Camera in_mode(const Factory& factory, const SensorMode& mode) {
  const std::vector<double>& p = factory.p;
  Camera camera;
  camera.width = mode.width;
  camera.height = mode.height;
  camera.fx = p[2] * mode.binned_width;
  camera.fy = p[3] * mode.binned_height;
  camera.cx = p[0] * mode.binned_width - mode.left - 0.5;
  camera.cy = p[1] * mode.binned_height - mode.top - 0.5;
  camera.distortion = {p[4], p[5], p[13], p[12], p[6], p[7], p[8], p[9]};
  return camera;
}

}  // namespace

std::vector<NamedCamera> read_azure_kinect(CameraFields& fields) {
  if (!fields.has({"modelparameters"})) return {};
  const Factory factory = read_factory(fields);
  Camera sensor;
  read_size(fields, sensor);
  const auto location = fields.take({"location"});
  std::string name = location ? text_in_field(*location) : fields.path();
  std::vector<SensorMode> modes{{sensor.width, sensor.height, 0, 0, sensor.width, sensor.height}};
  if (sensor.width == 4096 && sensor.height == 3072) {
    modes.assign(std::begin(color_modes), std::end(color_modes));
    name = "color";
  } else if (sensor.width == 1024 && sensor.height == 1024) {
    modes.assign(std::begin(depth_modes), std::end(depth_modes));
    name = "depth";
  }
  std::vector<NamedCamera> cameras;
  for (const SensorMode& mode : modes) cameras.push_back({name, in_mode(factory, mode)});
  fields.require_all_understood();
  return cameras;
}

}  // namespace edgescout
