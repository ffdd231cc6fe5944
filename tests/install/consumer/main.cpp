// Loads a box and asks which of its edges a camera sees from half a metre: nine of twelve.
#include <iostream>

#include "host/io/mesh.h"
#include "host/model/visible_edges.h"

using namespace edgescout;

int main(int, char** argv) {
  const Mesh box = load_mesh(argv[1], LengthUnit::Millimetre);
  EdgeModelOptions options;
  options.raster_step_m = 0.001;
  const EdgeModel model = make_edge_model(box, options);
  const auto backend = make_backend("cpu");
  const Se3 camera_from_object{so3_exp({0.6, 0.7, 0.2}), {0, 0, 0.5}};
  const auto points = visible_edges(model, std::vector{camera_from_object}, *backend).front();
  std::cout << points.size() << " of 640 mm of edges are visible\n";
  return points.size() > 450 && points.size() < 510 ? 0 : 1;  // 480 mm, and what shows near the contour
}
