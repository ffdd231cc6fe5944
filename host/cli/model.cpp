// edgescout model: prints the properties of a CAD file. Its other verbs have their own files.
#include <fmt/format.h>

#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "host/cli/exit_codes.h"
#include "host/cli/model_verbs.h"
#include "host/cli/verbs.h"
#include "host/io/json_text.h"
#include "host/io/mesh.h"

namespace edgescout {

namespace {

struct EdgeCounts {
  std::size_t all = 0;
  std::size_t open = 0;          // with one triangle: the border of an open surface
  std::size_t non_manifold = 0;  // with more than two triangles
};

EdgeCounts count_edges(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> triangles_at;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++triangles_at[std::minmax({t[k], t[(k + 1) % 3]})];
  EdgeCounts counts;
  for (const auto& [edge, triangles] : triangles_at) {
    ++counts.all;
    counts.open += triangles == 1;
    counts.non_manifold += triangles > 2;
  }
  return counts;
}

nlohmann::json inspection_json(const std::string& file, const Mesh& mesh, const EdgeCounts& edges) {
  const auto mm = [](const Eigen::Vector3d& x) {
    return std::vector<double>{1000 * x.x(), 1000 * x.y(), 1000 * x.z()};
  };
  return {{"file", file},
          {"box_min_mm", mm(mesh.box_min_m)},
          {"box_max_mm", mm(mesh.box_max_m)},
          {"diameter_mm", 1000 * mesh.diameter_m},
          {"vertices", mesh.vertices_m.size()},
          {"triangles", mesh.triangles.size()},
          {"edges", edges.all},
          {"open_border_edges", edges.open},
          {"non_manifold_edges", edges.non_manifold}};
}

void print_inspection(const std::string& file, const Mesh& mesh, const EdgeCounts& edges) {
  const Eigen::Vector3d low = 1000 * mesh.box_min_m, high = 1000 * mesh.box_max_m,
                        size = high - low;
  std::cout << fmt::format(
      "{}\n"
      "  box       {:.3f} x {:.3f} x {:.3f} mm, from ({:.3f}, {:.3f}, {:.3f}) to ({:.3f}, {:.3f}, "
      "{:.3f})\n"
      "  diameter  {:.3f} mm\n"
      "  vertices  {} (welded)\n"
      "  triangles {}\n"
      "  edges     {}, of which {} on open borders and {} shared by more than two triangles\n",
      file, size.x(), size.y(), size.z(), low.x(), low.y(), low.z(), high.x(), high.y(), high.z(),
      1000 * mesh.diameter_m, mesh.vertices_m.size(), mesh.triangles.size(), edges.all, edges.open,
      edges.non_manifold);
}

struct InspectOptions {
  std::vector<std::string> files;
  std::string unit;
  bool as_json = false;
};

// Reads every file before it prints, so that a bad file gives no partial output.
void inspect(const InspectOptions& options) {
  const LengthUnit unit = length_unit(options.unit);
  std::vector<Mesh> meshes;
  for (const std::string& file : options.files) meshes.push_back(load_mesh(file, unit));
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const EdgeCounts edges = count_edges(meshes[i]);
    if (options.as_json)
      list.push_back(inspection_json(options.files[i], meshes[i], edges));
    else
      print_inspection(options.files[i], meshes[i], edges);
  }
  if (options.as_json) std::cout << json_text(list);
}

void add_inspect(CLI::App& model, int& exit_code) {
  CLI::App* verb =
      model.add_subcommand("inspect", "Print box, diameter, counts and open borders of CAD files");
  auto options = std::make_shared<InspectOptions>();
  verb->add_option("files", options->files, "STL, PLY, OBJ or CAO files")
      ->required()
      ->type_name("FILE");
  verb->add_option("--unit", options->unit, "Length unit of the files: mm, cm, m or in")
      ->required();
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
