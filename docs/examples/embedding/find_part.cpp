// Finds a part in an image: find_part IMAGE CAMERA_FILE MESH_MM DISTANCE_MIN_M DISTANCE_MAX_M.
#include <exception>
#include <iostream>

#include "host/edgescout.h"

using namespace edgescout;

int main(int argc, char** argv) {
  if (argc != 6) {
    std::cerr << "usage: find_part IMAGE CAMERA_FILE MESH_MM DISTANCE_MIN_M DISTANCE_MAX_M\n";
    return 2;
  }
  try {
    const auto backend = make_backend("auto");

    // Once per part. save_templates and load_templates keep the result in a file.
    const Object part{1, load_mesh(argv[3], LengthUnit::Millimetre), {}};
    TemplateOptions templates;
    templates.distance_min_m = std::stod(argv[4]);  // between camera and part
    templates.distance_max_m = std::stod(argv[5]);
    const std::vector<TemplateSet> sets{build_templates(part, templates, *backend)};

    // Once per image. The world is the camera frame here, so the camera's pose is the identity.
    const Image image = load_image(argv[1]);
    const Camera camera =
        camera_for_image(load_camera(argv[2]), image.width, image.height, false, argv[2]);
    const PipelineOptions options;
    const ObjectView view = prepare_view(image, camera, Se3{}, *backend, options);
    const Detections found = detect_objects(view, sets, *backend, options);

    for (const Detection& detection : found.detections)
      std::cout << "probability " << detection.probability << ", at "
                << detection.world_from_object.translation_m.transpose() << " m\n";
    return found.detections.empty();
  } catch (const std::exception& error) {  // InputError: found X, expected Y
    std::cerr << error.what() << "\n";
    return 2;
  }
}
