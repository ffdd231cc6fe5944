// edgescout bench experiments: runs every method of the paper's experiments on the same data.
#include <fmt/format.h>

#include <iostream>
#include <opencv2/core/utility.hpp>

#include "commit.h"
#include "host/cli/bench_verbs.h"
#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/help.h"
#include "host/cli/option_table.h"
#include "host/cli/progress.h"
#include "host/experiments/experiment.h"
#include "host/io/folder_lock.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct ExperimentsRequest {
  std::vector<std::string> names;
  std::string out, data, device = "cpu", edge_method = "gradient";
  bool is_short = false, is_full = false, resume = false, any_commit = false;
  int jobs = 0;
  ExperimentSettings settings;  // what was given on the command line
};

// The numbers that --short or --full sets and an option overrides.
constexpr std::pair<const char*, int ExperimentSettings::*> SIZES[] = {
    {"scenes", &ExperimentSettings::scenes},
    {"groups", &ExperimentSettings::groups},
    {"starts", &ExperimentSettings::starts},
    {"group-starts", &ExperimentSettings::group_starts},
    {"every", &ExperimentSettings::every},
    {"frames-every", &ExperimentSettings::frames_every},
    {"candidates", &ExperimentSettings::candidates},
    {"bins", &ExperimentSettings::bins},
    {"cad-bins", &ExperimentSettings::cad_bins},
};

ExperimentSettings settings_of(const ExperimentsRequest& request, const CLI::App& verb) {
  if (request.is_short && request.is_full)
    throw InputError("command line", "--short, --full", "both", "one of the two");
  for (const auto& [name, count] :
       {std::pair{"--bins", request.settings.bins}, {"--cad-bins", request.settings.cad_bins}})
    if (verb.count(name) > 0 && count > 0 && verb.count("--only-bins") > 0)
      throw InputError("command line", std::string(name) + ", --only-bins", "both",
                       "one of the two, or " + std::string(name) + " 0");
  ExperimentSettings settings = request.settings;
  const ExperimentSettings form =
      request.is_full ? ExperimentSettings::full_form() : ExperimentSettings::short_form();
  for (const auto& [name, size] : SIZES)
    if (verb.count(std::string("--") + name) == 0) settings.*size = form.*size;
  settings.data = request.data;
  settings.edges = edge_method_from_name(request.edge_method);
  return settings;
}

// One progress bar per experiment. The first call for an experiment gives the cells that an earlier
// run finished.
class Bars {
 public:
  void move_to(const std::string& experiment, std::size_t done, std::size_t all) {
    if (title_ != experiment) {
      bar_.reset();
      bar_ = std::make_unique<Progress>(experiment, all, std::cerr, stderr_is_terminal(), done);
      title_ = experiment;
    }
    bar_->move_to(done);
  }

 private:
  std::string title_;
  std::unique_ptr<Progress> bar_;
};

void run(const ExperimentsRequest& request, const CLI::App& verb) {
  cv::setNumThreads(1);  // cells run in parallel, and their times are those of one thread
  const FolderLock lock(request.out, 2);  // down to cells/NAME
  Bars bars;
  ExperimentRun run;
  run.out = request.out;
  run.device = request.device;
  run.commit = EDGESCOUT_COMMIT;
  run.resume = request.resume;
  run.any_commit = request.any_commit;
  run.jobs = request.jobs;
  run.progress = [&](const std::string& experiment, std::size_t done, std::size_t all) {
    bars.move_to(experiment, done, all);
  };
  run_experiments(experiments_named(request.names), settings_of(request, verb), run);
  std::cout << fmt::format("tables and plots: {}/index.md\n", request.out);
}

std::string names_text() {
  std::string text;
  for (const Experiment& experiment : experiments())
    text += (text.empty() ? "" : ", ") + experiment.name;
  return text;
}

void add_bin_options(CLI::App& verb, ExperimentSettings& s) {
  ScoutOptions& o = s.scout;
  OptionTable(verb, "Bins", OptionLevel::Expert)
      .flag("depth", s.depth,
            "Rendered bins have depth images, with a sensor's errors and a third of the parts "
            "missing")
      .bounded("max-views", o.max_views, 1, 32, "Number of images of a bin")
      .bounded("registered", o.pipeline.detect.candidates, 1, 100000,
               "Number of candidates of each image and type that are registered in full");
  CommandLineOptions add(verb, "Bins");
  describe_hits(o.pipeline.detect, add);
  describe(o, add);
  describe_ablations(o, add);
}

void add_sizes(CLI::App& verb, ExperimentsRequest& r) {
  ExperimentSettings& s = r.settings;
  OptionTable(verb, "Sizes (default: those of the form)")
      .flag("short", r.is_short, "Form that takes minutes (default)")
      .flag("full", r.is_full,
            "Form with the paper's numbers of images and a few bins: about an hour on two cores")
      .level(OptionLevel::Expert)
      .bounded("scenes", s.scenes, 1, 10000, "Number of images with up to five parts")
      .bounded("groups", s.groups, 1, 10000,
               "Number of groups of three images with up to twenty parts")
      .bounded("starts", s.starts, 1, 1000,
               "Number of registrations around every instance; the paper has 100")
      .bounded("group-starts", s.group_starts, 1, 1000,
               "Number of registrations around every instance of the groups")
      .bounded("every", s.every, 1, 10000,
               "Only recorded starts whose number this divides are used")
      .bounded("frames-every", s.frames_every, 1, 100,
               "Only photographs of the cat, and first views of a pile, whose number this divides "
               "are used")
      .bounded("candidates", s.candidates, 1, 100000,
               "Number of the detection's candidates in every image and for every type")
      .bounded("bins", s.bins, 0, 10000, "Number of bins of piled parts, for the next best view")
      .bounded("cad-bins", s.cad_bins, 0, 10000,
               "Number of bins with parts of DIR/cad, where --data is given")
      .bounded("image-scale", s.image_scale, 0.1, 2.0, "Scale of the paper's image sizes")
      .bounded("supersampling", s.supersampling, 1, 7,
               "Samples of a pixel along each axis of rendered images; odd");
}

void add_method_options(CLI::App& verb, ExperimentsRequest& r) {
  BaselineOptions& m = r.settings.methods;
  const std::string group = "Methods of registration, and FDCM";
  OptionTable(verb, group, OptionLevel::Expert)
      .choice("edges", r.edge_method, {"gradient", "lsd"},
              "Edge detector whose edges are registered to: gradient or lsd");
  CommandLineOptions add(verb, group);
  describe_values(r.settings.tensor, add);
  OptionTable(verb, group, OptionLevel::Expert)
      .bounded("associations", m.outer_iterations, 1, 1000,
               "Largest number of associations of the ICPs")
      .bounded("solve-steps", m.inner_iterations, 1, 1000,
               "Largest number of steps of one least-squares solve of a method")
      .bounded("loss-scale", m.loss_scale_px, 0.01, 1000.0,
               "Scale of the Huber loss of all methods but edgescout, px");
}

void add_run_options(CLI::App& verb, ExperimentsRequest& r) {
  verb.add_option("names", r.names, "Names of the experiments: " + names_text() + "; default: all")
      ->type_name("NAME");
  add_results_folder(verb, r.out);
  verb.add_option("--data", r.data,
                  "Folder with d2co-starts, brackets, cat, triangle and cad. Without it, only "
                  "rendered images are used")
      ->type_name("DIR");
  add_device(verb, r.device);
  OptionTable(verb, "Run")
      .flag("resume", r.resume, "Continue with the finished cells of the same settings in DIR")
      .bounded("jobs", r.jobs, 0, 1024,
               "Number of cells side by side on a CPU, each with up to 2 GB. 0: as many as it has "
               "threads")
      .level(OptionLevel::Expert)
      .flag("any-commit", r.any_commit,
            "With --resume, accept cells of another commit too; the report lists all commits")
      .bounded("seed", r.settings.seed, 0u, 4000000000u, "Seed of scenes, starts and candidates")
      .flag("times,!--no-times", r.settings.times,
            "Write measured times among the rows (default). Without them, two runs give the same "
            "bytes");
}

// An option of the group Bins with a list of values, separated by commas.
template <typename T>
CLI::Option* add_bin_list(CLI::App& verb, const std::string& name, std::vector<T>& list,
                          const std::string& help) {
  CLI::Option* option = verb.add_option(name, list, help);
  option->delimiter(',')->allow_extra_args(false)->group("Bins");
  mark_expert(verb, option);
  return option;
}

void add_bin_choices(CLI::App& verb, ExperimentSettings& s) {
  add_bin_list(verb, "--only-bins", s.only_bins,
               "Numbers of the bins, in place of the first --bins and --cad-bins. A kind that is "
               "given as 0 has none")
      ->type_name("NUMBER,..");
  add_bin_list(verb, "--searches", s.searches,
               "What is searched in the bins: one (a type, another from bin to bin), each (every "
               "type by itself), all (all types together); default: one,all")
      ->type_name("NAME,..");
  add_bin_list(verb, "--strategies", s.strategies,
               "Strategies in the bins: mi-max, random, dis, fixed (default: these) and "
               "clairvoyant, which knows the scene")
      ->type_name("NAME,..");
  OptionTable(verb, "Bins", OptionLevel::Expert)
      .bounded("random-draws", s.random_draws, 1, 100,
               "Number of runs of random in a bin. Those after the first take one more view each, "
               "for the mean at two views");
}

}  // namespace

void add_bench_experiments(CLI::App& bench, int& exit_code) {
  CLI::App* verb = bench.add_subcommand(
      "experiments", "Rerun the paper's experiments: tables, plots and every row behind them");
  auto request = std::make_shared<ExperimentsRequest>();
  add_run_options(*verb, *request);
  add_sizes(*verb, *request);
  add_method_options(*verb, *request);
  add_bin_choices(*verb, request->settings);
  add_bin_options(*verb, request->settings);
  verb->callback([request, verb, &exit_code] {
    run(*request, *verb);
    exit_code = exit_done;
  });
}

}  // namespace edgescout
