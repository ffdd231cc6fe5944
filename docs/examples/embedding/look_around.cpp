// A robot's control thread takes images of a part from one view after the other, until the result
// is certain: look_around BOP_SCENE MESH_MM.
//
// A recorded scene replaces the robot: to move to a view and take an image is to read a file here.
// The scout starts no thread of its own (the backend has worker threads) and has no global state. A
// call that throws leaves the scout as it was.
#include <iostream>

#include "host/active/recorded_views.h"
#include "host/active/scout.h"
#include "host/io/mesh.h"
#include "kernels/error.h"

using namespace edgescout;

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: look_around BOP_SCENE MESH_MM\n";
    return 2;
  }
  RecordedViews robot = load_recorded_views(argv[1]);

  TemplateOptions templates;
  templates.frequency = 3;
  templates.in_plane_steps = 12;
  templates.distance_min_m = 0.3;  // between camera and part
  templates.distance_max_m = 0.4;
  const auto backend = make_backend("cpu");
  const Object part{1, load_mesh(argv[2], LengthUnit::Millimetre), {}};
  const std::vector<TemplateSet> sets{build_templates(part, templates, *backend)};

  ScoutOptions options;
  options.max_views = 2;
  options.detections.min_probability = 0.1;
  // Read the emergency stop here. If it returns true, Cancelled is thrown between two stages.
  options.cancelled = [] { return false; };
  Scout scout(sets, robot.camera(), robot.views(), options, *backend);

  while (const auto next = scout.propose()) {
    try {
      // Moves to the view and takes an image. If the arm measures its pose, give that pose.
      const Shot shot = robot.acquire(next->view);
      scout.give(next->view, shot.image, shot.camera_from_world);
    } catch (const AcquisitionError& error) {
      scout.unreachable(next->view, error.what());  // another view is proposed in its place
    } catch (const InputError& error) {  // an image of another size, a pose that is not rigid
      scout.unreachable(next->view, error.what());
    }
    std::cout << "view " << next->view << ": " << scout.state().entropy_nats << " nats undecided\n";
  }
  for (const ModeDetection& found : scout.state().detections)
    std::cout << "part at " << found.detection.world_from_object.translation_m.transpose()
              << " m, probability " << found.detection.probability << "\n";
  return scout.state().detections.empty();
}
