// Writes the log and the results of an active detection.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/cli/batch_settings.h"
#include "host/cli/scout_report.h"
#include "host/core/pose_error.h"
#include "host/io/bop.h"
#include "host/io/files.h"
#include "host/io/json_fields.h"
#include "host/io/json_text.h"
#include "host/io/results.h"

namespace edgescout {

using nlohmann::ordered_json;

namespace {

// 2: the field extrinsics_checks of a step had another name in 1.
constexpr int SCOUT_LOG_VERSION = 2;

ordered_json camera_json(const Camera& c) {
  return {{"width", c.width}, {"height", c.height}, {"fx", c.fx},
          {"fy", c.fy},       {"cx", c.cx},         {"cy", c.cy}};
}

ordered_json stages_json(const std::vector<StageSeconds>& stages) {
  ordered_json list = ordered_json::array();
  for (const StageSeconds& stage : stages)
    list.push_back({{"stage", stage.name}, {"ms", 1000 * stage.seconds}});
  return list;
}

ordered_json modes_json(const std::vector<ModeDetection>& modes, const ScoutReport& report) {
  ordered_json list = ordered_json::array();
  for (const ModeDetection& mode : modes) {
    const Detection& d = mode.detection;
    const Matrix6d transposed = d.covariance.transpose();  // Eigen stores by column
    ordered_json entry{{"object_id", report.sets[static_cast<std::size_t>(d.object)].object_id},
                       {"probability", d.probability},
                       {"weight", mode.weight},
                       {"psi", d.psi},
                       {"world_from_object", pose_json(d.world_from_object)},
                       {"covariance", std::vector<double>(transposed.data(),
                                                          transposed.data() + transposed.size())},
                       {"supporting_images", mode.supporting_images}};
    if (const auto off = distance_to_truth(d, report))
      entry["off_truth"] = {
          {"angle_rad", off->angle_rad}, {"distance_m", off->distance_m}, {"right", off->right}};
    list.push_back(entry);
  }
  return list;
}

// Returns one of the numbers of every view; null for a view that was not open.
ordered_json of_open_views(const std::vector<ViewInformation>& views,
                           double ViewInformation::*number) {
  ordered_json list = ordered_json::array();
  for (const ViewInformation& view : views)
    list.push_back(view.open ? ordered_json(view.*number) : ordered_json());
  return list;
}

// Share of the depth image's pixels that were measured; null without one.
ordered_json measured_share(const ScoutStep& step) {
  if (!step.depth) return {};
  const std::vector<float>& z_m = step.depth->image.z_m;
  const auto measured = std::ranges::count_if(z_m, [](float value) { return value > 0; });
  return static_cast<double>(measured) / static_cast<double>(z_m.size());
}

ordered_json step_json(const ScoutStep& step, const ScoutReport& report) {
  ordered_json extrinsics_checks = ordered_json::array();
  for (const ExtrinsicsCheck& view : step.extrinsics_checks)
    extrinsics_checks.push_back({{"residual_px", view.residual_px},
                                 {"objects", view.objects},
                                 {"missing", view.missing},
                                 {"disagrees", view.disagrees}});
  return {{"view", step.decision.view},
          {"strategy", to_string(step.decision.strategy)},
          {"information", of_open_views(step.decision.views, &ViewInformation::information)},
          {"information_unit", unit_of(step.decision)},
          {"information_share", of_open_views(step.decision.views, &ViewInformation::share)},
          {"discovery", of_open_views(step.decision.views, &ViewInformation::discovery)},
          {"motion_cost", of_open_views(step.decision.views, &ViewInformation::motion_cost)},
          {"decision_ms", stages_json(step.decision.stages)},
          {"camera_from_world", pose_json(step.camera_from_world)},
          {"timings_ms", stages_json(step.stages)},
          {"depth_measured", measured_share(step)},
          {"candidates_before", step.decision.candidates.size()},
          {"searches", step.searches},
          {"new_candidates", step.new_candidates},
          {"particles",
           {{"before", step.before.size()},
            {"after", step.after.size()},
            {"effective", step.update.effective},
            {"resampled", step.resampled},
            {"reseeded", step.update.reseeded}}},
          {"gained_nats", step.update.gained_nats},
          {"mode_probabilities", step.mode_probabilities},
          {"entropy_nats", step.entropy_nats},
          {"extrinsics_checks", extrinsics_checks},
          {"modes", modes_json(step.detections, report)}};
}

ImageResult result_of(const ScoutState& state, const ScoutStep& step, const ScoutReport& report) {
  const auto view = static_cast<std::size_t>(step.decision.view);
  ImageResult result;
  if (!report.image_files.empty()) result.image = report.image_files.at(view);
  result.scene_id = report.scene_id;
  result.image_id = report.image_ids.at(view);
  result.camera = report.camera;
  result.device = report.device;
  result.stages = step.stages;
  result.camera_from_world = step.camera_from_world;
  for (const TemplateSet& set : report.sets)
    result.objects.push_back({set.object_id, set.model.mesh.name});
  for (const ModeDetection& mode : state.detections) result.detections.push_back(mode.detection);
  return result;
}

std::filesystem::path view_file(const std::filesystem::path& folder, int view) {
  return folder / fmt::format("view_{:03}.json", view);
}

}  // namespace

std::string disagreeing_images(const ScoutState& state) {
  std::string images;
  if (state.steps.empty()) return images;
  const std::vector<ExtrinsicsCheck>& extrinsics_checks = state.steps.back().extrinsics_checks;
  for (std::size_t i = 0; i < extrinsics_checks.size(); ++i)
    if (extrinsics_checks[i].disagrees)
      images += fmt::format("{}{}", images.empty() ? "" : ", ", i + 1);
  return images;
}

const char* unit_of(const ScoutDecision& decision) {
  if (decision.strategy == Strategy::Information) return decision.use_paper_formula ? "" : "nats";
  return decision.strategy == Strategy::Disocclusion ? "points" : "";
}

std::optional<DistanceToTruth> distance_to_truth(const Detection& detection,
                                                 const ScoutReport& report) {
  std::optional<DistanceToTruth> nearest;
  for (std::size_t i = 0; i < report.truth.size(); ++i) {
    const TrueObject& truth = report.truth[i];
    if (truth.object != detection.object) continue;
    const PoseError error =
        pose_error(detection.world_from_object, truth.world_from_object,
                   report.sets[static_cast<std::size_t>(truth.object)].symmetries);
    if (!nearest || error.distance_m < nearest->distance_m)
      nearest = {i, error.angle_rad, error.distance_m, error.passes()};
  }
  return nearest;
}

void save_scout_log(const ScoutState& state, const ScoutReport& report,
                    const std::filesystem::path& folder) {
  ordered_json log{{"edgescout_scout", SCOUT_LOG_VERSION},
                   {"device", report.device},
                   {"source", report.source},
                   {"strategy", report.strategy},
                   {"camera", camera_json(report.camera)}};
  for (const auto& [name, value] : report.settings) log["settings"][name] = value;
  for (const auto& [name, value] : report.planning) log["planning"][name] = value;
  log["views"] = ordered_json::array();
  for (const Se3& view : state.views) log["views"].push_back(pose_json(view));
  log["steps"] = ordered_json::array();
  for (const ScoutStep& step : state.steps) log["steps"].push_back(step_json(step, report));
  log["failed"] = ordered_json::array();
  for (const FailedView& failed : state.failed)
    log["failed"].push_back({{"view", failed.view},
                             {"reason", failed.reason},
                             {"after_step", failed.after_step},
                             {"decision_ms", stages_json(failed.stages)}});
  log["detections"] = modes_json(state.detections, report);
  for (const TrueObject& truth : report.truth)
    log["truth"].push_back(
        {{"object_id", report.sets[static_cast<std::size_t>(truth.object)].object_id},
         {"world_from_object", pose_json(truth.world_from_object)}});
  if (!state.last_decision.stages.empty())
    log["last_decision"] = {
        {"information", of_open_views(state.last_decision.views, &ViewInformation::information)},
        {"motion_cost", of_open_views(state.last_decision.views, &ViewInformation::motion_cost)},
        {"decision_ms", stages_json(state.last_decision.stages)}};
  log["seconds"] = state.seconds();
  log["end"] = to_string(state.end);
  write_file_atomically(folder / "scout.json", json_text(log));
}

void remove_scout_results(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const fs::path log = folder / "scout.json";
  std::vector<fs::path> files{folder / "scout.state"};
  std::error_code unknown;
  if (fs::exists(log, unknown)) {
    const nlohmann::json old = read_json(log);
    for (const JsonField& step : JsonField{old, log.string(), ""}.at("steps").elements())
      files.push_back(view_file(folder, step.at("view").integer()));
    for (const char* name : {"results.csv", "scout.html", "scout.json"})
      files.push_back(folder / name);
  }
  remove_earlier_files(files);
}

void require_same_source(const Settings& settings, const std::filesystem::path& folder) {
  const std::string file = (folder / "scout.json").string();
  const nlohmann::json log = read_json(file);
  const JsonField fields{log, file, ""};
  if (const int version = int(fields.at("edgescout_scout").integer()); version != SCOUT_LOG_VERSION)
    throw InputError(file, "edgescout_scout", "version " + std::to_string(version),
                     fmt::format("{}: no --resume, or another --out", SCOUT_LOG_VERSION));
  const JsonField saved = fields.at("settings");
  Settings found;
  for (const auto& item : saved.value.items())
    found.emplace_back(item.key(), saved.at(item.key()).text());
  require_same(found, settings, file);
}

void save_scout_results(const ScoutState& state, const ScoutReport& report,
                        const std::filesystem::path& folder) {
  std::vector<BopResult> rows;
  for (const ScoutStep& step : state.steps) {
    const ImageResult result = result_of(state, step, report);
    save_image_result(result, view_file(folder, step.decision.view));
    for (const Detection& d : result.detections)
      rows.push_back({result.scene_id, result.image_id,
                      result.objects[static_cast<std::size_t>(d.object)].id, d.probability,
                      step.camera_from_world * d.world_from_object, state.seconds(), ""});
  }
  save_bop_results(rows, folder / "results.csv");
}

}  // namespace edgescout
