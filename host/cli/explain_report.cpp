#include "host/cli/explain_report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "host/io/json_fields.h"
#include "host/register/pose_classifier.h"

namespace edgescout {

namespace {

using nlohmann::ordered_json;

constexpr int format_version = 1;
constexpr std::size_t stage_count = std::size_t(LossStage::Reported);  // that may lose a pose

int percent(double part, double whole) {
  return whole > 0 ? int(std::lround(100 * part / whole)) : 0;
}

std::string off(const FoundPose& pose) {
  return fmt::format("{:.3f} rad, {:.1f} mm, {:.1f} px off", pose.error.angle_rad,
                     1000 * pose.error.distance_m, pose.mspd_px);
}

std::string features_text(const FoundPose& pose) {
  return fmt::format("{:.2f} (psi {:.2f}, z-score {:.1f}, mean {:.2f} px, unexplained grey {:.2f})",
                     pose.probability, pose.features.psi, psi_z_score(pose.features),
                     pose.features.mean_px, unexplained_grey(pose.features.shading));
}

std::string range_text(const RangeReport& r) {
  return fmt::format(
      "{:.3f} m away, searched {:.3f} to {:.3f} m; {:.2f} rad from a viewpoint{}{}{}", r.distance_m,
      r.distance_min_m, r.distance_max_m, r.viewpoint_angle_rad,
      r.in_viewpoints ? "" : ", not searched from there",
      r.in_region ? "" : "; its centre is outside the searched region",
      r.in_prior ? "" : "; outside --world-box or --world-plane");
}

std::string edges_text(const EdgesReport& e) {
  return fmt::format("edges support {} % of {:.0f} points, {} % of the best copy beside it{}",
                     percent(e.support.support, 1), e.in_image,
                     percent(e.support.best_displaced, 1),
                     e.in_image < e.visible
                         ? fmt::format("; {} % are in the image", percent(e.in_image, e.visible))
                         : "");
}

std::string scan_text(const ScanReport& s) {
  const std::string best = s.rank
                               ? fmt::format("the best of {} hits near it has rank {}, {:.2f} px",
                                             s.hits, *s.rank, s.mean_px)
                               : fmt::format("none of {} hits is near it", s.hits);
  return fmt::format("{}; itself {:.2f} px; {} are aligned, {} of them near it", best,
                     s.own_mean_px, s.aligned, s.aligned_near);
}

std::string support_text(const SupportReport& s) {
  return fmt::format(
      "log-odds by edge support {:.2f}, itself {:.2f}, the last of {} {:.2f}; {} near "
      "it go on",
      s.best_near, s.own, s.medium, s.last, s.medium_near);
}

std::string alignment_text(const AlignmentReport& a) {
  std::string text = fmt::format("{} aligned poses are the same", a.same);
  if (a.nearest) text += "; the nearest is " + off(*a.nearest);
  if (a.same == 0 && a.best_hit_became) text += "; the best hit went " + off(*a.best_hit_became);
  return text;
}

std::string ranking_text(const RankingReport& r) {
  const std::string best = r.rank ? fmt::format("rank {}, log-odds {:.2f}", *r.rank, r.log_odds)
                                  : "no aligned pose is the same";
  return fmt::format("{}; itself {:.2f}; the last of {} candidates {:.2f}", best, r.own_log_odds,
                     r.candidates, r.last_log_odds);
}

std::string refinement_text(const RefinementReport& r) {
  const std::optional<FoundPose>& best = r.same ? r.same : r.nearest;
  return fmt::format("{}; itself {}",
                     best ? (r.same ? "" : "the nearest is ") + off(*best) : "no candidate",
                     off(r.own));
}

std::string probability_text(const RefinementReport& r, const SelectionReport& s) {
  const std::string shared =
      s.shared_probability ? fmt::format("; {:.2f} once it shares its odds with {} alternatives",
                                         *s.shared_probability, s.alternatives)
                           : "";
  return fmt::format("{}{}; itself {}", r.same ? features_text(*r.same) : "no pose", shared,
                     features_text(r.own));
}

std::string selection_text(const SelectionReport& s, LossStage lost_at) {
  if (!s.competes)
    return lost_at == LossStage::Selection ? "a duplicate of a better pose" : "does not compete";
  const std::string claimed =
      fmt::format("others claim {} % of its edges", int(std::lround(100 * s.claimed)));
  if (s.selected)
    return fmt::format("detection {}{}: {}, probability {:.2f}; {}", s.rank,
                       s.is_reported ? "" : ", more than are reported", off(*s.selected),
                       s.selected->probability, claimed);
  return claimed + (s.above_chance ? "" : "; its psi does not exceed chance");
}

// The numbers of a stage that may lose a pose.
std::string text_of(LossStage stage, const LossReport& report) {
  switch (stage) {
    case LossStage::Range:
      return range_text(report.range);
    case LossStage::Edges:
      return edges_text(report.edges);
    case LossStage::Scan:
      return scan_text(report.scan);
    case LossStage::Support:
      return support_text(report.support);
    case LossStage::Alignment:
      return alignment_text(report.alignment);
    case LossStage::Ranking:
      return ranking_text(report.ranking);
    case LossStage::Refinement:
      return refinement_text(report.refinement);
    case LossStage::Probability:
      return probability_text(report.refinement, report.selection);
    default:
      return selection_text(report.selection, report.lost_at);
  }
}

std::string rival_text(const ExplainedPose& pose) {
  const Rival& rival = *pose.report.rival;
  std::string text = rival.object == pose.given.object ? off(rival) : "another object";
  text += "; probability " + features_text(rival);
  if (rival.claimed > 0)
    text += fmt::format("; claims {} % of the edges", int(std::lround(100 * rival.claimed)));
  if (rival.is_restarted) text += "; from a turned start";
  return text;
}

std::string place_of(const ExplainedPose& pose) {
  return fmt::format("{}, object {}", pose.image.string(), pose.object_id);
}

std::string fate_of(const LossReport& report) {
  return report.lost_at == LossStage::Reported ? "reported"
                                               : "lost at " + to_string(report.lost_at);
}

// How many poses had each fate, by LossStage.
using Fates = std::array<int, stage_count + 1>;

std::map<std::string, Fates> count_fates(std::span<const ExplainedPose> poses) {
  std::map<std::string, Fates> fates;
  for (const ExplainedPose& pose : poses)
    for (const std::string& object : {std::to_string(pose.object_id), std::string("all")})
      ++fates[object][std::size_t(pose.report.lost_at)];
  return fates;
}

int count_of(const Fates& fates) {
  int count = 0;
  for (const int of_stage : fates) count += of_stage;
  return count;
}

ordered_json found_json(const FoundPose& pose, int object) {
  ordered_json fields{{"camera_from_object", pose_json(pose.world_from_object)}};
  if (pose.object == object) {
    fields["angle_rad"] = pose.error.angle_rad;
    fields["distance_m"] = pose.error.distance_m;
    fields["mspd_px"] = pose.mspd_px;
  }
  fields["probability"] = pose.probability;
  fields["psi"] = pose.features.psi;
  fields["psi_z_score"] = psi_z_score(pose.features);
  fields["mean_px"] = pose.features.mean_px;
  fields["unexplained_grey"] = unexplained_grey(pose.features.shading);
  fields["in_image"] = pose.features.in_image;
  return fields;
}

ordered_json found_json(const std::optional<FoundPose>& pose, int object) {
  return pose ? found_json(*pose, object) : ordered_json();
}

template <typename T>
ordered_json or_null(const std::optional<T>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json range_json(const RangeReport& r) {
  return {{"distance_m", r.distance_m},         {"distance_min_m", r.distance_min_m},
          {"distance_max_m", r.distance_max_m}, {"viewpoint_angle_rad", r.viewpoint_angle_rad},
          {"in_distances", r.in_distances},     {"in_viewpoints", r.in_viewpoints},
          {"in_region", r.in_region},           {"in_prior", r.in_prior}};
}

ordered_json edges_json(const EdgesReport& r) {
  return {{"visible", r.visible},
          {"in_image", r.in_image},
          {"log_ratio", r.support.log_ratio},
          {"support", r.support.support},
          {"best_displaced", r.support.best_displaced}};
}

ordered_json scan_json(const ScanReport& r) {
  return {{"hits", r.hits},
          {"aligned", r.aligned},
          {"aligned_near", r.aligned_near},
          {"rank", or_null(r.rank)},
          {"mean_px", r.rank ? ordered_json(r.mean_px) : ordered_json()},
          {"own_mean_px", r.own_mean_px}};
}

ordered_json support_json(const SupportReport& r, bool is_aligned_near) {
  return {{"medium", r.medium},
          {"medium_near", r.medium_near},
          {"best_near", is_aligned_near ? ordered_json(r.best_near) : ordered_json()},
          {"own", r.own},
          {"last", r.last}};
}

ordered_json ranking_json(const RankingReport& r) {
  return {{"rank", or_null(r.rank)},
          {"candidates", r.candidates},
          {"is_candidate", r.is_candidate},
          {"log_odds", r.rank ? ordered_json(r.log_odds) : ordered_json()},
          {"own_log_odds", r.own_log_odds},
          {"last_log_odds", r.last_log_odds}};
}

ordered_json selection_json(const SelectionReport& r, int object) {
  return {{"competes", r.competes},
          {"above_chance", r.above_chance},
          {"claimed", r.claimed},
          {"shared_probability", or_null(r.shared_probability)},
          {"alternatives", r.alternatives},
          {"selected", found_json(r.selected, object)},
          {"rank", r.selected ? ordered_json(r.rank) : ordered_json()},
          {"is_reported", r.is_reported}};
}

ordered_json stages_json(const LossReport& r, int object) {
  return {{"range", range_json(r.range)},
          {"edges", edges_json(r.edges)},
          {"scan", scan_json(r.scan)},
          {"support", support_json(r.support, r.scan.aligned_near > 0)},
          {"alignment",
           {{"same", r.alignment.same},
            {"nearest", found_json(r.alignment.nearest, object)},
            {"best_hit_became", found_json(r.alignment.best_hit_became, object)}}},
          {"ranking", ranking_json(r.ranking)},
          {"refinement",
           {{"same", found_json(r.refinement.same, object)},
            {"nearest", found_json(r.refinement.nearest, object)},
            {"own", found_json(r.refinement.own, object)}}},
          {"selection", selection_json(r.selection, object)}};
}

ordered_json explained_json(const ExplainedPose& pose) {
  const int object = pose.given.object;
  ordered_json fields{{"image", pose.image.string()},
                      {"scene_id", pose.scene_id},
                      {"image_id", pose.image_id},
                      {"object_id", pose.object_id},
                      {"camera_from_object", pose_json(pose.given.world_from_object)},
                      {"lost_at", to_string(pose.report.lost_at)}};
  fields.update(stages_json(pose.report, object));
  fields["rival"] = nullptr;
  if (const std::optional<Rival>& rival = pose.report.rival) {
    fields["rival"] = found_json(*rival, object);
    fields["rival"]["claimed"] = rival->claimed;
    fields["rival"]["is_restarted"] = rival->is_restarted;
  }
  fields["picture"] = pose.picture.empty() ? ordered_json() : ordered_json(pose.picture);
  return fields;
}

ordered_json summary_json(std::span<const ExplainedPose> poses) {
  ordered_json summary = ordered_json::object();
  for (const auto& [object, fates] : count_fates(poses)) {
    summary[object]["given"] = count_of(fates);
    for (std::size_t s = 0; s <= stage_count; ++s)
      summary[object][to_string(LossStage(s))] = fates[s];
  }
  return summary;
}

}  // namespace

std::string stage_table(const ExplainedPose& pose) {
  const LossReport& report = pose.report;
  std::string table = fmt::format("{}: {}\n", place_of(pose), fate_of(report));
  for (std::size_t s = 0; s < stage_count; ++s) {
    const auto stage = LossStage(s);
    const char* state = stage < report.lost_at ? "passed" : stage == report.lost_at ? "LOST" : "-";
    table += fmt::format("  {:<12} {:<7} {}\n", to_string(stage), state, text_of(stage, report));
  }
  if (report.rival) table += fmt::format("  {:<20} {}\n", "its place took", rival_text(pose));
  return table;
}

std::string one_line(const ExplainedPose& pose) {
  return fmt::format("{}: {}: {}\n", place_of(pose), fate_of(pose.report),
                     text_of(pose.report.lost_at, pose.report));
}

std::string summary_table(std::span<const ExplainedPose> poses) {
  std::string table = fmt::format("{:>6} {:>6} {:>8}", "object", "given", "reported");
  for (std::size_t s = 0; s < stage_count; ++s)
    table += fmt::format(" {:>11}", to_string(LossStage(s)));
  table += "\n";
  for (const auto& [object, fates] : count_fates(poses)) {
    table += fmt::format("{:>6} {:>6} {:>8}", object, count_of(fates), fates[stage_count]);
    for (std::size_t s = 0; s < stage_count; ++s) table += fmt::format(" {:>11}", fates[s]);
    table += "\n";
  }
  return table;
}

ordered_json json_of(std::span<const ExplainedPose> poses, const SamePoseOptions& same) {
  ordered_json root{{"edgescout_explain", format_version},
                    {"same_pose",
                     {{"max_angle_rad", same.max_angle_rad},
                      {"max_distance_m", same.max_distance_m},
                      {"max_mspd_px", same.max_mspd_px}}},
                    {"summary", summary_json(poses)},
                    {"poses", ordered_json::array()}};
  for (const ExplainedPose& pose : poses) root["poses"].push_back(explained_json(pose));
  return root;
}

}  // namespace edgescout
