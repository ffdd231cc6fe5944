// Writes the results of an active detection: a JSON log, poses image by image, and an HTML page.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/active/scout.h"
#include "host/io/results.h"

namespace edgescout {

using TrueObject = ObjectPose;  // an instance whose true pose is known, in a simulated cell

struct ScoutReport {
  std::span<const TemplateSet> sets;
  Camera camera;  // ideal
  EdgesOptions edges;
  std::string device, source, strategy;
  Settings settings;  // of the source, of detection and of the belief
  Settings planning;  // of the next view and of the end, as in the last run
  std::vector<TrueObject> truth;
  std::vector<int> image_ids;                      // one per view
  std::vector<std::filesystem::path> image_files;  // one per view; empty: images without files
  int scene_id = 0;
};

// Returns the numbers of the images whose camera pose disagrees with the others after the last
// image: "2, 5"; empty: none.
std::string disagreeing_images(const ScoutState& state);

// Returns the unit of ViewInformation::information; empty: it has no unit.
const char* unit_of(const ScoutDecision& decision);

// The distance of a detection from the nearest true instance of its object. Nothing without truth.
struct DistanceToTruth {
  std::size_t instance = 0;  // index into the report's truth
  double angle_rad = 0, distance_m = 0;
  bool right = false;  // below 0.1 rad and 5 mm, the paper's criterion
};
std::optional<DistanceToTruth> distance_to_truth(const Detection& detection,
                                                 const ScoutReport& report);

// Writes FOLDER/scout.json atomically. Poses are {R, t} as in io/results.h. The fields:
//   edgescout_scout   version of the format: 1
//   device, source
//   settings          {name: text}
//   planning          {name: text}, of the last run
//   strategy          of the last run
//   camera            the ideal one
//   views, steps [..], failed [..], detections [..], last_decision
//   truth [..]        only of a cell
//   seconds, end
void save_scout_log(const ScoutState& state, const ScoutReport& report,
                    const std::filesystem::path& folder);
// Removes the files of an earlier run that its log names: state, log, results and page. Other files
// stay. InputError: a log that cannot be read, a file that cannot be removed.
void remove_scout_results(const std::filesystem::path& folder);
// InputError naming the first setting of the source that differs from those in FOLDER/scout.json.
void require_same_source(const Settings& settings, const std::filesystem::path& folder);

// Writes FOLDER/view_NNN.json (io/results.h) for every image, with all detections in the world, and
// FOLDER/results.csv (BOP). The name of an image without a file is empty; its id identifies it.
void save_scout_results(const ScoutState& state, const ScoutReport& report,
                        const std::filesystem::path& folder);

// Returns an HTML page that needs no network, no script and no other file. `refreshing`: the
// browser reloads it every two seconds.
std::string scout_page(const ScoutState& state, const ScoutReport& report, bool refreshing,
                       Backend& backend);

}  // namespace edgescout
