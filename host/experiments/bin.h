// A bin of piled parts and the views around it, on which the strategies of the next view are
// compared (paper, Sec. 6.4).
//
// A bin is rendered, with views on a hemisphere, or photographed (photographed_bin.h).
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "host/active/views.h"
#include "host/experiments/settings.h"
#include "host/render/simulated_cell.h"

namespace edgescout {

struct BinInstance {
  int object = 0;  // index into the types
  Se3 world_from_object;
  double visible = 0;       // visible fraction of its silhouette, in the first view
  double most_visible = 0;  // the largest in the images so far
  std::size_t placed = 0;   // index into the scene's placed objects
};

// The source of a bin's images.
class BinCell : public ViewSource {
 public:
  // Returns the visible fraction of every placed object's silhouette in this view.
  virtual const std::vector<double>& visible(int view) = 0;
};

// A simulated cell that renders each image once and serves it to all strategies.
class RenderedCell : public BinCell {
 public:
  RenderedCell(const SimulatedScene& scene, std::vector<Se3> views, ThreadPool& pool)
      : scene_(scene),
        cell_(scene, scene.views[0].camera, std::move(views), {}, pool),
        pool_(pool) {}
  Camera camera() const override { return cell_.camera(); }
  std::vector<Se3> views() const override { return cell_.views(); }
  Shot acquire(int view) override;
  const std::vector<double>& visible(int view) override;

 private:
  SimulatedScene scene_;
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
// The distance of a part from any view differs from the hemisphere's radius by at most this.
inline constexpr double BIN_DEPTH_MARGIN_M = 0.16;

// Returns a sequence around the hemisphere and through its rings, from the first view on.
std::vector<int> fixed_sequence(const Bin& bin);
// Returns the first view and then, one after the other, the views that show most of `targets`. The
// visible fractions of an instance above 0.3 add up over the images: below that there are no hits.
std::vector<int> clairvoyant_sequence(const Bin& bin, std::span<const BinInstance> targets,
                                      int views);

Bin make_bin(std::span<const Object> types, const ExperimentSettings& settings, int number,
             ThreadPool& pool);

}  // namespace edgescout
