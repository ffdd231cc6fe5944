// Finds a part in an image, as a robot's program would: consumer BOP_SCENE MESH_MM OBJECT_ID.
// Succeeds if the best detection is within 5 mm of the scene's ground truth.
#include <iostream>

#include "host/io/bop.h"
#include "host/io/image.h"
#include "host/io/mesh.h"
#include "host/pipeline.h"

using namespace edgescout;

int main(int, char** argv) {
  const BopScene scene = load_bop_scene(argv[1]);
  Object part{std::stoi(argv[3]), load_mesh(argv[2], LengthUnit::Millimetre), {}};
  TemplateOptions templates;
  templates.frequency = 3;
  templates.in_plane_steps = 12;
  templates.distance_min_m = 0.32;
  templates.distance_max_m = 0.36;
  const auto backend = make_backend("cpu");
  const std::vector<TemplateSet> sets{build_templates(part, templates, *backend)};

  PipelineOptions options;
  options.detect.min_probability = 0.1;
  const BopImage& input = scene.images.at(0);
  const Image image = load_image(input.file);
  Camera camera = input.camera;
  camera.width = image.width;
  camera.height = image.height;
  std::vector<StageSeconds> stages;
  const ObjectView view = prepare_view(image, camera, Se3{}, *backend, options, &stages);
  const Detections found = detect_objects(view, sets, *backend, options);
  if (found.detections.empty()) return 1;
  const Detection& best = found.detections[0];
  std::cout << "object " << part.id << " at " << best.world_from_object.translation_m.transpose()
            << " m, probability " << best.probability << "\n";
  for (const BopTruth& truth : scene.truth.at(input.image_id))
    if (truth.object_id == part.id &&
        distance_between_m(best.world_from_object, truth.camera_from_object) < 0.005)
      return 0;
  return 1;
}
