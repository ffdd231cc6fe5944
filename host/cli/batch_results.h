// Writes the files of a batch apart from the pictures: NAME.json for every image, results.csv over
// all images and summary.json. An interrupted batch resumes from the JSON files.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "host/cli/batch_settings.h"
#include "host/cli/template_origin.h"
#include "host/register_objects.h"

namespace edgescout {

struct BatchSummary {
  int images = 0, done = 0, skipped = 0;
  int poses = 0;                                // in results.csv: of images done and skipped
  int out_of_sight = 0;                         // of these poses: OUT_OF_SIGHT
  std::set<std::string> finished;               // names of the images done and skipped
  std::map<std::string, std::string> failures;  // message by file
  std::map<std::string, double> stage_seconds;  // of all images done, by stage
  std::vector<TemplateOrigin> templates;        // empty: not known
  double seconds = 0;
  std::string error;  // the error that ended the batch; empty: none
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

// Writes results.csv from the JSON files of the finished images; of scenes with several cameras
// also results_CAMERA.csv. JSON files that an earlier run
// left for other images are not used. Counts in the summary the rows and the poses out of sight.
void write_csv(std::span<const InputImage> images, BatchSummary& summary,
               const std::filesystem::path& out);

// Writes summary.json: counts, throughput, mean time of every stage, failures, and the error that
// ended the batch.
void write_summary(const BatchSummary& summary, const std::string& device,
                   const std::filesystem::path& out);

// Writes both for a batch that an error ends, so that those of an earlier run do not remain. If
// writing fails, that is logged: the first error is the one to report.
void write_ended(std::span<const InputImage> images, BatchSummary& summary,
                 const std::string& device, const std::filesystem::path& out);

}  // namespace edgescout
