// edgescout scout: takes images from the next best view until the objects are found.
#include <fmt/format.h>

#include <iostream>

#include "host/active/camera_geometry_check.h"
#include "host/cli/batch_settings.h"
#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/help.h"
#include "host/cli/option_table.h"
#include "host/cli/scout_report.h"
#include "host/cli/scout_source.h"
#include "host/cli/stage_times.h"
#include "host/cli/template_sets.h"
#include "host/cli/verbs.h"
#include "host/core/log.h"
#include "host/io/files.h"
#include "host/io/folder_lock.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

struct ScoutRequest {
  SourceRequest source;
  ModelArguments models;
  TemplateOptions templates;
  ScoutOptions options;
  std::string device = "auto", out;
  std::vector<int> sequence;
  unsigned draws_seed = 1;
  bool resume = false, watch = false;
  Settings planning;  // of the groups that a resumed run may change
};

std::vector<Object> objects_of(const KnownModels& known) {
  std::vector<Object> objects = known.objects;
  for (const TemplateSet& set : known.sets)
    objects.push_back({set.object_id, set.model.mesh, set.symmetries});
  return objects;
}

// Distances that the user does not give: those of the views from the point that they look at, and
// 15 % more at both ends. If there is no such point, the distances stay at 0 and come from the
// objects' sizes. With a box they also stay at 0 and come from the box.
TemplateOptions with_distances_of(TemplateOptions options, const WorldPrior& prior,
                                  const std::vector<Se3>& views) {
  if (options.distance_min_m > 0 || options.distance_max_m > 0 || !prior.box_m.empty())
    return options;
  const std::optional<Eigen::Vector3d> center_m = looked_at_m(views);
  if (!center_m) {
    log(LogLevel::Warning,
        "the views look at no point in common: all distances are searched at which the objects "
        "span a twentieth to all of the image. Give --distance-min and --distance-max");
    return options;
  }
  double near_m = INFINITY, far_m = 0;
  for (const Se3& view : views) {
    const double distance_m = (view * *center_m).norm();
    near_m = std::min(near_m, distance_m);
    far_m = std::max(far_m, distance_m);
  }
  options.distance_min_m = 0.85 * near_m;
  options.distance_max_m = 1.15 * far_m;
  return options;
}

void check_views(const std::vector<Se3>& views, const DistanceRange& searched,
                 const ScoutSource& source) {
  std::vector<PosedCamera> cameras;
  for (const Se3& view : views) cameras.push_back({source.source->camera(), view});
  check_camera_poses(cameras, searched, source.name);
}

// Refuses options that would have no effect, or that would compare nats with points or ranks.
void refuse_unused_options(const ScoutRequest& request, const CLI::App& verb) {
  const Strategy strategy = request.options.next_view.strategy;
  const auto refuse = [&](const std::string& option, const char* expected) {
    if (verb.count(option) > 0)
      throw InputError("command line", option, "together with --strategy " + to_string(strategy),
                       expected);
  };
  if (strategy != Strategy::Fixed) refuse("--sequence", "fixed");
  if (strategy != Strategy::Information)
    for (const char* option : {"--min-information", "--metre-cost", "--radian-cost"})
      refuse(option, "mi-max");
}

// Options in a YAML file count as given.
void resolve_options(ScoutRequest& request, const CLI::App& verb) {
  ScoutOptions& o = request.options;
  o.next_view.sequence = request.sequence;
  refuse_unused_options(request, verb);
  o.next_view.seed = o.combinations.seed = o.particles.seed = request.draws_seed;
  if (!request.sequence.empty() && verb.count("--first-view") == 0)
    o.first_view = request.sequence.front();
  o.validate();
  request.templates.validate();
  for (auto& [name, value] : request.planning)
    if (name == "first-view") value = std::to_string(o.first_view);  // may be the sequence's
}

void require_known_views(const ScoutOptions& options, std::size_t count) {
  const auto require = [&](const char* option, int view) {
    if (view < 0 || view >= static_cast<int>(count))
      throw InputError("command line", option, std::to_string(view),
                       fmt::format("one of {} views", count));
  };
  require("--first-view", options.first_view);
  for (const int view : options.next_view.sequence) require("--sequence", view);
}

// Logs the result of an image. The scout itself logs a view that failed.
void log_step(const ScoutState& state) {
  const bool just_failed =
      !state.failed.empty() && state.failed.back().after_step == state.steps.size();
  if (state.steps.empty() || just_failed) return;
  const ScoutStep& step = state.steps.back();
  log(LogLevel::Info,
      fmt::format("image {} from view {}: {} objects, entropy {:.3f} nats", state.steps.size(),
                  step.decision.view, state.detections.size(), state.entropy_nats));
  log(LogLevel::Debug, fmt::format("decision: {}; image: {}", stage_times(step.decision.stages),
                                   stage_times(step.stages)));
}

void write_all(const ScoutState& state, const ScoutReport& report, const ScoutRequest& request,
               bool last, Backend& backend) {
  const fs::path out = request.out;
  // The state is written after the log: a run that finds a state needs the log to check its
  // settings.
  save_scout_log(state, report, out);
  save_scout_state(state, out / "scout.state");
  if (last) save_scout_results(state, report, out);
  if (last || request.watch)
    write_file_atomically(out / "scout.html", scout_page(state, report, !last, backend));
}

ScoutReport report_of(const ScoutRequest& request, const ScoutSource& source,
                      std::span<const TemplateSet> sets, const Backend& backend) {
  return {sets,
          undistorted(source.source->camera()),
          request.options.pipeline.edges,
          backend.name(),
          source.name,
          to_string(request.options.next_view.strategy),
          source.settings,
          request.planning,
          source.truth,
          source.image_ids,
          source.image_files,
          source.scene_id};
}

ScoutSource source_of(const ScoutRequest& request, const KnownModels& known, Backend& backend) {
  ScoutSource source = make_source(request.source, objects_of(known), backend.threads());
  std::ranges::copy(settings_of(known.sets), std::back_inserter(source.settings));
  const std::vector<Se3> views = source.source->views();
  require_known_views(request.options, views.size());
  validate_views(views, source.name);
  return source;
}

// The state of an earlier run to resume; nothing to start anew.
std::optional<ScoutState> state_to_resume(const ScoutRequest& request, const fs::path& file,
                                          const ScoutSource& source) {
  if (!request.resume || !fs::exists(file)) return std::nullopt;
  require_same_source(source.settings, request.out);
  return load_scout_state(file);
}

void print_summary(const ScoutState& state, const std::string& out) {
  const std::string images = disagreeing_images(state);
  std::cout << fmt::format(
      "{} objects in {} images, {} views failed{}, {:.1f} s, ended by: {}; results in {}\n",
      state.detections.size(), state.steps.size(), state.failed.size(),
      images.empty() ? "" : ", camera poses of images " + images + " disagree", state.seconds(),
      to_string(state.end), out);
}

int scout(ScoutRequest& request, const CLI::App& verb) {
  resolve_options(request, verb);
  const std::unique_ptr<Backend> backend = backend_of(request.device);
  const KnownModels known = load_models(request.models);
  const ScoutSource source = source_of(request, known, *backend);
  const fs::path file = fs::path(request.out) / "scout.state";
  const FolderLock lock(request.out);
  // Before the templates, which take long.
  std::optional<ScoutState> saved = state_to_resume(request, file, source);
  require_writable_folder(request.out);
  const std::vector<Se3> views = source.source->views();
  const SearchedImages searched{source.source->camera(), request.options.pipeline.detect.scan.world,
                                views};
  const TemplateOptions templates =
      known.objects.empty() ? request.templates
                            : with_distances_of(request.templates, searched.prior, views);
  check_views(views, searched_distances(known, templates, searched), source);
  const std::vector<TemplateSet> sets = template_sets_of(known, templates, searched, *backend,
                                                         make_template_cache(request.models.cache))
                                            .sets;
  Scout scout(sets, searched.camera, views, request.options, *backend);
  if (saved)
    scout.resume(std::move(*saved), file.string());
  else
    remove_scout_results(request.out);
  const ScoutReport report = report_of(request, source, sets, *backend);
  run_scout(scout, *source.source, [&](const ScoutState& state) {
    log_step(state);
    write_all(state, report, request, false, *backend);
  });
  const ScoutState& state = scout.state();
  write_all(state, report, request, true, *backend);
  print_summary(state, request.out);
  return state.steps.empty() || !state.failed.empty() ? exit_some_failed : exit_done;
}

void add_options(CLI::App& verb, ScoutRequest& r) {
  OptionTable(verb, "Run")
      .flag("watch", r.watch, "Write the page after every step, so that a browser follows it")
      .flag("resume", r.resume,
            "Continue from DIR/scout.state, if it exists, with the same source and detection. "
            "Budget, next view and information may differ");
  CommandLineOptions add(verb);
  describe_scout(r.options, add);
  CLI::Option* sequence =
      verb.add_option("--sequence", r.sequence,
                      "Numbers of the views that strategy fixed takes, in order; default: all");
  sequence->group("Next view");
  mark_expert(verb, sequence);
  OptionTable(verb, "Belief", OptionLevel::Expert)
      .bounded("draws-seed", r.draws_seed, 0u, 4000000000u,
               "Seed of particles, combinations and the views of strategy random");
  describe(r.templates, add);
}

}  // namespace

void add_scout(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "scout", "Take images from the next best view until the objects are found");
  auto request = std::make_shared<ScoutRequest>();
  add_source_options(*verb, request->source);
  add_model_arguments(*verb, request->models);
  add_results_folder(*verb, request->out);
  add_device(*verb, request->device);
  add_options(*verb, *request);
  verb->callback([request, verb, &exit_code] {
    // A resumed run may have another budget, another strategy and other options of the expected
    // information: they do not change earlier detections or the belief.
    std::set<std::string> groups{"Belief", "Templates", "Edges", "Tensor", "Detection", "Depth"};
    if (request->source.source == "cell")
      groups.insert({"Scene", "Image", "Arm", "Depth sensor"});
    else
      groups.insert("Images");
    request->source.settings = settings_of(*verb, groups);
    request->planning = settings_of(*verb, {"Information", "Next view", "Budget"});
    refuse_unused(*verb);
    refuse_options_without_depth(*verb);
    refuse_beside_templates(*verb);
    exit_code = scout(*request, *verb);
  });
}

}  // namespace edgescout
