// The fixed benchmark of the next best view: rendered bins of piled parts, the strategies side by side (paper, Sec. 6.4, figure 15).
//
//   edgescout_bench_bins --out bins.csv [--scenes 30] [--sought 1 3] [--strategies mi-max random dis fixed] [--resume] [--images DIR] [--help]
//
// Every bin has parts of all types, piled among foreign parts on a printed board, and a hemisphere of views around it. All strategies start from one and the same belief: what was
// found in the first image, where "sought" types are searched for: one (another from bin to bin) or all. Images of a view are the same for all.
// After every view the reported instances are compared with the truth; one row of the CSV is
//   scene, sought types, strategy, views so far, the last of them, group of instances (bins_judge.h), its counts, entropy and seconds of that view,
// written after each strategy, so that an interrupted run goes on with --resume. scripts/plot_bins.py draws it. Seconds by stage go to standard output.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include "bench/bins_judge.h"
#include "bench/bins_settings.h"
#include "host/active/candidates.h"
#include "host/io/image.h"
#include "host/render/renderer.h"
#include "kernels/error.h"

namespace {

using namespace edgescout;
using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// A simulated cell whose images are rendered once, however many strategies or, with a folder, runs ask for them.
class Cell : public ViewSource {
 public:
  Cell(const Scene& scene, std::vector<Se3> views, std::string folder, ThreadPool& pool)
      : cell_(scene, scene.views[0].camera, std::move(views), {}, pool), folder_(std::move(folder)) {
    if (!folder_.empty()) std::filesystem::create_directories(folder_);
  }
  Camera camera() const override { return cell_.camera(); }
  std::vector<Se3> views() const override { return cell_.views(); }
  Shot acquire(int view) override {
    if (const auto known = shots_.find(view); known != shots_.end()) return known->second;
    const auto start = Clock::now();
    shots_[view] = kept_or_rendered(view);
    seconds_ += seconds_since(start);
    return shots_[view];
  }
  double seconds() const { return seconds_; }  // of rendering

 private:
  Shot kept_or_rendered(int view) {
    if (folder_.empty()) return cell_.acquire(view);
    const std::string file = folder_ + "/" + std::to_string(view) + ".png";
    if (std::filesystem::exists(file)) return {load_image(file), cell_.views()[static_cast<std::size_t>(view)]};
    const Shot shot = cell_.acquire(view);
    save_png(shot.image, file);
    return shot;
  }

  SimulatedCell cell_;
  std::string folder_;
  std::map<int, Shot> shots_;
  double seconds_ = 0;
};

// What is found in the image of a view, once for all strategies that look there.
class Detector {
 public:
  Detector(std::span<const TemplateSet> sets, Backend& backend, const DetectOptions& options) : sets_(sets), backend_(backend), options_(options) {}
  std::vector<Detection> operator()(int view, const Observation& observation) {
    if (const auto known = found_.find(view); known != found_.end()) return known->second;
    return found_[view] = candidates_in_image(sets_, observation, backend_, options_);
  }

 private:
  std::span<const TemplateSet> sets_;
  Backend& backend_;
  DetectOptions options_;
  std::map<int, std::vector<Detection>> found_;
};

struct Bin {
  int number = 0, first_view = 0;
  Scene scene;
  std::unique_ptr<Cell> cell;
  std::vector<Instance> instances;
};

Bin make_bin(const BinsSettings& s, std::span<const Object> objects, int number, ThreadPool& pool) {
  Bin bin;
  bin.number = number;
  Random random = Random(s.render.seed).split("bin").split(static_cast<std::uint64_t>(number));
  RenderOptions render = s.render;
  render.seed = 1000 * s.render.seed + static_cast<unsigned>(number);
  render.objects = s.fewest_parts + random.below(s.most_parts - s.fewest_parts + 1);
  render.min_distance_m = render.max_distance_m = s.hemisphere.radius_m;
  bin.first_view = random.below(s.hemisphere.count);
  bin.scene = make_scene(objects, render);
  const std::vector<Se3> views = hemisphere_views(s.hemisphere);
  bin.cell = std::make_unique<Cell>(bin.scene, views, s.images.empty() ? "" : images_folder(s) + "/" + std::to_string(number), pool);
  Scene first = bin.scene;
  first.views = {{bin.cell->camera(), views[static_cast<std::size_t>(bin.first_view)]}};
  first.options.supersampling = 1;  // the truth at the pixels' centres alone
  const std::vector<double> visible = edgescout::render(first, pool)[0].visible_fraction;
  for (std::size_t i = 0; i < bin.scene.placed.size(); ++i)
    if (const PlacedObject& placed = bin.scene.placed[i]; placed.target) bin.instances.push_back({placed.object, placed.world_from_object, visible[i]});
  return bin;
}

// What is searched for in a bin: `count` types from the one whose turn it is.
struct Search {
  int count = 0, first_type = 0;
  std::span<const TemplateSet> sets;
  std::span<const Object> objects;
  std::vector<Instance> instances;  // objects counted from first_type
};

Search make_search(const Bin& bin, int count, std::span<const TemplateSet> sets, std::span<const Object> objects) {
  Search search;
  search.count = count;
  const int types = static_cast<int>(sets.size());
  if (count != 1 && count != types) throw InputError("command line", "--sought", std::to_string(count), "1 or " + std::to_string(types));
  search.first_type = count == 1 ? bin.number % types : 0;
  search.sets = sets.subspan(static_cast<std::size_t>(search.first_type), static_cast<std::size_t>(count));
  search.objects = objects.subspan(static_cast<std::size_t>(search.first_type), static_cast<std::size_t>(count));
  for (Instance instance : bin.instances) {
    instance.object -= search.first_type;
    if (instance.object >= 0 && instance.object < count) search.instances.push_back(instance);
  }
  return search;
}

ScoutOptions options_for(const BinsSettings& s, const Bin& bin, Detector& detector, const std::string& strategy) {
  ScoutOptions options = s.scout;
  options.detect = [&](int view, const Observation& observation) { return detector(view, observation); };
  options.first_view = bin.first_view;
  options.next_view.strategy = strategy_from(strategy);
  options.next_view.seed = options.combinations.seed = options.particles.seed = static_cast<std::uint64_t>(bin.number) + 1;
  // A fixed sequence that goes around and through the rings, as somebody would lay it out.
  const int stride = 13;
  for (int i = 0; i < s.hemisphere.count; ++i) options.next_view.sequence.push_back((bin.first_view + i * stride) % s.hemisphere.count);
  return options;
}

double seconds_of(const ScoutStep& step) {
  double seconds = 0;
  for (const auto* stages : {&step.decision.stages, &step.stages})
    for (const StageSeconds& stage : *stages) seconds += stage.seconds;
  return seconds;
}

std::string rows_of(const Bin& bin, const Search& search, const std::string& strategy, const ScoutState& state) {
  std::ostringstream rows;
  for (std::size_t i = 0; i < state.steps.size(); ++i) {
    const ScoutStep& step = state.steps[i];
    const Judgement judgement = judge(search.instances, step, search.objects, bin.cell->camera(), state.steps[0].camera_from_world);
    for (const auto& [group, tally] : {std::pair{"light", judgement.light}, {"heavy", judgement.heavy}})
      rows << bin.number << ',' << search.count << ',' << strategy << ',' << i + 1 << ',' << step.decision.view << ',' << group << ',' << tally.instances << ',' << tally.correct
           << ',' << tally.correct_px << ',' << tally.wrong << ',' << tally.wrong_px << ',' << tally.followed << ',' << step.entropy_nats << ',' << seconds_of(step) << '\n';
  }
  return rows.str();
}

constexpr const char* HEADER = "scene,sought,strategy,views,view,group,instances,correct,correct_px,wrong,wrong_px,followed,entropy_nats,seconds\n";

// Seconds by stage of the steps from `first` on.
void print_times(const std::string& what, const ScoutState& state, std::size_t first) {
  std::vector<std::string> names;
  std::map<std::string, double> seconds;
  double sum = 0;
  for (std::size_t i = first; i < state.steps.size(); ++i)
    for (const auto* stages : {&state.steps[i].decision.stages, &state.steps[i].stages})
      for (const StageSeconds& stage : *stages) {
        if (!seconds.contains(stage.name)) names.push_back(stage.name);
        seconds[stage.name] += stage.seconds;
        sum += stage.seconds;
      }
  std::printf("  %-10s %5.1f s:", what.c_str(), sum);
  for (const std::string& name : names) std::printf(" %s %.2f", name.c_str(), seconds[name]);
  std::printf("\n");
}

// The CSV that grows; what it holds is not done again.
class Table {
 public:
  Table(const BinsSettings& s) : rows_a_run_(2 * s.scout.max_views) {
    std::string text = HEADER, line;
    std::map<std::string, std::string> runs;
    std::map<std::string, int> rows;
    if (std::ifstream old(s.out); s.resume && std::getline(old, line))
      while (std::getline(old, line)) {
        const std::string key = line.substr(0, line.find(',', line.find(',', line.find(',') + 1) + 1));
        runs[key] += line + "\n";
        ++rows[key];
      }
    for (const auto& [key, lines] : runs)
      if (rows[key] == rows_a_run_) done_.insert(key), text += lines;
    file_.open(s.out, std::ios::trunc);
    file_ << text << std::flush;
    if (!file_) throw InputError(s.out, "file", "not writable", "a file to write");
  }
  bool has(int scene, int sought, const std::string& strategy) const {
    return done_.contains(std::to_string(scene) + "," + std::to_string(sought) + "," + strategy);
  }
  void add(const std::string& rows) { file_ << rows << std::flush; }

 private:
  int rows_a_run_;
  std::set<std::string> done_;
  std::ofstream file_;
};

// The first image once, then every strategy from what was known after it.
void run_search(const BinsSettings& s, const Bin& bin, const Search& search, Table& table, Backend& backend) {
  std::vector<std::string> missing;
  for (const std::string& strategy : s.strategies)
    if (!table.has(bin.number, search.count, strategy)) missing.push_back(strategy);
  if (missing.empty()) return;
  Detector detector(search.sets, backend, s.scout.pipeline.detect);
  Scout first(search.sets, bin.cell->camera(), bin.cell->views(), options_for(s, bin, detector, missing[0]), backend);
  first.give(bin.first_view, bin.cell->acquire(bin.first_view).image);
  print_times("first", first.state(), 0);
  for (const std::string& strategy : missing) {
    Scout scout(search.sets, bin.cell->camera(), bin.cell->views(), options_for(s, bin, detector, strategy), backend);
    scout.resume(first.state(), "first image");
    run_scout(scout, *bin.cell);
    table.add(rows_of(bin, search, strategy, scout.state()));
    print_times(strategy, scout.state(), 1);
  }
}

int run(BinsSettings& s) {
  const std::vector<Object> objects = objects_of(s);
  s.templates.distance_min_m = s.hemisphere.radius_m - s.depth_margin_m;
  s.templates.distance_max_m = s.hemisphere.radius_m + s.depth_margin_m;
  const std::unique_ptr<Backend> backend = make_backend(s.device);
  std::vector<TemplateSet> sets;
  for (const Object& object : objects) sets.push_back(build_templates(object, s.templates, *backend));
  Table table(s);
  for (int number = s.first_scene; number < s.first_scene + s.scenes; ++number) {
    const auto start = Clock::now();
    const Bin bin = make_bin(s, objects, number, backend->threads());
    std::printf("bin %d: %d parts\n", number, bin.scene.options.objects);
    for (const int count : s.sought) run_search(s, bin, make_search(bin, count, sets, objects), table, *backend);
    std::printf("  %.1f s, %.1f of them rendering\n", seconds_since(start), bin.cell->seconds());
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  BinsSettings settings;
  CLI::App app("Rendered bins, searched with one strategy of the next view after the other");
  add_options(app, settings);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(settings);
  } catch (const std::exception& error) {
    std::cerr << "edgescout_bench_bins: error: " << error.what() << "\n";
    return 2;
  }
}
