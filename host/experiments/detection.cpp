#include "host/experiments/detection.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "host/baselines/candidate_scores.h"
#include "host/eval/detection_curve.h"
#include "host/eval/intervals.h"
#include "host/experiments/data_mark.h"
#include "host/experiments/photographs.h"
#include "host/experiments/pose_candidates.h"
#include "host/experiments/rates.h"
#include "host/experiments/recorded_starts.h"

namespace edgescout {

namespace {

struct Detector {
  const char* name;
  const char* column;
  double sign;  // sign * column is higher for a likelier candidate
};
// The FDCM detectors stand first, in the order of fdcm_views.
constexpr Detector DETECTORS[] = {{"FDCM", "fdcm_px", -1},
                                  {"FDCM (LSD edges)", "fdcm_lsd_px", -1},
                                  {"FDCM (lambda 30)", "fdcm_own_px", -1},
                                  {"FDCM (cap 15 px)", "fdcm_cap_px", -1},
                                  {"LINE-2D", "line2d", 1}};
static_assert(OWN_LAMBDA_PX_PER_RAD == 30, "as the detector's name says");
constexpr float LOW_CAP_PX = 15;  // of the cost of a point that is hidden or not detected

Notes options(const ExperimentSettings& s) {
  Notes notes{{"scenes", std::to_string(s.scenes)},
              {"candidates", std::to_string(s.candidates)},
              lambda_note(),
              {"smoothing_variance", number_text(s.tensor.smoothing_variance)},
              {"cap_px", number_text(s.tensor.cap_px)},
              {"image_scale", number_text(s.image_scale)},
              {"supersampling", std::to_string(s.supersampling)}};
  if (s.data.empty()) return notes;
  notes.emplace_back("data", data_mark(s.data));
  notes.emplace_back("frames_every", std::to_string(s.frames_every));
  return notes;
}

TensorOptions capped(TensorOptions options, float cap_px) {
  options.cap_px = cap_px;
  return options;
}

// The view of the first image for each FDCM detector. Its camera frame is the world.
std::vector<ObjectView> fdcm_views(const KnownScene& scene, const SceneEdges& edges,
                                   const SceneEdges& lsd, const TensorOptions& tensor,
                                   Backend& backend) {
  const TensorOptions papers = with_lambda(tensor, PAPER_LAMBDA_PX_PER_RAD);
  const auto view_with = [&](const SceneEdges& points, const TensorOptions& of_tensor) {
    ObjectView view = register_views(scene, points, of_tensor, backend)[0];
    view.camera_from_world = Se3{};
    return view;
  };
  return {view_with(edges, papers), view_with(lsd, papers),
          view_with(edges, with_lambda(tensor, OWN_LAMBDA_PX_PER_RAD)),
          view_with(edges, capped(papers, LOW_CAP_PX))};
}

// The scores of all detectors, in the order of DETECTORS.
std::vector<std::vector<double>> scores_of(std::span<const EdgeModel> models,
                                           std::span<const ObjectPose> poses,
                                           const std::vector<ObjectView>& views, Backend& backend) {
  std::vector<std::vector<double>> scores;
  for (const ObjectView& view : views)
    scores.push_back(fdcm_scores({models, {&view, 1}, backend}, poses));
  scores.push_back(line2d_scores({models, {&views[0], 1}, backend}, poses));
  return scores;
}

// Columns: set, image, object, instances (of the object in the image), candidate, instance and its
// visible fraction (both empty: the candidate is no pose of an instance), and the scores.
Table score_candidates(const KnownScene& scene, const ExperimentSettings& settings,
                       Backend& backend) {
  Table table{{}, {"set", "image", "object", "instances", "candidate", "instance", "visible"}, {}};
  for (const Detector& detector : DETECTORS) table.columns.emplace_back(detector.column);
  std::vector<EdgeModel> models;
  for (const Object& object : scene.objects) models.push_back(make_edge_model(object.mesh));
  const SceneEdges edges = edges_of(scene, backend),
                   lsd = edges_of(scene, backend, EdgeMethod::Lsd);
  const std::vector<ObjectView> views = fdcm_views(scene, edges, lsd, settings.tensor, backend);
  for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
    const auto instances = std::ranges::count(scene.instances, object, &KnownInstance::object);
    if (instances == 0) continue;
    const std::vector<PoseCandidate> candidates =
        pose_candidates(scene, object, settings.candidates, settings.seed);
    std::vector<ObjectPose> poses;
    for (const PoseCandidate& candidate : candidates)
      poses.push_back({object, candidate.camera_from_object});
    const std::vector<std::vector<double>> scores = scores_of(models, poses, views, backend);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const int of = candidates[i].instance;
      std::vector<std::string> row{scene.set,
                                   scene.name,
                                   scene.objects[object].mesh.name,
                                   std::to_string(instances),
                                   std::to_string(i),
                                   of < 0 ? "" : scene.instances[of].name,
                                   of < 0 ? "" : number_text(scene.instances[of].visible)};
      for (const std::vector<double>& of_detector : scores)
        row.push_back(number_text(of_detector[i]));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

std::vector<Cell> cells(const ExperimentSettings& s) {
  std::vector<Cell> list;
  for (int number = 0; number < s.scenes; ++number) {
    const std::string name = fmt::format("scene_{:03}", number);
    list.push_back({"rendered/" + name, [s, number, name](Backend& backend) {
                      return score_candidates(
                          rendered_scene(name, rendered_types(), single_image_options(s, number),
                                         backend.threads()),
                          s, backend);
                    }});
  }
  if (s.data.empty()) return list;
  const std::filesystem::path recorded = s.data / "d2co-starts";
  for (const std::string& image : recorded_images(recorded))
    list.push_back({"d2co-starts/" + image, [s, recorded, image](Backend& backend) {
                      return score_candidates(recorded_scene(recorded, image, 0), s, backend);
                    }});
  for (const NamedPhotograph& photograph : single_photographs(s.data, s.frames_every))
    list.push_back({photograph.name, [s, photograph](Backend& backend) {
                      return score_candidates(photographed_scene(photograph.source), s, backend);
                    }});
  return list;
}

// The candidates of one detector in one set of images.
struct Scored {
  std::vector<ScoredPose> poses;
  std::vector<int> instances;  // per image, found or not
  int all_instances() const { return std::accumulate(instances.begin(), instances.end(), 0); }
};

Scored scored_by(const Detector& detector, const Table& table) {
  Scored scored;
  std::map<std::string, int> images, instances;
  std::set<std::string> counted;  // objects of images
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string image = text_in(table, row, "set") + "/" + text_in(table, row, "image");
    const int index = images.emplace(image, static_cast<int>(images.size())).first->second;
    scored.instances.resize(images.size());
    if (counted.insert(image + "/" + text_in(table, row, "object")).second)
      scored.instances[index] += static_cast<int>(number_in(table, row, "instances"));
    ScoredPose pose{detector.sign * number_in(table, row, detector.column), -1, index};
    if (const std::string& instance = text_in(table, row, "instance"); !instance.empty())
      pose.instance =
          instances
              .emplace(fmt::format("{}/{}", image, instance), static_cast<int>(instances.size()))
              .first->second;
    scored.poses.push_back(pose);
  }
  return scored;
}

// Keeps the corners of the staircase: its ends and the points where the rate rises. On a
// logarithmic axis no false positive at all is drawn as half of one.
PlotLine line_of(const char* name, const std::vector<CurvePoint>& points, std::size_t images) {
  PlotLine line{name, {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_end = i == 0 || i + 1 == points.size();
    if (is_end || points[i + 1].rate > points[i].rate || points[i].rate > points[i - 1].rate)
      line.points.push_back({std::max(0.5, static_cast<double>(points[i].false_positives)) /
                                 static_cast<double>(std::max<std::size_t>(1, images)),
                             points[i].rate,
                             {},
                             {}});
  }
  return line;
}

struct Part {
  std::string name;
  Table rows;
};

// The parts of the report: each type of the rendered images, all rendered images, every other set.
std::vector<Part> parts_of(const Table& table) {
  std::vector<Part> parts;
  for (const std::string& set : values_of(table, "set")) {
    Part part{set, rows_where(table, [&](const Table& t, std::size_t row) {
                return text_in(t, row, "set") == set;
              })};
    if (set == "rendered")
      for (const std::string& type : values_of(part.rows, "object"))
        parts.push_back({type, rows_where(part.rows, [&](const Table& t, std::size_t row) {
                           return text_in(t, row, "object") == type;
                         })});
    if (set == "rendered") part.name = "rendered, all types";
    parts.push_back(std::move(part));
  }
  return parts;
}

constexpr double ALLOWED[] = {0, 0.1, 1, 10};  // false positives per image

// The rate of one detector, and its rates in resampled sets of images. All detectors have the same
// draws.
struct Rates {
  double rate = 0;
  std::vector<double> resampled;
};

std::vector<Rates> rates_of(const Scored& scored, const std::vector<CurvePoint>& curve,
                            const Draws& draws) {
  std::vector<Rates> rates;
  for (const double allowed : ALLOWED)
    rates.push_back({rate_at(curve, allowed * static_cast<double>(scored.instances.size())),
                     resampled_rates(scored.poses, scored.instances, allowed, draws)});
  return rates;
}

// The rate of an FDCM detector less that of LINE-2D, in percentage points.
std::string difference_row(const std::string& name, const Detector& detector,
                           const std::vector<Rates>& fdcm, const std::vector<Rates>& line2d) {
  std::string text = "| " + name + " | " + detector.name + " less LINE-2D, points";
  for (std::size_t i = 0; i < fdcm.size(); ++i) {
    std::vector<double> differences;
    for (std::size_t d = 0; d < fdcm[i].resampled.size(); ++d)
      differences.push_back(fdcm[i].resampled[d] - line2d[i].resampled[d]);
    text +=
        " | " + points(fdcm[i].rate - line2d[i].rate, percentile_interval(std::move(differences)));
  }
  return text + " | |\n";
}

std::string introduction(const ExperimentSettings& settings) {
  return fmt::format(
      "{} candidates per image and type: {} around every instance of which at least a tenth shows, "
      "within {} "
      "rad and {:.0f} mm; all others anywhere in a cube that holds the instances. "
      "FDCM ranks by the mean distance of the tensor (with the paper's weight of the orientation, "
      "{} px/rad, "
      "or another; of this project's edges or, as in the paper, of LSD's; no distance above {:.0f} "
      "px, or "
      "above a lower cap; the paper has none), LINE-2D by the similarity of "
      "OpenCV's linemod. An instance is found where a candidate of it is accepted. 95 % intervals "
      "by "
      "bootstrap over images; of the difference over the same draws of images.{}\n\n"
      "| candidates | method | no false positive | 0.1 per image | 1 | 10 | instances "
      "|\n|---|---|---|---|---|---|---|\n",
      settings.candidates, CANDIDATES_AN_INSTANCE, CANDIDATE_ANGLE_RAD, 1000 * CANDIDATE_DISTANCE_M,
      PAPER_LAMBDA_PX_PER_RAD, settings.tensor.cap_px,
      settings.data.empty() ? "" : std::string(" ") + PHOTOGRAPHS_COUNT_APART);
}

void add_part(Report& report, const Part& part) {
  Panel panel{
      part.name, "false positives per image (none: as half of one)", "true positive rate", {}, 0, 1,
      true};
  std::vector<std::vector<Rates>> of_detector;
  const Draws draws = draw_images(values_of(part.rows, "image").size());
  for (const Detector& detector : DETECTORS) {
    const Scored scored = scored_by(detector, part.rows);
    const std::vector<CurvePoint> curve = detection_curve(scored.poses, scored.all_instances());
    panel.lines.push_back(line_of(detector.name, curve, scored.instances.size()));
    of_detector.push_back(rates_of(scored, curve, draws));
    report.markdown += "| " + part.name + " | " + detector.name;
    for (const Rates& rates : of_detector.back())
      report.markdown +=
          " | " +
          percent(rates.rate, resampled_interval(rates.resampled,
                                                 static_cast<double>(scored.instances.size())));
    report.markdown += fmt::format(" | {} |\n", scored.all_instances());
  }
  for (std::size_t d = 0; d + 1 < of_detector.size(); ++d)
    report.markdown += difference_row(part.name, DETECTORS[d], of_detector[d], of_detector.back());
  report.panels.push_back(std::move(panel));
}

Report report(const ExperimentSettings& settings, const Table& table) {
  Report result;
  result.markdown = introduction(settings);
  for (const Part& part : parts_of(table)) add_part(result, part);
  return result;
}

}  // namespace

Experiment detection_experiment() {
  return {"detection", "True positives against false positives", options, cells, report};
}

}  // namespace edgescout
