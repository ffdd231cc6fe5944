// How much longer a call of the C interface takes than the same by C++: on a small image and with a
// limit that is over, so that the work does not drown it, and what reading a whole image takes.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>

#include "host/bindings/c/edgescout.h"
#include "host/edgescout.h"

using namespace edgescout;

namespace {

void must(edgescout_status status) {
  if (status == EDGESCOUT_OK) return;
  std::fprintf(stderr, "%s\n", edgescout_last_error());
  std::exit(2);
}

double milliseconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TemplateSet templates_of(const std::string& mesh_file, Backend& backend) {
  TemplateOptions options;
  options.distance_min_m = options.distance_max_m = 0.34;
  options.frequency = 1;
  return build_templates({1, load_mesh(mesh_file, LengthUnit::Millimetre), {}}, options, backend);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string examples = std::string(argv[1]) + "/";
  const auto backend = make_cpu_backend(1);
  const Image whole = load_image(examples + "scenes/000000/gray/000000.png");
  const Image image{64, 48, {whole.pixels.begin(), whole.pixels.begin() + 64 * 48}};
  const Camera camera{image.width, image.height, 700, 700, 31.5, 23.5};
  const std::vector<TemplateSet> sets{templates_of(examples + "parts/obj_000001.ply", *backend)};

  const std::string file = "overhead.templates";
  save_templates(sets[0], file);
  edgescout_templates* templates = nullptr;
  must(edgescout_templates_load(file.c_str(), &templates));
  std::filesystem::remove(file);
  edgescout_backend* c_backend = nullptr;
  must(edgescout_backend_create("cpu", 1, &c_backend));
  edgescout_camera_model model{};
  model.struct_size = sizeof model;
  model.width = camera.width;
  model.height = camera.height;
  model.fx = camera.fx;
  model.fy = camera.fy;
  model.cx = camera.cx;
  model.cy = camera.cy;
  edgescout_camera* c_camera = nullptr;
  must(edgescout_camera_create(&model, &c_camera));
  edgescout_image c_image{};
  c_image.struct_size = sizeof c_image;
  c_image.pixels = image.pixels.data();
  c_image.width = image.width;
  c_image.height = image.height;
  edgescout_view view{};
  view.struct_size = sizeof view;
  view.image = &c_image;
  view.camera = c_camera;
  edgescout_limit limit{};
  limit.struct_size = sizeof limit;
  limit.max_seconds = 1e-9;
  const edgescout_request request{sizeof request, &view, 1, templates, c_backend, nullptr, &limit};

  double of_cpp_ms = 1e9, of_c_ms = 1e9;
  for (int i = 0; i < 200; ++i) {
    of_cpp_ms = std::min(of_cpp_ms, milliseconds_of([&] {
                           PipelineOptions options;
                           options.limit = TimeLimit::after(1e-9);
                           detect_objects(prepare_view(image, camera, Se3{}, *backend, options),
                                          sets, *backend, options);
                         }));
    of_c_ms = std::min(of_c_ms, milliseconds_of([&] {
                         edgescout_detections* found = nullptr;
                         must(edgescout_detect(&request, &found));
                         must(edgescout_free(found));
                       }));
  }
  constexpr int calls = 100000;
  const double short_call_us = 1e3 / calls * milliseconds_of([&] {
                                 edgescout_camera_model out{};
                                 out.struct_size = sizeof out;
                                 for (int i = 0; i < calls; ++i)
                                   must(edgescout_camera_get(c_camera, &out));
                               });
  edgescout_image whole_image = c_image;
  whole_image.pixels = whole.pixels.data();
  whole_image.width = whole.width;
  whole_image.height = whole.height;
  double reading_ms = 1e9;
  for (int i = 0; i < 50; ++i)
    reading_ms = std::min(reading_ms, milliseconds_of([&] {
                            edgescout_picture* grey = nullptr;
                            must(edgescout_picture_grey(&whole_image, &grey));
                            must(edgescout_free(grey));
                          }));
  const double overhead_ms = of_c_ms - of_cpp_ms + reading_ms;
  std::printf("%.3f ms by C++, %.3f ms by C; %.3f ms to read %dx%d; a short call takes %.3f us\n",
              of_cpp_ms, of_c_ms, reading_ms, whole.width, whole.height, short_call_us);
  must(edgescout_free(templates));
  must(edgescout_free(c_camera));
  must(edgescout_free(c_backend));
  return overhead_ms < 1 ? 0 : 1;
}
