// edgescout model build: makes a template file from a CAD file.
#include <fmt/format.h>

#include <iostream>

#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/inputs.h"
#include "host/cli/model_verbs.h"
#include "host/cli/option_table.h"
#include "host/cli/output_file.h"
#include "host/cli/progress.h"
#include "host/cli/symmetry_arguments.h"
#include "host/io/camera_file.h"
#include "host/io/files.h"
#include "host/model/mesh_quality.h"
#include "host/model/template_set.h"
#include "kernels/backend.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct BuildRequest {
  std::string file, unit, models_info, camera, camera_name, out, device = "auto";
  std::vector<std::string> symmetry;
  int object_id = 0;  // 0: the number in the file's name
  TemplateOptions templates;
};

Object load_object(const BuildRequest& request) {
  ModelArguments arguments;
  arguments.models = {request.file};
  arguments.unit = request.unit;
  arguments.models_info = request.models_info;
  arguments.symmetry = request.symmetry;
  if (request.object_id > 0) arguments.object_ids = {request.object_id};
  return load_objects(arguments)[0];
}

TemplateOptions with_distances(const BuildRequest& request, double diameter_m) {
  request.templates.validate();
  if (request.templates.distance_min_m > 0) return request.templates;
  if (request.camera.empty())
    throw InputError("command line", "--distance-min", "none",
                     "a range of distances, or --camera to choose one");
  const Camera camera = load_camera(request.camera, request.camera_name);
  if (camera.width == 0)
    throw InputError(request.camera, "image_width", "none",
                     "an image size, or --distance-min and --distance-max");
  return with_default_distances(request.templates, diameter_m, camera);
}

void build(const BuildRequest& request) {
  const std::unique_ptr<Backend> backend = make_backend(request.device);
  const Object object = load_object(request);
  const TemplateOptions options = with_distances(request, object.mesh.diameter_m);
  const std::filesystem::path out = request.out;
  require_writable_folder(parent_of_output(out));
  TemplateSet set;
  {
    Progress progress("templates of " + object.mesh.name, 100, std::cerr, stderr_is_terminal());
    set = build_templates(object, options, *backend, [&](int done, int all) {
      progress.move_to(static_cast<std::size_t>(100 * done / all));
    });
  }
  warn_of_mesh(set.model);
  save_templates(set, out);
  std::size_t points = 0;
  for (const TemplateView& view : set.views) points += view.points.size();
  std::cout << fmt::format(
      "{}: object {}, diameter {:.1f} mm, {} viewpoints of {} edge points on average, {} in-plane "
      "rotations, {} distances from {:.3f} to {:.3f} m, {} symmetries\n",
      request.out, set.object_id, 1000 * set.model.mesh.diameter_m, set.views.size(),
      points / set.views.size(), options.in_plane_steps, template_distances_m(options).size(),
      options.distance_min_m, options.distance_max_m, set.symmetries.discrete.size() - 1);
}

}  // namespace

void add_model_build(CLI::App& model, int& exit_code) {
  CLI::App* verb =
      model.add_subcommand("build", "Build the templates of a CAD file, once for many detections");
  auto request = std::make_shared<BuildRequest>();
  verb->add_option("file", request->file, MESH_FORMATS + " file")->required()->type_name("FILE");
  verb->add_option("--unit", request->unit, UNIT_HELP);
  verb->add_option("--models-info,--symmetries", request->models_info,
                   "BOP models_info.json with symmetries")
      ->type_name("FILE");
  add_symmetry(*verb, request->symmetry);
  verb->add_option("--camera", request->camera,
                   "Calibration from which the range of distances is computed")
      ->type_name("FILE");
  verb->add_option("--camera-name", request->camera_name,
                   "Which camera of that file, where it has several")
      ->type_name("NAME");
  add_device(*verb, request->device);
  verb->add_option("--out", request->out, "Template file")->required()->type_name("FILE");
  OptionTable(*verb, "Model")
      .bounded("object-id", request->object_id, 0, 1000000,
               "BOP id. 0: the number at the end of the file's name, else 1");
  CommandLineOptions add(*verb);
  describe(request->templates, add);
  verb->callback([request, &exit_code] {
    build(*request);
    exit_code = exit_done;
  });
}

}  // namespace edgescout
