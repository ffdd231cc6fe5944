// edgescout model: prints the properties of a CAD file. Its other verbs have their own files.
#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/model_verbs.h"
#include "host/cli/verbs.h"
#include "host/io/json_text.h"
#include "host/io/mesh.h"
#include "host/io/mesh_edges.h"
#include "host/model/mesh_quality.h"

namespace edgescout {

namespace {

struct EdgeCounts {
  std::size_t all = 0;
  std::size_t open = 0;          // with one triangle: the border of an open surface
  std::size_t non_manifold = 0;  // with more than two triangles
};

EdgeCounts count_edges(const Mesh& mesh) {
  EdgeCounts counts;
  const std::vector<HalfEdge> sides = sorted_half_edges(mesh.triangles);
  for_each_edge(sides, [&](std::span<const HalfEdge> edge) {
    ++counts.all;
    counts.open += edge.size() == 1;
    counts.non_manifold += edge.size() > 2;
  });
  return counts;
}

struct Inspection {
  std::string file;
  EdgeModel model;
  EdgeCounts edges;
  MeshQuality quality;
};

Inspection inspect_file(const std::string& file, std::optional<LengthUnit> unit) {
  Inspection found{file, make_edge_model(load_mesh(file, unit)), {}, {}};
  found.edges = count_edges(found.model.mesh);
  found.quality = mesh_quality(found.model);
  return found;
}

nlohmann::json to_json(const Inspection& found) {
  const auto mm = [](const Eigen::Vector3d& x) {
    return std::vector<double>{1000 * x.x(), 1000 * x.y(), 1000 * x.z()};
  };
  const Mesh& mesh = found.model.mesh;
  return {{"file", found.file},
          {"box_min_mm", mm(mesh.box_min_m)},
          {"box_max_mm", mm(mesh.box_max_m)},
          {"diameter_mm", 1000 * mesh.diameter_m},
          {"vertices", mesh.vertices_m.size()},
          {"triangles", mesh.triangles.size()},
          {"depth_map_triangles", found.model.occluding.triangles.size() / 3},
          {"edges", found.edges.all},
          {"open_border_edges", found.edges.open},
          {"non_manifold_edges", found.edges.non_manifold},
          {"inconsistent_edges", found.quality.inconsistent_edges},
          {"drawn_length_mm", 1000 * found.quality.drawn_m},
          {"drawn_open_border_share", found.quality.open_border_share},
          {"drawn_short_edge_share", found.quality.short_edge_share},
          {"warning", mesh_warning(found.model)}};
}

std::string to_text(const Inspection& found) {
  const Mesh& mesh = found.model.mesh;
  const Eigen::Vector3d low = 1000 * mesh.box_min_m, high = 1000 * mesh.box_max_m,
                        size = high - low;
  const MeshQuality& quality = found.quality;
  return fmt::format(
             "{}\n"
             "  box       {:.3f} x {:.3f} x {:.3f} mm, from ({:.3f}, {:.3f}, {:.3f}) to ({:.3f}, "
             "{:.3f}, {:.3f})\n"
             "  diameter  {:.3f} mm\n"
             "  vertices  {} (welded)\n"
             "  triangles {}, drawn in depth maps as {}\n",
             found.file, size.x(), size.y(), size.z(), low.x(), low.y(), low.z(), high.x(),
             high.y(), high.z(), 1000 * mesh.diameter_m, mesh.vertices_m.size(),
             mesh.triangles.size(), found.model.occluding.triangles.size() / 3) +
         fmt::format(
             "  edges     {}, of which {} on open borders and {} shared by more than two "
             "triangles; winding inconsistent at {}\n"
             "  drawn     {:.1f} mm of edges, of which {:.1f} % open border and {:.1f} % in edges "
             "shorter than the raster step of {:.3f} mm\n",
             found.edges.all, found.edges.open, found.edges.non_manifold,
             quality.inconsistent_edges, 1000 * quality.drawn_m, 100 * quality.open_border_share,
             100 * quality.short_edge_share, 1000 * found.model.raster_step_m);
}

struct InspectOptions {
  std::vector<std::string> files;
  std::string unit;
  bool as_json = false;
};

// Reads every file before it prints, so that a bad file gives no partial output.
void inspect(const InspectOptions& options) {
  const std::optional<LengthUnit> unit = unit_of(options.unit);
  std::vector<Inspection> inspections;
  for (const std::string& file : options.files) inspections.push_back(inspect_file(file, unit));
  nlohmann::json list = nlohmann::json::array();
  for (const Inspection& found : inspections) {
    warn_of_mesh(found.model);
    if (options.as_json)
      list.push_back(to_json(found));
    else
      std::cout << to_text(found);
  }
  if (options.as_json) std::cout << json_text(list);
}

void add_inspect(CLI::App& model, int& exit_code) {
  CLI::App* verb =
      model.add_subcommand("inspect", "Print box, diameter, counts and defects of CAD files");
  auto options = std::make_shared<InspectOptions>();
  verb->add_option("files", options->files, MESH_FORMATS + " files")->required()->type_name("FILE");
  verb->add_option("--unit", options->unit, UNIT_HELP);
  verb->add_flag("--json", options->as_json, "Print JSON");
  verb->callback([options, &exit_code] {
    inspect(*options);
    exit_code = exit_done;
  });
}

}  // namespace

void add_model(CLI::App& app, int& exit_code) {
  CLI::App* model = app.add_subcommand("model", "Look into CAD models, build their templates");
  model->require_subcommand(1);
  add_inspect(*model, exit_code);
  add_model_build(*model, exit_code);
  add_model_draw(*model, exit_code);
}

}  // namespace edgescout
