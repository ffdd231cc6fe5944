#include "host/experiments/nbv.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>

#include "host/active/candidates.h"
#include "host/core/random.h"
#include "host/experiments/bin_score.h"
#include "host/experiments/bin_types.h"
#include "host/experiments/data_mark.h"
#include "host/experiments/photographed_bin.h"
#include "host/experiments/photographs.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Detects objects in the images of a bin. Each image is scanned for each type once; the hits serve
// all searches and strategies.
class Detector {
 public:
  Detector(const std::vector<TemplateSet>& sets, const DetectOptions& options, Backend& backend)
      : sets_(sets), options_(options), backend_(backend) {}
  // Detects `count` types from `first_type` on. Objects are counted from there.
  std::vector<Detection> find(std::span<const int> views, std::span<const ObjectView> images,
                              std::span<const ObjectPose> known, int first_type, int count) {
    std::vector<ScannedView> scanned;
    for (std::size_t i = 0; i < images.size(); ++i) {
      scanned.push_back({images[i], {}});
      for (int type = first_type; type < first_type + count; ++type)
        scanned[i].hits.push_back(hits(views[i], images[i], static_cast<std::size_t>(type)));
    }
    return candidates_in_images(std::span(sets_).subspan(static_cast<std::size_t>(first_type),
                                                         static_cast<std::size_t>(count)),
                                scanned, known, backend_, options_);
  }

 private:
  ScanHits hits(int view, const ObjectView& image, std::size_t type) {
    ScanHits& known = hits_[std::pair(view, type)];
    if (!known)
      known = std::make_shared<std::vector<ScanHit>>(
          coarse_scan(sets_[type], image, backend_, options_.scan));
    return known;
  }

  const std::vector<TemplateSet>& sets_;
  DetectOptions options_;
  Backend& backend_;
  std::map<std::pair<int, std::size_t>, ScanHits> hits_;
};

// The types of a bin's parts and their name in the rows.
struct BinParts {
  std::string name;
  std::vector<Object> types;
};

BinParts own_parts() { return {"own", bin_types()}; }
BinParts cad_parts(const std::filesystem::path& data) { return {"cad", cad_bin_types(data)}; }

// The types that are searched in a bin: `count` types from the first one.
struct Search {
  std::string name, parts;
  int count = 0, first_type = 0;
  std::span<const TemplateSet> sets;
  std::span<const Object> objects;
  std::vector<BinInstance> instances;  // objects counted from first_type
};

Search make_search(const std::string& name, const Bin& bin, const BinParts& parts, int first_type,
                   int count, std::span<const TemplateSet> sets) {
  Search search;
  search.name = name;
  search.parts = parts.name;
  search.count = count;
  search.first_type = first_type;
  search.sets =
      sets.subspan(static_cast<std::size_t>(search.first_type), static_cast<std::size_t>(count));
  search.objects =
      std::span(parts.types)
          .subspan(static_cast<std::size_t>(search.first_type), static_cast<std::size_t>(count));
  for (BinInstance instance : bin.instances) {
    instance.object -= search.first_type;
    if (instance.object >= 0 && instance.object < count) search.instances.push_back(instance);
  }
  return search;
}

// The searches named by ExperimentSettings::searches.
std::vector<Search> searches_of(const ExperimentSettings& s, const Bin& bin, const BinParts& parts,
                                std::span<const TemplateSet> sets) {
  const int types = static_cast<int>(sets.size());
  std::vector<Search> searches;
  for (const std::string& name : s.searches) {
    if (name == "one")
      searches.push_back(make_search(name, bin, parts, bin.number % types, 1, sets));
    if (name == "all") searches.push_back(make_search(name, bin, parts, 0, types, sets));
    for (int type = 0; name == "each" && type < types; ++type)
      searches.push_back(make_search(name, bin, parts, type, 1, sets));
  }
  return searches;
}

// The BOP ids of the types of a search.
std::string ids_text(const Search& search) {
  std::vector<int> ids;
  for (const Object& object : search.objects) ids.push_back(object.id);
  return fmt::format("{}", fmt::join(ids, " "));
}

// A strategy and the number of its draw, counted from 0.
struct Run {
  std::string strategy;
  int draw = 0;
};

ScoutOptions options_for(const ExperimentSettings& s, const Bin& bin, const Search& search,
                         Detector& detector, const Run& run) {
  ScoutOptions options = s.scout;
  options.detect = [&](std::span<const int> views, std::span<const ObjectView> images,
                       std::span<const ObjectPose> known) {
    return detector.find(views, images, known, search.first_type, search.count);
  };
  options.first_view = bin.first_view;
  const bool is_clairvoyant = run.strategy == CLAIRVOYANT;
  options.next_view.strategy = is_clairvoyant ? Strategy::Fixed : strategy_from(run.strategy);
  options.next_view.seed = options.combinations.seed = options.particles.seed =
      static_cast<std::uint64_t>(bin.number) + 1;
  if (run.draw > 0) {
    options.next_view.seed =
        Random(options.next_view.seed).split(static_cast<std::uint64_t>(run.draw)).bits();
    options.max_views = std::min(options.max_views, 2);
  }
  options.next_view.sequence = is_clairvoyant
                                   ? clairvoyant_sequence(bin, search.instances, s.scout.max_views)
                                   : fixed_sequence(bin);
  return options;
}

double seconds_of(const ScoutStep& step) {
  double seconds = 0;
  for (const auto* stages : {&step.decision.stages, &step.stages})
    for (const StageSeconds& stage : *stages) seconds += stage.seconds;
  return seconds;
}

void add_visibility(int view, const Bin& bin, std::vector<BinInstance>& instances) {
  const std::vector<double>& visible = bin.cell->visible(view);
  for (BinInstance& instance : instances)
    instance.most_visible = std::max(instance.most_visible, visible[instance.placed]);
}

// Adds two rows per step, for lightly and highly occluded instances. The first image is the same
// for all draws; only the first draw has its rows.
void add_rows(Table& table, const ExperimentSettings& s, const Bin& bin, const Search& search,
              const Run& run, const ScoutState& state) {
  std::vector<BinInstance> instances = search.instances;
  for (std::size_t i = 0; i < state.steps.size(); ++i) {
    const ScoutStep& step = state.steps[i];
    add_visibility(step.decision.view, bin, instances);
    if (run.draw > 0 && i == 0) continue;
    const BinScore score = score_bin(instances, step, search.objects, bin.cell->camera(),
                                     state.steps[0].camera_from_world);
    for (const auto& [group, tally] : {std::pair{"light", score.light}, {"heavy", score.heavy}})
      table.rows.push_back({std::to_string(bin.number), search.parts, std::to_string(bin.parts),
                            search.name, ids_text(search), run.strategy, std::to_string(run.draw),
                            std::to_string(i + 1), std::to_string(step.decision.view), group,
                            std::to_string(tally.instances), std::to_string(tally.correct),
                            std::to_string(tally.correct_px), std::to_string(tally.wrong),
                            std::to_string(tally.wrong_px), std::to_string(tally.followed),
                            std::to_string(tally.shown), number_text(step.entropy_nats),
                            s.times ? number_text(seconds_of(step)) : ""});
  }
}

int draws_of(const ExperimentSettings& s, const std::string& strategy) {
  return strategy == "random" ? s.random_draws : 1;
}

// Processes the first image once. Then every strategy continues from the state after it.
void run_search(Table& table, const ExperimentSettings& s, const Bin& bin, const Search& search,
                Detector& detector, Backend& backend) {
  const auto scout_for = [&](const Run& run) {
    return Scout(search.sets, bin.cell->camera(), bin.cell->views(),
                 options_for(s, bin, search, detector, run), backend);
  };
  Scout first = scout_for({s.strategies[0], 0});
  first.give(bin.first_view, bin.cell->acquire(bin.first_view));
  for (const std::string& strategy : s.strategies)
    for (int draw = 0; draw < draws_of(s, strategy); ++draw) {
      const Run run{strategy, draw};
      Scout scout = scout_for(run);
      scout.resume(first.state(), "first image");
      run_scout(scout, *bin.cell);
      add_rows(table, s, bin, search, run, scout.state());
    }
}

Table no_rows() {
  return {{},
          {"bin", "types", "parts", "search", "sought", "strategy", "draw", "views", "view",
           "group", "instances", "correct", "correct_px", "wrong", "wrong_px", "followed", "shown",
           "entropy_nats", "seconds"},
          {}};
}

Table run_bin(const ExperimentSettings& s, const BinParts& parts, int number, Backend& backend) {
  Table table = no_rows();
  const std::vector<TemplateSet> sets = bin_templates(parts.types, backend);
  const Bin bin = make_bin(parts.types, s, number, backend.threads());
  Detector detector(sets, s.scout.pipeline.detect, backend);
  for (const Search& search : searches_of(s, bin, parts, sets))
    run_search(table, s, bin, search, detector, backend);
  return table;
}

// A photographed pile has parts of one type only.
Table run_pile(ExperimentSettings s, const Photographs& pile, int first_view, Backend& backend) {
  Table table = no_rows();
  std::erase(s.strategies, CLAIRVOYANT);  // the visible fractions are unknown
  if (s.strategies.empty()) return table;
  const KnownScene scene = photographed_scene(pile);
  const BinParts parts{PHOTOGRAPHED_BINS, scene.objects};
  const std::vector<TemplateSet> sets = pile_templates(scene, backend);
  const Bin bin = photographed_bin(scene, first_view);
  Detector detector(sets, s.scout.pipeline.detect, backend);
  run_search(table, s, bin, make_search("one", bin, parts, 0, 1, sets), detector, backend);
  return table;
}

Notes options(const ExperimentSettings& s) {
  const ScoutOptions& o = s.scout;
  // Without the number of bins: more of them may be added to a finished run.
  Notes notes{
      {"image_scale", number_text(s.image_scale)},
      {"supersampling", std::to_string(s.supersampling)},
      {"searches", fmt::format("{}", fmt::join(s.searches, " "))},
      {"strategies", fmt::format("{}", fmt::join(s.strategies, " "))},
      {"random_draws", std::to_string(s.random_draws)},
      {"images", std::to_string(o.max_views)},
      {"detection", o.detect_in_every_image ? "every image" : "first image"},
      {"jointly", o.detect_jointly ? "yes" : "no"},
      {"scan_hits", std::to_string(o.pipeline.detect.scan.num_kept)},
      {"coarse-poses", std::to_string(o.pipeline.detect.coarse_poses)},
      {"medium-poses", std::to_string(o.pipeline.detect.medium_poses)},
      {"coarse_poses_joint", std::to_string(o.pipeline.detect.coarse_poses_joint)},
      {"medium_poses_joint", std::to_string(o.pipeline.detect.medium_poses_joint)},
      {"registered", std::to_string(o.pipeline.detect.candidates)},
      {"max_candidates", std::to_string(o.max_candidates)},
      {"particles", std::to_string(o.particles.count)},
      {"combinations", std::to_string(o.combinations.count)},
      {"combinations_by", o.probable_combinations ? "probability" : "psi"},
      {"sharpness", number_text(o.combinations.sharpness)},
      {"penetration_m", number_text(o.particles.penetration_m)},
      {"known_probability", number_text(o.known_probability)},
      {"max_searches", std::to_string(o.max_searches)},
      {"map_reduction", number_text(o.next_view.reduction)},
      {"chamfer_cap_px", number_text(o.next_view.cap_px)},
      {"sigma_px", number_text(o.next_view.sigma_px)},
      {"visibility_exponent", number_text(o.next_view.visibility_exponent)},
      {"view_correlation_angle_rad", number_text(o.next_view.view_correlation_angle_rad)},
      {"exploration_bonus_nats", number_text(o.next_view.exploration_bonus_nats)},
      {"exploration_correlation_angle_rad",
       number_text(o.next_view.exploration_correlation_angle_rad)},
      {"seen_px", number_text(o.next_view.seen_px)},
      {"formula", o.next_view.use_paper_formula ? "use_paper_formula" : "mutual information"},
      {"min_probability", number_text(o.detections.min_probability)}};
  if (s.depth) notes.emplace_back("depth", "yes");
  if (!s.data.empty()) notes.emplace_back("data", data_mark(s.data));
  return notes;
}

std::vector<Cell> cells(const ExperimentSettings& s) {
  if (s.bins == 0 && (s.cad_bins == 0 || s.data.empty()))
    throw InputError("experiments", "bins", "0", "at least one, where there are no CAD parts");
  std::vector<Cell> list;
  const auto add = [&](const std::string& name, const BinParts& parts,
                       const std::vector<int>& numbers) {
    for (const int number : numbers)
      list.push_back({fmt::format("{}_{:03}", name, number), [s, parts, number](Backend& backend) {
                        return run_bin(s, parts, number, backend);
                      }});
  };
  add("bin", own_parts(), s.bin_numbers(s.bins));
  if (s.data.empty()) return list;
  add("cad_bin", cad_parts(s.data), s.bin_numbers(s.cad_bins));
  if (!s.only_bins.empty()) return list;
  // Every photograph in turn is the first view; with frames_every only some of them.
  const Photographs pile = photographs_in(s.data, s.frames_every)[0];
  for (int view = 0; view < static_cast<int>(pile.images.size()); view += s.frames_every)
    list.push_back(
        {fmt::format("{}_pile_{:03}", pile.set, view),
         [s, pile, view](Backend& backend) { return run_pile(s, pile, view, backend); }});
  return list;
}

}  // namespace

Experiment nbv_experiment() {
  return {"nbv", "The next best view in bins of parts", options, cells, nbv_report};
}

}  // namespace edgescout
