// A robot's control thread looks for a part until it is sure: look_around BOP_SCENE MESH_MM. The
// recorded scene stands for the robot: moving to a view and taking an image is reading a file here.
// The scout starts no thread of its own (the backend has its workers) and keeps nothing global, and
// any call may be left by an exception without harm.
#include <iostream>

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
  options.cancelled = [] {
    return false;
  };  // ask the emergency stop here: Cancelled is thrown between two stages
  Scout scout(sets, robot.camera(), robot.views(), options, *backend);

  while (const auto next = scout.propose()) {
    try {
      const Shot shot = robot.acquire(
          next->view);  // move there, take an image; and where the arm knows better: its true pose
      scout.give(next->view, shot.image, shot.camera_from_world);
    } catch (const AcquisitionError& error) {
      scout.unreachable(next->view, error.what());  // another view is proposed in its place
    } catch (const InputError& error) {             // an image of another size, a pose that is none
      scout.unreachable(next->view, error.what());
    }
    std::cout << "view " << next->view << ": " << scout.state().entropy_nats << " nats undecided\n";
  }
  for (const ModeDetection& found : scout.state().detections)
    std::cout << "part at " << found.detection.world_from_object.translation_m.transpose()
              << " m, probability " << found.detection.probability << "\n";
  return scout.state().detections.empty();
}
