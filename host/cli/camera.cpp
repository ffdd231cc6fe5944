// edgescout camera: prints what a calibration file says and draws an image without its distortion.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <numbers>

#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/option_table.h"
#include "host/cli/output_file.h"
#include "host/cli/verbs.h"
#include "host/core/camera_check.h"
#include "host/core/lens.h"
#include "host/core/log.h"
#include "host/io/camera_file.h"
#include "host/io/files.h"
#include "host/io/image.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct CameraRequest {
  ImageOptions reading;
  CameraArguments camera;
  std::string image, out;
  bool may_scale = false;
};

std::vector<const char*> coefficient_names(LensModel lens) {
  switch (lens) {
    case LensModel::BrownConrady:
      return {"k1", "k2", "p1", "p2", "k3", "k4",    "k5",
              "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y"};
    case LensModel::ModifiedBrownConrady:
      return {"k1", "k2", "p1", "p2", "k3"};
    case LensModel::Fisheye:
      return {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2", "s1", "s2", "s3", "s4"};
    case LensModel::ThinPrismFisheye:
      return {"k1", "k2", "p1", "p2", "k3", "k4", "sx1", "sy1"};
    case LensModel::FieldOfView:
      return {"omega"};
  }
  throw LogicError("coefficient_names: no such lens model");
}

std::string lens_text(const Camera& camera) {
  std::string text;
  const std::vector<const char*> names = coefficient_names(camera.lens);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (camera.distortion[i] != 0) text += fmt::format(" {} {:g}", names[i], camera.distortion[i]);
  if (text.empty() && camera.lens == LensModel::BrownConrady) return "no distortion";
  return to_string(camera.lens) + (text.empty() ? ", all coefficients 0" : ":" + text);
}

std::string view_text(const Camera& camera) {
  constexpr double degrees = 180 / std::numbers::pi;
  const Camera ideal = undistorted(camera);
  return fmt::format("{:.1f} x {:.1f} degrees, focal lengths {:.6g} and {:.6g} px",
                     horizontal_view_rad(ideal) * degrees, vertical_view_rad(ideal) * degrees,
                     ideal.fx, ideal.fy);
}

std::string report(const FileCamera& found) {
  const Camera& camera = found.camera;
  const bool has_size = camera.width > 0;
  std::string text = found.name.empty() ? "" : fmt::format("{}\n", found.name);
  text += has_size ? fmt::format("  size             {} x {} px\n", camera.width, camera.height)
                   : "  size             not in the file: that of the image\n";
  text += fmt::format("  focal lengths    {:.6g} and {:.6g} px\n", camera.fx, camera.fy);
  text += fmt::format("  principal point  {:.6g}, {:.6g} px, pixel centres at integers\n",
                      camera.cx, camera.cy);
  if (camera.skew != 0) text += fmt::format("  skew             {:g} px\n", camera.skew);
  text += fmt::format("  lens             {}\n", lens_text(camera));
  if (has_size) text += fmt::format("  undistorted      {}\n", view_text(camera));
  if (!found.unused.empty())
    text += fmt::format("  not used         {}\n", fmt::join(found.unused, ", "));
  return text;
}

std::vector<FileCamera> chosen_cameras(const CameraRequest& request) {
  std::vector<FileCamera> cameras =
      cameras_named(request.camera.name, load_cameras(request.camera.file), request.camera.file);
  for (FileCamera& found : cameras)
    found.camera.field_of_view_rad = field_of_view_rad(request.camera);
  return cameras;
}

void warn(const FileCamera& found, const std::string& file) {
  const std::string where = found.name.empty() ? file : file + ": " + found.name;
  for (const std::string& warning : implausible_in(found.camera))
    log(LogLevel::Warning, fmt::format("{}: {}", where, warning));
}

void draw_undistorted(const CameraRequest& request) {
  InputImage input;
  input.file = request.image;
  input.reading = request.reading;
  input.reading.validate();
  const Image image = read_image(input);
  const GivenCamera given{given_camera(request.camera, {&input, 1}), request.camera.file,
                          request.may_scale};
  const Camera camera = camera_of(input, image.width, image.height, given);
  std::filesystem::path out = request.out;
  if (out.empty()) out = input.file.stem().string() + "_undistorted.png";
  std::error_code not_there;
  if (std::filesystem::equivalent(out, input.file, not_there))
    throw InputError("command line", "--out", "the image itself", "another file");
  require_writable_folder(parent_of_output(out));
  save_png(undistort(image, camera), out);
  std::cout << fmt::format("{}: undistorted, {}\n", out.string(), view_text(camera));
}

void show(const CameraRequest& request) {
  if (request.image.empty() && !request.out.empty())
    throw InputError("command line", "--out", "it without an image", "camera FILE IMAGE --out PNG");
  std::cout << request.camera.file << "\n";
  for (const FileCamera& found : chosen_cameras(request)) {
    std::cout << report(found);
    warn(found, request.camera.file);
  }
  if (!request.image.empty()) draw_undistorted(request);
}

}  // namespace

void add_camera_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("camera", "Print what a calibration file says, undistort an image");
  auto request = std::make_shared<CameraRequest>();
  verb->add_option("file", request->camera.file,
                   "Calibration: a file of ROS, OpenCV, Kalibr, COLMAP, BOP, MATLAB and others "
                   "(docs/cameras.md)")
      ->required()
      ->type_name("FILE");
  verb->add_option("image", request->image, "Image of that camera, to be undistorted")
      ->type_name("IMAGE");
  verb->add_option("--out", request->out,
                   "The undistorted image. Default: NAME_undistorted.png in the working folder")
      ->type_name("PNG");
  add_camera_choice(*verb, request->camera);
  add_scale_camera(*verb, request->may_scale);
  CommandLineOptions add(*verb);
  describe(request->reading, add);
  verb->callback([request, &exit_code] {
    show(*request);
    exit_code = exit_done;
  });
}

}  // namespace edgescout
