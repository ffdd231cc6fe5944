#include "host/experiments/detection.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "host/baselines/line2d.h"
#include "host/eval/detection_curve.h"
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
  double sign;  // times it, the column is the higher the likelier
};
constexpr Detector DETECTORS[] = {{"FDCM", "fdcm_px", -1}, {"LINE-2D", "line2d", 1}};

Notes options(const ExperimentSettings& s) {
  Notes notes{{"scenes", std::to_string(s.scenes)},
              {"candidates", std::to_string(s.candidates)},
              {"image_scale", number_text(s.image_scale)},
              {"supersampling", std::to_string(s.supersampling)}};
  if (s.data.empty()) return notes;
  notes.emplace_back("data", data_mark(s.data));
  notes.emplace_back("frames_every", std::to_string(s.frames_every));
  return notes;
}

// Columns: set, image, object, instances (of the object in the image), candidate, instance (empty: of none),
// and the scores.
Table score_candidates(const KnownScene& scene, const ExperimentSettings& settings, Backend& backend) {
  Table table{{}, {"set", "image", "object", "instances", "candidate", "instance", "fdcm_px", "line2d"}, {}};
  std::vector<EdgeModel> models;
  for (const Object& object : scene.objects) models.push_back(make_edge_model(object.mesh));
  const RegisterView view = register_views(scene, backend)[0];
  for (int object = 0; object < static_cast<int>(scene.objects.size()); ++object) {
    const auto instances = std::ranges::count(scene.instances, object, &KnownInstance::object);
    if (instances == 0) continue;
    const std::vector<PoseCandidate> candidates =
        pose_candidates(scene, object, settings.candidates, settings.seed);
    std::vector<Candidate> poses;
    for (const PoseCandidate& candidate : candidates)
      poses.push_back({object, candidate.camera_from_object, 0});
    const std::vector<double> fdcm = fdcm_scores(models, poses, view, backend);
    const std::vector<double> line2d = line2d_scores(models, poses, view, backend);
    for (std::size_t i = 0; i < candidates.size(); ++i)
      table.rows.push_back({scene.set, scene.name, scene.objects[object].mesh.name, std::to_string(instances),
                            std::to_string(i),
                            candidates[i].instance < 0 ? "" : scene.instances[candidates[i].instance].name,
                            number_text(fdcm[i]), number_text(line2d[i])});
  }
  return table;
}

std::vector<Cell> cells(const ExperimentSettings& s) {
  std::vector<Cell> list;
  for (int number = 0; number < s.scenes; ++number) {
    const std::string name = fmt::format("scene_{:03}", number);
    list.push_back(
        {"rendered/" + name, [s, number, name](Backend& backend) {
           return score_candidates(
               rendered_scene(name, rendered_types(), single_image_options(s, number), backend.threads()), s,
               backend);
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
                      const Photographs& source = photograph.source;
                      return score_candidates(
                          bop_scene(source.set, source.scene, source.models, {photograph.image}), s, backend);
                    }});
  return list;
}

struct Curve {
  std::vector<CurvePoint> points;
  int images = 0, instances = 0;
};

Curve curve_of(const Table& table, const Detector& detector) {
  std::map<std::string, int> instances;  // with a candidate
  std::map<std::string, double> there;   // by image and object, with one or not
  std::set<std::string> images;
  std::vector<ScoredPose> poses;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string image = text_in(table, row, "set") + "/" + text_in(table, row, "image");
    images.insert(image);
    there[image + "/" + text_in(table, row, "object")] = number_in(table, row, "instances");
    ScoredPose pose{detector.sign * number_in(table, row, detector.column), -1};
    if (const std::string& instance = text_in(table, row, "instance"); !instance.empty())
      pose.instance =
          instances.emplace(image + "/" + instance, static_cast<int>(instances.size())).first->second;
    poses.push_back(pose);
  }
  int all = 0;
  for (const auto& [key, count] : there) all += static_cast<int>(count);
  return {detection_curve(std::move(poses), all), static_cast<int>(images.size()), all};
}

// The corners of the staircase: where the rate rises, and the ends. On a logarithmic axis no false positive
// at all is drawn as half of one.
PlotLine line_of(const char* name, const Curve& curve) {
  PlotLine line{name, {}};
  const std::vector<CurvePoint>& points = curve.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_end = i == 0 || i + 1 == points.size();
    if (is_end || points[i + 1].rate > points[i].rate || points[i].rate > points[i - 1].rate)
      line.points.push_back(
          {std::max(0.5, static_cast<double>(points[i].false_positives)) / std::max(1, curve.images),
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

// All rendered images, each of their types, and every other set.
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

Report report(const ExperimentSettings& settings, const Table& table) {
  constexpr double ALLOWED[] = {0, 0.1, 1, 10};  // false positives an image
  Report result;
  result.markdown = fmt::format(
      "{} candidates an image and type: {} around every instance of which at least a tenth shows, within {} "
      "rad and {:.0f} mm; all others anywhere in a cube that holds the instances. "
      "FDCM ranks by the mean distance of the tensor, LINE-2D by the similarity of OpenCV's linemod. An "
      "instance is found where a candidate of it is accepted.\n\n"
      "| candidates | method | no false positive | 0.1 an image | 1 | 10 | instances "
      "|\n|---|---|---|---|---|---|---|\n",
      settings.candidates, CANDIDATES_AN_INSTANCE, CANDIDATE_ANGLE_RAD, 1000 * CANDIDATE_DISTANCE_M);
  for (const Part& part : parts_of(table)) {
    Panel panel{part.name, "false positives an image (none: as half of one)", "true positive rate", {}, 0, 1,
                true};
    for (const Detector& detector : DETECTORS) {
      const Curve curve = curve_of(part.rows, detector);
      panel.lines.push_back(line_of(detector.name, curve));
      result.markdown += "| " + part.name + " | " + detector.name;
      for (const double allowed : ALLOWED)
        result.markdown += " | " + percent(rate_at(curve.points, allowed * curve.images));
      result.markdown += fmt::format(" | {} |\n", curve.instances);
    }
    result.panels.push_back(std::move(panel));
  }
  return result;
}

}  // namespace

Experiment detection_experiment() {
  return {"detection", "True positives against false positives", options, cells, report};
}

}  // namespace edgescout
