// edgescout bench experiments: runs every method of the paper's experiments on the same data.
#include <fmt/format.h>

#include <iostream>
#include <opencv2/core/utility.hpp>

#include "commit.h"
#include "host/cli/bench_verbs.h"
#include "host/cli/config.h"
#include "host/cli/exit_codes.h"
#include "host/cli/pipeline_options.h"
#include "host/cli/progress.h"
#include "host/experiments/experiment.h"
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

void add_bin_options(CLI::App& verb, ScoutOptions& o) {
  OptionTable(verb, "Bins").bounded("max-views", o.max_views, 1, 32, "Images");
  add_hit_options(verb, "Bins", o.pipeline.detect);
  OptionTable(verb, "Bins")
      .bounded("registered", o.pipeline.detect.candidates, 1, 100000,
               "Candidates of an image and type that are registered");
  add_belief_options(verb, o);
}

void add_sizes(CLI::App& verb, ExperimentsRequest& r) {
  ExperimentSettings& s = r.settings;
  OptionTable(verb, "Sizes (default: those of the form)")
      .flag("short", r.is_short, "Minutes (default)")
      .flag("full", r.is_full,
            "The paper's numbers of images, and a few bins: about an hour on two cores")
      .bounded("scenes", s.scenes, 1, 10000, "Images with up to five parts")
      .bounded("groups", s.groups, 1, 10000, "Groups of three images with up to twenty parts")
      .bounded("starts", s.starts, 1, 1000,
               "Registrations around every instance; the paper has 100")
      .bounded("group-starts", s.group_starts, 1, 1000, "The same in the groups")
      .bounded("every", s.every, 1, 10000, "Of the recorded starts those whose number this divides")
      .bounded("frames-every", s.frames_every, 1, 100,
               "Of the cat's photographs one in so many, and of a pile's as the first view")
      .bounded("candidates", s.candidates, 1, 100000,
               "Of the detection, in every image and for every type")
      .bounded("bins", s.bins, 0, 10000, "Of piled parts, for the next best view")
      .bounded("cad-bins", s.cad_bins, 0, 10000,
               "The same with parts of DIR/cad, where there is --data")
      .bounded("image-scale", s.image_scale, 0.1, 2.0, "Of the paper's image sizes")
      .bounded("supersampling", s.supersampling, 1, 7,
               "Samples a pixel and axis of rendered images; odd");
}

void add_method_options(CLI::App& verb, ExperimentsRequest& r) {
  BaselineOptions& m = r.settings.methods;
  const std::string group = "Methods of registration, and FDCM";
  OptionTable(verb, group)
      .choice("edges", r.edge_method, {"gradient", "lsd"}, "Edges that are registered to");
  add_tensor_value_options(verb, group, r.settings.tensor);
  OptionTable(verb, group)
      .bounded("associations", m.outer_iterations, 1, 1000, "Of the ICPs, at most")
      .bounded("solve-steps", m.inner_iterations, 1, 1000,
               "Of one least-squares solve of a method, at most")
      .bounded("loss-scale", m.loss_scale_px, 0.01, 1000.0,
               "Of the Huber loss of all but edgescout, px");
}

void add_run_options(CLI::App& verb, ExperimentsRequest& r) {
  verb.add_option("names", r.names, "Of the experiments: " + names_text() + "; default: all")
      ->type_name("NAME");
  verb.add_option("--out", r.out, "Folder of the results")->required()->type_name("DIR");
  verb.add_option("--data", r.data,
                  "Folder with d2co-starts, brackets, cat, triangle and cad; without it rendered "
                  "images alone")
      ->type_name("DIR");
  verb.add_option("--device", r.device, "auto, cpu, cpu-reference, vulkan or vulkan:INDEX")
      ->capture_default_str();
  OptionTable(verb, "Run")
      .flag("resume", r.resume, "Go on where DIR has finished cells of the same settings")
      .flag("any-commit", r.any_commit,
            "With --resume: also where these are of another commit; the report lists all of them")
      .bounded("jobs", r.jobs, 0, 1024,
               "Cells side by side on a CPU, each with up to 2 GB; 0: as many as it has threads")
      .bounded("seed", r.settings.seed, 0u, 4000000000u, "Of scenes, starts and candidates")
      .flag("times,!--no-times", r.settings.times,
            "Measured times among the rows (default); without, two runs give the same bytes");
}

// An option of the group Bins with a list of values, separated by commas.
template <typename T>
void add_bin_list(CLI::App& verb, const std::string& name, std::vector<T>& list,
                  const std::string& type_name, const std::string& help) {
  verb.add_option(name, list, help)
      ->type_name(type_name)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->group("Bins");
}

void add_bin_choices(CLI::App& verb, ExperimentSettings& s) {
  add_bin_list(
      verb, "--only-bins", s.only_bins, "NUMBER,..",
      "These, in place of the first --bins and --cad-bins; of a kind that is given as 0 none");
  add_bin_list(verb, "--searches", s.searches, "NAME,..",
               "In the bins: of one (type, another from bin to bin), each (type by itself) and "
               "all (together); "
               "default: one,all");
  add_bin_list(verb, "--strategies", s.strategies, "NAME,..",
               "In the bins: of mi-max, random, dis, fixed (default: these) and clairvoyant, "
               "which knows "
               "the scene");
  OptionTable(verb, "Bins")
      .bounded("random-draws", s.random_draws, 1, 100,
               "Of random in a bin: those after the first look once more each, for the mean at two "
               "views");
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
  add_bin_options(*verb, request->settings.scout);
  verb->callback([request, verb, &exit_code] {
    run(*request, *verb);
    exit_code = exit_done;
  });
}

}  // namespace edgescout
