// A bin of piled parts and the views around it, rendered with a hemisphere of them or photographed
// (photographed_bin.h): what the strategies of the next view are compared on (paper, Sec. 6.4).
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "host/active/source.h"
#include "host/active/views.h"
#include "host/experiments/settings.h"

namespace edgescout {

struct BinInstance {
  int object = 0;  // index into the types
  Se3 world_from_object;
  double visible = 0;       // fraction of its silhouette, in the first view
  double most_visible = 0;  // in any of the images so far
  std::size_t placed = 0;   // index into the scene's placed objects
};

// Where a bin's images come from.
class BinCell : public ViewSource {
 public:
  // How much of every placed object's silhouette shows from there.
  virtual const std::vector<double>& visible(int view) = 0;
};

// A simulated cell whose images are rendered once, however many strategies ask for them.
class RenderedCell : public BinCell {
 public:
  RenderedCell(const Scene& scene, std::vector<Se3> views, ThreadPool& pool)
      : scene_(scene),
        cell_(scene, scene.views[0].camera, std::move(views), {}, pool),
        pool_(pool) {}
  Camera camera() const override { return cell_.camera(); }
  std::vector<Se3> views() const override { return cell_.views(); }
  Shot acquire(int view) override;
  const std::vector<double>& visible(int view) override;

 private:
  Scene scene_;
  SimulatedCell cell_;
  ThreadPool& pool_;
  std::map<int, Shot> shots_;
  std::map<int, std::vector<double>> visible_;
};

struct Bin {
  int number = 0, first_view = 0;
  int parts = 0;
  std::unique_ptr<BinCell> cell;
  std::vector<BinInstance> instances;
};

inline constexpr int FEWEST_PARTS_OF_BIN = 5, MOST_PARTS_OF_BIN = 20;
HemisphereOptions bin_views();
// The parts' distances from every view lie in this range.
inline constexpr double BIN_DEPTH_MARGIN_M = 0.16;  // on either side of the hemisphere's radius

// Around the hemisphere and through its rings from the first view, as somebody would lay it out.
std::vector<int> fixed_sequence(const Bin& bin);
// Views that show as much as they can of `sought`, one after the other, first view and all. What an
// image shows of an instance helps from three tenths on, where the first hits are, and several
// images together.
std::vector<int> clairvoyant_sequence(const Bin& bin, std::span<const BinInstance> sought,
                                      int views);

Bin make_bin(std::span<const Object> types, const ExperimentSettings& settings, int number,
             ThreadPool& pool);

}  // namespace edgescout
