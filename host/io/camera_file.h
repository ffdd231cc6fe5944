// Reads camera calibrations. docs/cameras.md lists the formats and fields.
//
// Public header.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/core/types.h"

namespace edgescout {

// A camera of a calibration file. Its size is 0 x 0 where the file has none.
struct FileCamera {
  std::string name;  // where it stands in the file: "cam0"; empty: the file has one camera
  Camera camera;
  std::vector<std::string> unused;  // fields that say nothing of the image
};

// Reads all cameras of a file: ROS, OpenCV (YAML, XML, JSON), Kalibr, EuRoC, BOP, MATLAB (JSON),
// Open3D, MegaPose, RealSense, Azure Kinect, COLMAP, OpenSfM, AliceVision, Project Aria, DSO,
// cam_K.txt and similar. Cameras have pixel centres at integers, with the ROI and the binning of
// the file applied. InputError naming file and field: no camera, a field that looks like a lens or
// a region and is not understood, a value that is not finite or has another form.
std::vector<FileCamera> load_cameras(const std::filesystem::path& file);
// Reads the cameras of a file's content. `source` names it in errors.
std::vector<FileCamera> cameras_in(const std::string& text, const std::string& source);

// Returns the cameras of this name, or of whose names it is the last part; all if it is empty.
// InputError: none.
std::vector<FileCamera> cameras_named(const std::string& name,
                                      const std::vector<FileCamera>& cameras,
                                      const std::string& source);

using SizePx = std::pair<int, int>;  // width, height

// Chooses a camera by its name, and among those by the size of an image, which is asked for only
// where it is needed. InputError naming the cameras: none or several that differ are left.
Camera choose_camera(const std::vector<FileCamera>& cameras, const std::string& name,
                     const std::function<SizePx()>& image_size, const std::string& source);

// Reads the only camera of a file, or that of the name.
Camera load_camera(const std::filesystem::path& file, const std::string& name = "");

// Returns the camera for an image of the given size. The calibration's own size is accepted. A pure
// scale of it (same ratio within 0.5 %) is accepted only with `allow_scale`. Any other size is an
// InputError naming both sizes. A calibration without a size (0 x 0) takes the size of the image.
Camera camera_for_image(const Camera& calibration, int width, int height, bool allow_scale,
                        const std::string& source);

}  // namespace edgescout
