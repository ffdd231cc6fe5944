// Collects what the results of a batch's images hold together, for results.csv and report.html.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "host/cli/inputs.h"
#include "host/io/bop.h"
#include "host/io/results.h"

namespace edgescout {

// What the page of a batch says of one image.
struct PageImage {
  std::string name;
  std::filesystem::path folder;  // of its result and overlay, from the page's own; empty: the same
  enum class State { Done, Failed, Missing } state = State::Done;
  int poses = 0;
  double best_probability = 0, seconds = 0;
  std::string message;  // why it failed or is missing
};

class BatchTables {
 public:
  // `by_scene`: views of a scene were worked on together, and each has the times of all.
  explicit BatchTables(bool by_scene) : by_scene_(by_scene) {}

  void add(const InputImage& input, const ImageResult& result,
           const std::filesystem::path& folder = {});
  void add_failed(const InputImage& input, const std::string& message);
  void add_missing(const InputImage& input, const std::string& message);

  std::vector<BopResult> rows;
  int out_of_sight = 0;  // of the rows: OUT_OF_SIGHT
  int incomplete = 0;    // images: ImageResult::incomplete
  std::vector<PageImage> images;
  std::set<std::string> cameras;  // of scenes with several
  std::set<std::string> devices;
  std::vector<StageSeconds> stages;  // sums over all images, in the order in which they ran
  int done = 0;

 private:
  PageImage& add_image(const InputImage& input);
  void add_stages(const InputImage& input, const ImageResult& result);
  bool by_scene_;
  std::set<std::filesystem::path> counted_;  // folders of scenes whose times are in the sums
};

}  // namespace edgescout
