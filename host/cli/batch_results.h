// What a batch leaves in its folder beside the pictures: NAME.json an image, results.csv over all
// and summary.json. The JSON files are the memory of a batch that was interrupted.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "host/cli/batch_settings.h"

namespace edgescout {

struct BatchSummary {
  int images = 0, done = 0, skipped = 0;
  int poses = 0;                                // in results.csv: of images done and skipped
  int lost = 0;                                 // of these poses: OUT_OF_SIGHT
  std::set<std::string> finished;               // names of the images done and skipped
  std::map<std::string, std::string> failures;  // message by file
  std::map<std::string, double> stage_seconds;  // of all images done, by stage
  double seconds = 0;
  std::string error;  // that ended the batch; empty where none did
};

std::filesystem::path json_of(const std::filesystem::path& out, const InputImage& input);
std::filesystem::path overlay_of(const std::filesystem::path& out, const InputImage& input);

// Detection::convergence of a pose that no image shows: nothing could be refined.
inline constexpr const char* OUT_OF_SIGHT = "out of sight";

// Detections of one image alone are found in its camera's frame: into the world, where its pose
// there is known.
void carry_to_world(ImageResult& result);

// As results name an image: the working folder of a later run may be another.
std::filesystem::path place_of(const InputImage& input);

// Whether a whole result of this very image is there, in today's format. InputError where it was
// made with other settings: it is neither this batch's nor to be lost.
bool is_done(const std::filesystem::path& out, const InputImage& input, const Settings& settings);

// NAME.json. The log says, for debugging, how many poses there are and how long every stage took.
void save_result(const ImageResult& result, const std::filesystem::path& out,
                 const InputImage& input);

// A batch that is not taken up again leaves no other results beside its own. InputError where the
// folder holds those of images that are not among these, or something else by the name of a result.
void require_no_other_results(const std::filesystem::path& out, std::span<const InputImage> images);
// Removes what an earlier run wrote of these images, where require_no_other_results found nothing
// else. Other files stay.
void start_anew(const std::filesystem::path& out, std::span<const InputImage> images);

// results.csv, from the JSON files of the images that are finished: those that an earlier run left
// of others are no results of this one. Its rows, and those out of sight, are counted in the
// summary.
void write_csv(std::span<const InputImage> images, BatchSummary& summary,
               const std::filesystem::path& out);

// summary.json: counts, throughput, mean time of every stage, failures, the error of a batch that
// one ended.
void write_summary(const BatchSummary& summary, const std::string& device,
                   const std::filesystem::path& out);

// Both for a batch that an error ends: those of an earlier run would lie. Failing to write is
// logged: the error itself is what must be told.
void write_ended(std::span<const InputImage> images, BatchSummary& summary,
                 const std::string& device, const std::filesystem::path& out);

}  // namespace edgescout
