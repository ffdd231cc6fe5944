// Prints the training data of the probability of a pose over several views
// (host/register/pose_classifier.h).
//
//   edgescout_bench_views_probability FIRST_BIN LAST_BIN > candidates.csv
//   scripts/fit_probability_over_views.py candidates.csv...
//
// The bins are those of `bench experiments nbv`, with images along the fixed sequence. After two,
// three and five views all candidates of the images so far are refined over all views. Of
// candidates that collide or are at one place, the one with the largest sum of psi z-scores stays.
//
// One row per candidate: whether it is right (0.1 rad and 5 mm, modulo symmetry), and sums over the
// informative views. Which objects are known and hide others is decided by the present fit of the
// probability, so another fit gives slightly different rows.
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>

#include "host/active/candidates.h"
#include "host/active/scout.h"
#include "host/core/pose_error.h"
#include "host/detect/plausible_pairs.h"
#include "host/detect/suppression.h"
#include "host/experiments/bin.h"
#include "host/experiments/bin_types.h"
#include "host/register/occluders.h"
#include "host/register/pose_classifier.h"

namespace {

using namespace edgescout;

double total_psi_z_score(const PoseEstimate& estimate) {
  return std::accumulate(estimate.features.begin(), estimate.features.end(), 0.0,
                         [](double sum, const PoseFeatures& f) { return sum + psi_z_score(f); });
}

// Indices, best first, without poses that collide with a better one or are at its place.
std::vector<std::size_t> without_collisions(std::span<const PoseEstimate> poses,
                                            std::span<const TemplateSet> sets,
                                            std::span<const EdgeModel> models, Backend& backend) {
  const BitMatrix plausible =
      plausible_pairs(models, object_poses(poses), DEFAULT_PENETRATION_M, backend.threads());
  std::vector<std::size_t> order(poses.size()), chosen;
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return total_psi_z_score(poses[a]) > total_psi_z_score(poses[b]);
  });
  for (const std::size_t i : order) {
    const TemplateSet& set = sets[std::size_t(poses[i].object)];
    const bool apart = std::ranges::all_of(chosen, [&](std::size_t j) {
      return plausible.has(i, j) &&
             (poses[i].object != poses[j].object ||
              pose_distance_m(poses[i].world_from_object, poses[j].world_from_object,
                              set.model.mesh, set.symmetries) >= 0.1 * set.model.mesh.diameter_m);
    });
    if (apart) chosen.push_back(i);
  }
  return chosen;
}

bool is_right(const ObjectPose& pose, const Bin& bin) {
  return std::ranges::any_of(bin.instances, [&](const BinInstance& instance) {
    return instance.object == pose.object &&
           pose_error(pose.world_from_object, instance.world_from_object,
                      bin_types()[std::size_t(pose.object)].symmetries)
               .passes();
  });
}

void print_row(const Bin& bin, bool right, std::span<const PoseFeatures> by_view) {
  const ViewSums sums = sum_informative_views(by_view);
  std::printf("%d,%zu,%d,%d,%.5f,%.5f,%.5f\n", bin.number, by_view.size(), int(right), sums.views,
              sums.log_psi_z_score, sums.log_background_psi_z_score, sums.unexplained_grey);
}

// Detects in each new image, with all images so far as support, and keeps everything that it finds.
class Collector {
 public:
  Collector(std::span<const TemplateSet> sets, const DetectOptions& options, Backend& backend)
      : sets_(sets), options_(options), backend_(backend) {}

  std::vector<Detection> detect(std::span<const ObjectView> images) {
    std::vector<ScannedView> scanned;
    for (std::size_t i = 0; i < images.size(); ++i)
      scanned.push_back({images[i], i < hits_.size() ? hits_[i] : std::vector<ScanHits>{}});
    scan_once(sets_, scanned.back(), backend_, options_.scan);
    hits_.push_back(scanned.back().hits);
    const std::vector<Detection> in_image =
        candidates_in_images(sets_, scanned, {}, backend_, options_);
    found_.insert(found_.end(), in_image.begin(), in_image.end());
    views_.push_back(images.back());
    return in_image;
  }
  const std::vector<Detection>& found() const { return found_; }
  const std::vector<ObjectView>& views() const { return views_; }

 private:
  std::span<const TemplateSet> sets_;
  DetectOptions options_;
  Backend& backend_;
  std::vector<std::vector<ScanHits>> hits_;  // [image][object]
  std::vector<Detection> found_;
  std::vector<ObjectView> views_;
};

std::vector<PoseEstimate> refine_all(const Collector& collector, std::span<const EdgeModel> models,
                                     std::span<const ObjectPose> known, Backend& backend,
                                     RefineOptions options) {
  std::vector<ObjectView> views = collector.views();
  for (ObjectView& view : views) view.occluders = make_occluders(models, known, view, backend);
  options.search.rotation_rad = 0;
  return refine_poses({models, views, backend}, object_poses(collector.found()), options);
}

void print_bin(int number, std::span<const TemplateSet> sets, Backend& backend) {
  const ExperimentSettings settings = ExperimentSettings::full_form();
  const Bin bin = make_bin(bin_types(), settings, number, backend.threads());
  ScoutOptions options = settings.scout;
  Collector collector(sets, options.pipeline.detect, backend);
  options.detect = [&](std::span<const int>, std::span<const ObjectView> images,
                       std::span<const ObjectPose>) { return collector.detect(images); };
  options.first_view = bin.first_view;
  options.next_view.strategy = Strategy::Fixed;
  options.particles.seed = std::uint64_t(bin.number) + 1;
  options.next_view.sequence = fixed_sequence(bin);
  const std::vector<EdgeModel> models = models_of(sets);
  Scout scout(sets, bin.cell->camera(), bin.cell->views(), options, backend);
  run_scout(scout, *bin.cell, [&](const ScoutState& state) {
    const std::size_t images = collector.views().size();
    if (images < 2 || images == 4) return;
    const std::vector<ObjectPose> known =
        known_objects(state.detections, options.known_probability);
    const std::vector<PoseEstimate> refined =
        refine_all(collector, models, known, backend, options.pipeline.detect.refine);
    for (const std::size_t i : without_collisions(refined, sets, models, backend))
      print_row(bin, is_right(refined[i], bin), refined[i].features);
  });
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: %s FIRST_BIN LAST_BIN\n", argv[0]);
    return 2;
  }
  try {
    const int first = std::stoi(argv[1]), last = std::stoi(argv[2]);
    const auto backend = make_cpu_backend(0);
    const std::vector<TemplateSet> sets = bin_templates(bin_types(), *backend);
    std::puts(
        "bin,views,right,speaking,log_psi_z_score,log_background_psi_z_score,unexplained_grey");
    for (int number = first; number <= last; ++number) print_bin(number, sets, *backend);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 2;
  }
}
