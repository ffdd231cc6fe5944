// edgescout model draw: draws the edges that the detector compares with an image.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/model_verbs.h"
#include "host/cli/option_table.h"
#include "host/cli/output_file.h"
#include "host/io/files.h"
#include "host/io/mesh.h"
#include "host/model/mesh_quality.h"
#include "host/model/template_set.h"
#include "host/overlay.h"
#include "kernels/backend.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct DrawRequest {
  std::string file, unit, out, device = "auto";
  int columns = 4, rows = 3, tile_px = 320;
  EdgeModelOptions edges;
};

// The viewpoints of the pictures and their distance from the object.
struct Viewpoints {
  std::vector<Eigen::Quaterniond> camera_from_object;
  double distance_m = 0;
};

Viewpoints of_templates(const TemplateSet& set) {
  Viewpoints viewpoints;
  for (const TemplateView& view : set.views)
    viewpoints.camera_from_object.push_back(view.camera_from_object);
  viewpoints.distance_m = std::max(
      std::sqrt(set.options.distance_min_m * set.options.distance_max_m), 1.2 * set.model.radius_m);
  return viewpoints;
}

Viewpoints of_model(const EdgeModel& model) {
  Viewpoints viewpoints;
  for (const Eigen::Vector3d& direction : icosphere(3))
    viewpoints.camera_from_object.push_back(looking_from(direction));
  viewpoints.distance_m = 8 * model.radius_m;
  return viewpoints;
}

std::string caption(const Eigen::Quaterniond& camera_from_object) {
  const Eigen::Vector3d towards_camera =
      -(camera_from_object.conjugate() * Eigen::Vector3d::UnitZ());
  constexpr double degrees = 180 / std::numbers::pi;
  return fmt::format("lat {} lon {}",
                     std::lround(std::asin(std::clamp(towards_camera.z(), -1.0, 1.0)) * degrees),
                     std::lround(std::atan2(towards_camera.y(), towards_camera.x()) * degrees));
}

RgbImage draw_tile(const EdgeModel& model, const Eigen::Quaterniond& camera_from_object,
                   double distance_m, int size, Backend& backend) {
  const Image empty{size, size,
                    std::vector<std::uint8_t>(static_cast<std::size_t>(size) * size, 0)};
  Camera camera;
  camera.width = camera.height = size;
  // The outline of the bounding sphere fills 94 % of the tile. Perspective makes it a little wider
  // than the sphere's radius.
  const double outline =
      model.radius_m / std::sqrt(distance_m * distance_m - model.radius_m * model.radius_m);
  camera.fx = camera.fy = 0.47 * size / outline;
  camera.cx = camera.cy = 0.5 * (size - 1);
  const Se3 pose{camera_from_object,
                 Eigen::Vector3d(0, 0, distance_m) - camera_from_object * model.center_m};
  const OverlayPose overlay{0, pose, std::nullopt, caption(camera_from_object)};
  return draw_overlay(empty, camera, {&overlay, 1}, {&model, 1}, nullptr, backend);
}

void paste(const RgbImage& tile, int left, int top, RgbImage& sheet) {
  for (int y = 0; y < tile.height; ++y) {
    const auto row = tile.pixels.begin() + std::ptrdiff_t{3} * y * tile.width;
    std::copy(row, row + std::ptrdiff_t{3} * tile.width,
              sheet.pixels.begin() + std::ptrdiff_t{3} * ((top + y) * sheet.width + left));
  }
}

RgbImage contact_sheet(const EdgeModel& model, const Viewpoints& viewpoints,
                       const DrawRequest& request, Backend& backend) {
  const std::size_t tiles = static_cast<std::size_t>(request.columns) * request.rows,
                    all = viewpoints.camera_from_object.size();
  RgbImage sheet{request.columns * request.tile_px, request.rows * request.tile_px, {}};
  sheet.pixels.assign(std::size_t{3} * sheet.width * sheet.height, 32);
  for (std::size_t i = 0; i < std::min(tiles, all); ++i) {
    const std::size_t view = all <= tiles ? i : i * all / tiles;
    const RgbImage tile = draw_tile(model, viewpoints.camera_from_object[view],
                                    viewpoints.distance_m, request.tile_px, backend);
    paste(tile, static_cast<int>(i) % request.columns * request.tile_px,
          static_cast<int>(i) / request.columns * request.tile_px, sheet);
  }
  return sheet;
}

void draw(const DrawRequest& request) {
  const std::unique_ptr<Backend> backend = make_backend(request.device);
  TemplateSet set;
  const bool holds_templates = is_template_file(request.file);
  if (holds_templates && !request.unit.empty())
    throw InputError("command line", "--unit", "together with " + request.file,
                     "it with a CAD file");
  if (holds_templates)
    set = load_templates(request.file);
  else
    set.model = make_edge_model(load_mesh(request.file, unit_of(request.unit)), request.edges);
  warn_of_mesh(set.model);
  const Viewpoints viewpoints = set.views.empty() ? of_model(set.model) : of_templates(set);
  require_writable_folder(parent_of_output(request.out));
  save_png(contact_sheet(set.model, viewpoints, request, *backend), request.out);
  std::cout << "wrote " << request.out << "\n";
}

}  // namespace

void add_model_draw(CLI::App& model, int& exit_code) {
  CLI::App* verb = model.add_subcommand(
      "draw", "Draw the edges that detection searches for, from several viewpoints");
  auto request = std::make_shared<DrawRequest>();
  verb->add_option("file", request->file, "CAD file with --unit, or a template file without")
      ->required()
      ->type_name("FILE");
  verb->add_option("--unit", request->unit, "Length unit of a CAD file: mm, cm, m or in");
  add_device(*verb, request->device);
  verb->add_option("--out", request->out, "PNG file")->required()->type_name("FILE");
  OptionTable(*verb, "Picture")
      .bounded("columns", request->columns, 1, 16, "Columns of pictures")
      .bounded("rows", request->rows, 1, 16, "Rows of pictures")
      .bounded("tile", request->tile_px, 64, 1024, "Side of one viewpoint's picture, px");
  CommandLineOptions add(*verb, "Picture");
  describe(request->edges, add);
  verb->callback([request, &exit_code] {
    draw(*request);
    exit_code = exit_done;
  });
}

}  // namespace edgescout
