// edgescout_bench_decision [--device WORD] [--repetitions N] [--growth]
//
// One whole decision where to look next, as `edgescout scout` makes it: from refined candidates and particles
// of a rendered bin to the best of all views. Which candidates exclude each other, scenes, visible edges and
// surfaces of every candidate in every view, their maps, and the information; an image of 1024x768, maps of a
// quarter of that. With --growth also each of its four numbers three and ten times as large.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <string>

#include "host/active/combinations.h"
#include "host/active/next_view.h"
#include "host/experiments/bin.h"
#include "host/experiments/machine.h"
#include "kernels/thread_pool.h"

namespace {

using namespace edgescout;

struct Size {
  int views = 32, candidates = 40, particles = 200, combinations = 1000;  // the paper's
};

// A bin's parts, each seen as several candidates some millimetres off, as a first image leaves them.
struct Work {
  std::vector<EdgeModel> models;
  std::vector<TemplateTable> tables;
  Camera camera{1024, 768, 1000, 1000, 511.5, 383.5, {}};
  std::vector<Se3> views;
  std::vector<char> closed;
  std::vector<RegisterView> real;
  std::vector<Detection> candidates;
  std::vector<Particle> particles;

  Work(const Bin& bin, const Size& size, Backend& backend) {
    for (const Object& object : bin_types()) models.push_back(make_edge_model(object.mesh));
    for (const EdgeModel& model : models)
      tables.push_back(make_template_table(model, bin_views().radius_m, backend));
    HemisphereOptions hemisphere = bin_views();
    hemisphere.count = size.views + 1;  // one was taken
    views = hemisphere_views(hemisphere);
    closed.assign(views.size(), 0);
    closed[0] = 1;
    RegisterView first;
    first.camera = camera;
    first.camera_from_world = views[0];
    real.push_back(std::move(first));
    Random random(1);
    for (int i = 0; i < size.candidates; ++i) {
      const BinInstance& instance = bin.instances[std::size_t(i) % bin.instances.size()];
      Detection candidate;
      candidate.object = instance.object;
      candidate.world_from_object =
          perturbed(instance.world_from_object, Matrix6d::Zero(),
                    models[std::size_t(instance.object)].mesh.diameter_m, {0.02, 0.02}, random);
      candidate.psi = random.uniform(0.6, 0.95);
      candidate.probability = random.uniform(0.05, 0.95);
      candidates.push_back(candidate);
    }
    particles = draw_particles(models, candidates, size.particles, {0.02, 0.1}, random.split("particles"));
  }

  int decide(const Size& size, Backend& backend) const {
    CombinationOptions combinations;
    combinations.count = size.combinations;
    const BitMatrix scenes = candidate_combinations(models, candidates, true, DEFAULT_PENETRATION_M,
                                                    combinations, backend.threads());
    const std::vector<ViewInformation> information = view_information(
        {models, tables, camera, views, closed, real, candidates, &scenes, particles}, backend, {});
    return best_view(information).value_or(-1);
  }
};

void report(const Bin& bin, const Size& size, Backend& backend, int repetitions) {
  const Work work(bin, size, backend);
  work.decide(size, backend);  // the driver's compiler, the first pages
  forget_peak_memory();
  std::vector<double> seconds;
  for (int r = 0; r < repetitions; ++r) {
    const auto start = std::chrono::steady_clock::now();
    work.decide(size, backend);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::ranges::sort(seconds);
  std::printf("%5d %10d %9d %12d %9.3f %9.0f\n", size.views, size.candidates, size.particles,
              size.combinations, seconds[seconds.size() / 2], double(peak_memory_bytes()) / 1e6);
  std::fflush(stdout);
}

void run(const std::string& device, int repetitions, bool growth) {
  const std::unique_ptr<Backend> backend = make_backend(device);
  std::printf("%s, %d threads, median of %d\n", backend->name().c_str(), backend->threads().threads(),
              repetitions);
  std::printf("%5s %10s %9s %12s %9s %9s\n", "views", "candidates", "particles", "combinations", "seconds",
              "peak, MB");
  const Bin bin = make_bin(bin_types(), ExperimentSettings::full_form(), 2, backend->threads());
  report(bin, {}, *backend, repetitions);
  for (const int by : {3, 10})
    for (int Size::*const number : {&Size::views, &Size::candidates, &Size::particles, &Size::combinations}) {
      if (!growth) return;
      Size size;
      size.*number *= by;
      report(bin, size, *backend, repetitions);
    }
}

}  // namespace

int main(int argc, char** argv) {
  std::string device = "cpu";
  int repetitions = 5;
  bool growth = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--growth") == 0) growth = true;
    if (i + 1 == argc) continue;
    if (std::strcmp(argv[i], "--device") == 0) device = argv[i + 1];
    if (std::strcmp(argv[i], "--repetitions") == 0) repetitions = std::max(1, std::atoi(argv[i + 1]));
  }
  try {
    run(device, repetitions, growth);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "edgescout_bench_decision: %s\n", error.what());
    return 1;
  }
}
