// Images that were taken before, as a source of views.
//
// Public header.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "host/active/source.h"
#include "host/io/image_options.h"

namespace edgescout {

// One image per view. Each file is read when its view is acquired; AcquisitionError where that
// fails.
class RecordedViews : public ViewSource {
 public:
  struct Recording {
    std::filesystem::path file;
    Se3 camera_from_world;
  };
  // Makes a source of recordings. A camera of size 0 x 0 takes the size of the first readable
  // image. InputError: no recording, none that can be read, an invalid camera.
  RecordedViews(const Camera& camera, std::vector<Recording> recordings,
                const ImageOptions& reading = {});
  Camera camera() const override { return camera_; }
  std::vector<Se3> views() const override;
  Shot acquire(int view) override;  // LogicError: no such view
  const std::vector<Recording>& recordings() const { return recordings_; }

 private:
  Camera camera_;
  std::vector<Recording> recordings_;
  ImageOptions reading_;
};

// Reads a folder of one of two forms.
//
//   BOP scene     scene_camera.json with world poses
//   Castle-simu   Images/Image_NNNN.pgm and CameraPose/Camera_NNN.txt, a 4 x 4 matrix
//                 camera_from_object; the object frame is the world (Debian package
//                 visp-images-data)
//
// `camera` replaces the camera of a BOP scene; the other form needs it. `camera_name` chooses one
// of a BOP scene with several cameras. InputError naming folder or file: neither form, no camera, a
// view without world pose, images of different cameras, a matrix that is not rigid.
RecordedViews load_recorded_views(const std::filesystem::path& folder,
                                  const std::optional<Camera>& camera = {},
                                  const std::string& camera_name = "",
                                  const ImageOptions& reading = {});

}  // namespace edgescout
