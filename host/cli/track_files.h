// Writes what `edgescout track` found: tracks.csv frame by frame, results.csv and summary.json at
// the end.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/cli/inputs.h"
#include "host/cli/track_run.h"
#include "host/io/bop.h"

namespace edgescout {

class TrackFiles {
 public:
  // Removes the files of an earlier run. InputError: the folder cannot be written.
  TrackFiles(std::filesystem::path out, std::span<const InputImage> images,
             std::span<const TemplateSet> sets);
  ~TrackFiles();
  TrackFiles(const TrackFiles&) = delete;
  TrackFiles& operator=(const TrackFiles&) = delete;

  // The rows of a frame, whole or not at all: a killed run leaves whole frames. InputError: the
  // disk is full.
  void add(const InputImage& input, double time_s, std::span<const Track> tracks);
  // results.csv and summary.json.
  void finish(const TrackSummary& summary, const std::string& device) const;

 private:
  std::filesystem::path out_;
  std::span<const TemplateSet> sets_;
  std::vector<BopResult> results_;
  int descriptor_ = -1;
  long long length_ = 0;
};

}  // namespace edgescout
