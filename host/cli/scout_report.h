// What an active detection leaves behind: a JSON log, poses image by image, and a page to look at.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/active/scout.h"
#include "host/io/results.h"

namespace edgescout {

// An instance that is known to lie there, in a simulated cell.
struct TrueObject {
  int object = 0;
  Se3 world_from_object;
};

struct ScoutReport {
  std::span<const TemplateSet> sets;
  Camera camera;  // ideal
  EdgesOptions edges;
  std::string device, source, strategy;
  Settings settings;  // of the source and of what is seen and believed in it
  Settings planning;  // of where to look and when to end: of the last run
  std::vector<TrueObject> truth;
  std::vector<int> image_ids;                      // one a view
  std::vector<std::filesystem::path> image_files;  // one a view, or empty: they have none
  int scene_id = 0;
};

// Numbers of the images whose camera pose the others contradict after the last one: "2, 5"; empty:
// none.
std::string disagreeing_images(const ScoutState& state);

// Of ViewInformation::information; empty where it has none.
const char* unit_of(const ScoutDecision& decision);

// How far a detection lies from the nearest instance of its object; nothing where no truth is
// known.
struct DistanceToTruth {
  std::size_t instance = 0;  // index into the report's truth
  double angle_rad = 0, distance_m = 0;
  bool right = false;  // below 0.1 rad and 5 mm, the paper's criterion
};
std::optional<DistanceToTruth> distance_to_truth(const Detection& detection,
                                                 const ScoutReport& report);

// FOLDER/scout.json: {edgescout_scout: 1, device, source, settings {name: text}, planning {name:
// text} and strategy (of the last run), camera (the ideal one), views, steps [..], last_decision,
// failed [..], detections [..], truth [..] (of a cell), seconds, end}; poses are {R, t} as in
// io/results.h. Atomically.
void save_scout_log(const ScoutState& state, const ScoutReport& report,
                    const std::filesystem::path& folder);
// What an earlier run left, by its log: state, log, results and page, which must not be taken for
// this one's. Other files stay. InputError: a log that cannot be read, a file that cannot be
// removed.
void remove_scout_results(const std::filesystem::path& folder);
// InputError naming the first setting of the source that differs from those in FOLDER/scout.json.
void require_same_source(const Settings& settings, const std::filesystem::path& folder);

// FOLDER/view_NNN.json (io/results.h) of every image taken, with all that was found in the world,
// and FOLDER/results.csv (BOP). An image without a file has an empty name there: its id says which
// it is.
void save_scout_results(const ScoutState& state, const ScoutReport& report,
                        const std::filesystem::path& folder);

// One HTML page that needs nothing beside itself: no network, no script, no other file.
// `refreshing`: the browser reads it again every two seconds.
std::string scout_page(const ScoutState& state, const ScoutReport& report, bool refreshing,
                       Backend& backend);

}  // namespace edgescout
