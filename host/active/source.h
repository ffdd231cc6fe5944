// Where images come from: "move the camera there and give me an image".
//
// The world is any fixed frame. A source offers numbered views and takes an image from one of them;
// what it cannot reach or read it says by AcquisitionError, and the loop (scout.h) goes on without
// that view.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/core/types.h"
#include "host/render/scene.h"

namespace edgescout {

class ThreadPool;

// Timeout, unreadable image, pose not reached.
class AcquisitionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Shot {
  Image image;            // as the camera saw it, distorted
  Se3 camera_from_world;  // where the camera stood, as far as anybody knows
};

class ViewSource {
 public:
  virtual ~ViewSource() = default;
  virtual Camera camera() const = 0;  // of every image
  virtual std::vector<Se3> views()
      const = 0;                       // camera_from_world of every place the camera can be sent to
  virtual Shot acquire(int view) = 0;  // throws AcquisitionError
};

// How far an arm misses the place it is sent to: standard deviations of the camera's place and
// direction, each axis.
struct ArmNoise {
  double translation_m = 0;
  double rotation_rad = 0;
  bool known = false;  // whether the arm's encoders tell: then a shot has the place really reached,
                       // else the planned one
  std::uint64_t seed = 1;
  void validate() const;  // InputError naming the field and the violated bound
};

// A rendered scene (render/scene.h). The image of a view depends on scene, view and seed alone, not
// on what was asked before. One thread at a time.
class SimulatedCell : public ViewSource {
 public:
  // `scene`'s own views are not used. `pool` must outlive this.
  SimulatedCell(Scene scene, const Camera& camera, std::vector<Se3> camera_from_world,
                const ArmNoise& noise, ThreadPool& pool);
  Camera camera() const override { return camera_; }
  std::vector<Se3> views() const override { return camera_from_world_; }
  Shot acquire(int view) override;

 private:
  Scene scene_;
  Camera camera_;
  std::vector<Se3> camera_from_world_;
  ArmNoise noise_;
  ThreadPool& pool_;
};

// Images taken before, one a view; each is read when it is asked for, and AcquisitionError where it
// cannot be.
class RecordedViews : public ViewSource {
 public:
  struct Recording {
    std::filesystem::path file;
    Se3 camera_from_world;
  };
  // A camera of size 0 x 0 takes the first readable image's. InputError: no recording, none that
  // can be read.
  RecordedViews(const Camera& camera, std::vector<Recording> recordings);
  Camera camera() const override { return camera_; }
  std::vector<Se3> views() const override;
  Shot acquire(int view) override;
  const std::vector<Recording>& recordings() const { return recordings_; }

 private:
  Camera camera_;
  std::vector<Recording> recordings_;
};

// A BOP scene folder, or a folder in the form of Castle-simu in Debian's visp-images-data:
// Images/Image_NNNN.pgm, CameraPose/Camera_NNN.txt (4 x 4, object to camera: the object is the
// world). `camera` replaces a BOP scene's own and is needed for the other form. InputError naming
// folder or file: neither form, a view without world pose, images of different cameras, a matrix
// that is not rigid.
RecordedViews load_recorded_views(const std::filesystem::path& folder,
                                  const std::optional<Camera>& camera = {});

// A user's function in place of a class of his own.
class CallbackSource : public ViewSource {
 public:
  CallbackSource(const Camera& camera, std::vector<Se3> camera_from_world,
                 std::function<Shot(int)> acquire)
      : camera_(camera),
        camera_from_world_(std::move(camera_from_world)),
        acquire_(std::move(acquire)) {}
  Camera camera() const override { return camera_; }
  std::vector<Se3> views() const override { return camera_from_world_; }
  Shot acquire(int view) override { return acquire_(view); }

 private:
  Camera camera_;
  std::vector<Se3> camera_from_world_;
  std::function<Shot(int)> acquire_;
};

}  // namespace edgescout
