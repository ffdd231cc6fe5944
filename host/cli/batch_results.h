// Writes the files of a batch apart from the pictures: NAME.json for every image, results.csv,
// summary.json and report.html over all images. An interrupted batch resumes from the JSON files.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "host/cli/batch_settings.h"
#include "host/cli/batch_tables.h"
#include "host/cli/template_origin.h"
#include "host/register_objects.h"

namespace edgescout {

// What a merged batch lacks: an image, or a shard as a whole.
struct MissingPart {
  std::string what;  // "image FILE", "shard 2/8"
  int images = 1;
  std::string reason;
};

struct BatchSummary {
  std::string verb;
  bool by_scene = false;  // views of a scene are worked on together
  int images = 0, done = 0, skipped = 0;
  int poses = 0;                                // in results.csv: of images done and skipped
  int out_of_sight = 0;                         // of these poses: OUT_OF_SIGHT
  int incomplete = 0;                           // images whose poses may be missing: --max-seconds
  std::set<std::string> finished;               // names of the images done and skipped
  std::map<std::string, std::string> failures;  // message by file
  std::map<std::string, double> stage_seconds;  // of all images done, by stage
  std::vector<TemplateOrigin> templates;        // empty: not known
  double seconds = 0;
  std::string error;                 // the error that ended the batch; empty: none
  std::vector<MissingPart> missing;  // of a merged batch
};

std::filesystem::path json_of(const std::filesystem::path& out, const InputImage& input);
std::filesystem::path overlay_of(const std::filesystem::path& out, const InputImage& input);

// Transforms the detections of a single image from the camera frame to the world, if the pose of
// the camera in the world is known.
void carry_to_world(ImageResult& result);

// Returns the name of an image in results. It is absolute, since a later run may have another
// working folder.
std::filesystem::path place_of(const InputImage& input);

// Returns whether there is a complete result of this image in a format that is read. InputError:
// the result was made with other settings. It must neither be used nor be overwritten.
bool is_done(const std::filesystem::path& out, const InputImage& input, const Settings& settings);

// Writes NAME.json. Logs the number of poses and the time of every stage as Debug.
void save_result(const ImageResult& result, const std::filesystem::path& out,
                 const InputImage& input);

// To be called for a batch that is not resumed. InputError: the folder has results of images that
// are not among these, or a file that is no result but has the name of one.
void require_no_other_results(const std::filesystem::path& out, std::span<const InputImage> images);
// Removes the files that an earlier run wrote for these images. Other files stay. Call
// require_no_other_results before.
void start_anew(const std::filesystem::path& out, std::span<const InputImage> images);

// Removes those of the files that are there. What is no regular file stays.
void remove_files_of_run(std::vector<std::filesystem::path> files);

struct TableFiles {
  std::filesystem::path out;
  int thumbnails = 2000;  // of images in report.html, at most; the file then stays below 20 MB
};

// Writes results.csv (of scenes with several cameras also results_CAMERA.csv), report.html and
// summary.json (counts, throughput, mean time of every stage, failures, what is missing, and the
// error that ended the batch). Counts in the summary the poses and those out of sight.
void write_tables(const BatchTables& tables, BatchSummary& summary, const std::string& device,
                  const TableFiles& files);

// The same, from the JSON files of the finished images. JSON files that an earlier run left for
// other images are not used.
void write_tables(std::span<const InputImage> images, BatchSummary& summary,
                  const std::string& device, const TableFiles& files);

// Writes them for a batch that an error ends, so that those of an earlier run do not remain. If
// writing fails, that is logged: the first error is the one to report.
void write_ended(std::span<const InputImage> images, BatchSummary& summary,
                 const std::string& device, const TableFiles& files);

}  // namespace edgescout
