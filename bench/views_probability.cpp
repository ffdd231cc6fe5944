// What the probability of a pose over several views (host/register/pose_classifier.h) is
// fitted on.
//
//   edgescout_bench_views_probability FIRST_BIN LAST_BIN > candidates.csv
//   scripts/fit_probability_over_views.py candidates.csv...
//
// The bins are those of `bench experiments nbv`, looked at along the fixed sequence. After two,
// three and five views everything that any image so far gave as a candidate is refined over all of
// them. Of candidates that reach into each other, or lie at one place, the one with the most
// evidence stays. A row each: is it right (0.1 rad and 5 mm, modulo symmetry), and sums over the
// views that speak. What is known and hides others is known by today's probability: another fit
// gives slightly other rows.
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>

#include "host/active/candidates.h"
#include "host/active/particles.h"
#include "host/active/scout.h"
#include "host/detect/plausible_pairs.h"
#include "host/register/pose_classifier.h"
#include "host/detect/suppression.h"
#include "host/eval/metrics.h"
#include "host/experiments/bin.h"
#include "host/experiments/bin_types.h"
#include "host/register/occluders.h"

namespace {

using namespace edgescout;

struct Candidates {
  std::vector<ObjectPose> poses;
  std::vector<std::vector<PoseFeatures>> by_view;
};

double total_evidence(std::span<const PoseFeatures> by_view) {
  return std::accumulate(by_view.begin(), by_view.end(), 0.0,
                         [](double sum, const PoseFeatures& f) { return sum + psi_z_score(f); });
}

// Best first, none inside or at the place of a better one.
std::vector<std::size_t> left_apart(const Candidates& all, std::span<const TemplateSet> sets,
                                    std::span<const EdgeModel> models, Backend& backend) {
  const BitMatrix plausible =
      plausible_pairs(models, all.poses, DEFAULT_PENETRATION_M, backend.threads());
  std::vector<std::size_t> order(all.poses.size()), chosen;
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return total_evidence(all.by_view[a]) > total_evidence(all.by_view[b]);
  });
  for (const std::size_t i : order) {
    const TemplateSet& set = sets[std::size_t(all.poses[i].object)];
    const bool apart = std::ranges::all_of(chosen, [&](std::size_t j) {
      return plausible.has(i, j) &&
             (all.poses[i].object != all.poses[j].object ||
              pose_distance_m(all.poses[i].world_from_object, all.poses[j].world_from_object,
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

void print_bin(int number, std::span<const TemplateSet> sets, Backend& backend) {
  const ExperimentSettings settings = ExperimentSettings::full_form();
  const Bin bin = make_bin(bin_types(), settings, number, backend.threads());
  ScoutOptions options = settings.scout;
  const PipelineOptions pipeline = options.pipeline;
  std::vector<Detection> found;
  std::vector<ObjectView> views;
  std::vector<std::vector<ScanHits>> hits;
  options.detect = [&](std::span<const int>, std::span<const ObjectView> images,
                       std::span<const ObjectPose>) {
    std::vector<ObjectView> scanned(images.begin(), images.end());
    for (std::size_t i = 0; i < hits.size(); ++i) scanned[i].hits = hits[i];
    scan_for(sets, scanned.back(), backend, pipeline.detect.scan);
    hits.push_back(scanned.back().hits);
    const std::vector<Detection> here =
        candidates_in_images(sets, scanned, {}, backend, pipeline.detect);
    found.insert(found.end(), here.begin(), here.end());
    views.push_back(scanned.back().view);
    return here;
  };
  options.first_view = bin.first_view;
  options.next_view.strategy = Strategy::Fixed;
  options.particles.seed = std::uint64_t(bin.number) + 1;
  options.next_view.sequence = fixed_sequence(bin);
  const std::vector<EdgeModel> models = models_of(sets);
  Scout scout(sets, bin.cell->camera(), bin.cell->views(), options, backend);
  run_scout(scout, *bin.cell, [&](const ScoutState& state) {
    if (views.size() < 2 || views.size() == 4) return;
    const std::vector<ObjectPose> known =
        known_objects(state.detections, options.known_probability);
    std::vector<ObjectView> seen = views;
    for (ObjectView& view : seen) view.occluders = make_occluders(models, known, view, backend);
    Candidates all{poses_of(found), {}};
    RefineOptions refine = pipeline.detect.refine;
    refine.search.rotation_rad = 0;
    const std::vector<PoseEstimate> refined = refine_poses(models, all.poses, seen, backend, refine);
    for (std::size_t i = 0; i < refined.size(); ++i) {
      all.poses[i].world_from_object = refined[i].world_from_object;
      all.by_view.push_back(refined[i].by_view);
    }
    for (const std::size_t i : left_apart(all, sets, models, backend))
      print_row(bin, is_right(all.poses[i], bin), all.by_view[i]);
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
